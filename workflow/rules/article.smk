# The article on what was found, for readers who have ten minutes.
from importlib.metadata import version


use rule job as article with:
    "results/article.pdf and article.html: what reproduces, what does not, and what is new"
    input:
        datasets=DATASETS,
        pictures=expand("<results>/figures/{name}.{kind}", name=FIGURES, kind=["png", "pdf"]),
        ledger="<results>/claims.json",
    output:
        html="<results>/article.html",
        pdf="<results>/article.pdf",
        metadata="<results>/article.yaml",
    pathvars:
        made="article",
    params:
        call=function("pendula.article.write.write_article"),
        committed=committed(
            kept=[
                "tests/baseline/quoted/unbounded.nc",
                *("tests/baseline/quoted/breathers.nc", "tests/baseline/quoted/pendula.nc"),
                "tests/baseline/quoted/reproduction.json",
                "tests/baseline/speed/work_precision.nc",
                *expand("tests/baseline/proofs/{case}.nc", case=PAPER_CASES),
            ]
        ),
        digests=[version(name) for name in ("typst", "pypandoc_binary")],
        differs=DIFFERS,
