"""The article on this replication: its settings, and the job that writes it."""

from collections.abc import Mapping
from pathlib import Path

from replication.article.quoted import copy_quoted
from replication.article.render import Article
from replication.results import Results

from pendula import RELEASED

from .live_figures import gather_live_parts
from .values import LONG_STUDIES, gather

ARTICLE = Article(
    folder=Path(__file__).parent,
    title="[Re] Coupled pendula chains under parametric PT-symmetric driving force",
    released=RELEASED,
    gather=gather,
    long_studies=LONG_STUDIES,
    navigation='<a href="report.html">The report, with every verdict and its data</a> · '
    '<a href="live.html">the cases in your browser</a> · <a href="article.pdf">PDF</a>',
    rights="The code has the license BSD-3-Clause, the data and the text have CC-BY-4.0.",
)


def write_article(
    datasets: list[str],
    pictures: list[str],
    ledger: str,
    committed_results: list[str],
    differs: Mapping[str, str],
    html: str,
    pdf: str,
    metadata: str,
    quoted: list[str],
    live: str,
    references: list[str],
) -> None:
    """Write the three files of the article, and `quoted`, copies of `committed_results`.

    `differs` holds the differences of the configuration from the paper's. If there are any, a
    notice replaces the article, which is about the paper's cases. `live` is the live page with the
    solver that runs below figures. `references` are the trajectories in multiprecision.
    """
    copy_quoted(committed_results, quoted)
    results = Results([*datasets, *pictures, ledger, *quoted], html, differs=differs)
    live_parts = None if differs else gather_live_parts(results, live, references)
    ARTICLE.write(results, html, pdf, metadata, live_parts)
