# The report, a page that runs the paper's solver in a browser, the article, and everything in one file to
# deposit. The archive is not part of the full run. In an unpacked archive `snakemake -n` has nothing to do,
# and `snakemake figures` draws lost figures again.


use rule job as report with:
    "results/report.html: the results of the run on one page, by figure and by claim"
    input:
        datasets=DATASETS,
        figures=expand("<results>/figures/{name}.nc", name=FIGURES),
        ledger="<results>/claims.json",
        article="<results>/article.html",
    output:
        html="<results>/report.html",
    pathvars:
        made="report",
    params:
        call=function("pendula.jobs.report.write_report"),
        differs=DIFFERS,


use rule job as live with:
    "results/live.html: a page that integrates the cases of Figs 2 to 4, and compares their bits"
    input:
        runs=runs_by(SETTINGS, "ode45"),
        trust="<results>/checks/trust.nc",
        chart="<results>/checks/chart.nc",
    output:
        html="<results>/live.html",
    pathvars:
        made="live",
    params:
        call=function("pendula.live.write.write_live"),


use rule job as article with:
    "results/article.pdf and article.html: what reproduces, what does not, and what is new"
    input:
        datasets=DATASETS,
        pictures=expand("<results>/figures/{name}.{kind}", name=FIGURES, kind=["nc", "png", "pdf"]),
        ledger="<results>/claims.json",
        live="<results>/live.html",
    output:
        html="<results>/article.html",
        pdf="<results>/article.pdf",
        metadata="<results>/article.yaml",
        quoted=QUOTED_COPIES,
    pathvars:
        made="article",
    params:
        call=function(
            "pendula.article.write.write_article",
            also=[version(name) for name in ("typst", "pypandoc_binary")],
        ),
        committed_results=[committed(path) for path in QUOTED],
        references=references(*PAPER_CASES),
        differs=DIFFERS,


ARCHIVE = f"<results>/archive/pendula-{pendula.__version__}.tar.gz"


use rule job as archive with:
    "Code, environment, datasets, figures and metadata in one file to deposit"
    input:
        results=lambda wildcards: sorted({*rules.all.input, *kernels(*COMPILED)}),
    output:
        archive=ARCHIVE,
        checksum=f"{ARCHIVE}.sha256",
    pathvars:
        made="archive",
    params:
        call=lambda wildcards: function(
            "pendula.jobs.pack.pack_results",
            also=[digest_of(PROJECT / name) for name in code_files(PROJECT)],
        ),
        made_by=lambda wildcards: code_of_jobs(),
        configuration=lambda wildcards: config,
