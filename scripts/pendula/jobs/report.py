"""Write the report of a run."""

from replication.report import document
from replication.report.document import ReportedPaper

PAPER = ReportedPaper(
    title="Coupled pendula under a PT-symmetric drive",
    figures=tuple(f"fig{number}" for number in range(1, 7)),
    introduction="""\
<p>These are all figures, claims and datasets of one run on the paper of E. Destyl, S. P. Nuiro, D. E. Pelinovsky and
P. Poullet, <a href="https://doi.org/10.1016/j.physleta.2017.10.021">Physics Letters A</a>
(<a href="https://arxiv.org/abs/1708.06134">arXiv</a>). <a href="article.html">The article</a> says what they mean,
<a href="live.html">the live page</a> integrates Figs 2 to 4 in your browser, and
<a href="tables/claims.md">a table</a> has all claims as text.</p>""",  # noqa: E501, as in HTML
)


def write_report(
    datasets: list[str], figures: list[str], ledger: str, differs: dict[str, str], html: str
) -> None:
    """Write the page `html` on the files of a run, which are in folders next to it.

    `figures` are the paths of their datasets, each next to its picture. `differs` holds the
    differences of the configuration from the paper's.
    """
    document.write_report(PAPER, datasets, figures, ledger, differs, html)
