"""Write the report of a run."""

from pathlib import Path

from latticode.datasets.netcdf import read
from replication.article.page import places_of
from replication.report import document
from replication.report.described import MapLink
from replication.report.document import ReportedPaper

PAPER = ReportedPaper(
    title="Coupled pendula under a PT-symmetric drive",
    figures=tuple(f"fig{number}" for number in range(1, 7)),
    introduction="""\
<p>These are all figures, claims and datasets of one run on the paper of E. Destyl, S. P. Nuiro, D. E. Pelinovsky and
P. Poullet, <a href="https://doi.org/10.1016/j.physleta.2017.10.021">Physics Letters A</a>
(<a href="https://arxiv.org/abs/1708.06134">arXiv</a>). <a href="article.html">The article</a> explains them,
<a href="live.html">the live page</a> integrates Figs 2 to 4 in your browser, and
<a href="tables/claims.md">a table</a> has all claims as text.</p>""",  # noqa: E501, as in HTML
)


def write_report(
    datasets: list[str],
    figures: list[str],
    ledger: str,
    article: str,
    differs: dict[str, str],
    html: str,
) -> None:
    """Write the page `html` on the files of a run, which are in folders next to it.

    `figures` are the paths of their datasets, each next to its picture. `differs` holds the
    differences of the configuration from the paper's. `article` is the page to which it links.
    """
    data = {Path(path).stem: path for path in figures}
    fates = read(data["fates"])
    at_start = f"a_re={{x}}&b_re={{y}}&end_time={fates.attrs['end_time']:g}"
    maps = {
        "stability_chart": [MapLink("Ω", "γ", "live.html#case=fig4_small&omega={x}&gamma={y}")],
        "fates": [
            MapLink("A₀", "B₀", f"live.html#case=fig3_large&omega={omega:g}&{at_start}")
            for omega in fates["omega"].values
        ],
    }
    in_article = places_of(Path(article))
    document.write_report(PAPER, datasets, figures, ledger, differs, html, maps, in_article)
