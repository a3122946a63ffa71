"""Write the report of a run: one page of HTML that opens anywhere."""

from pathlib import Path

from pendula.files import complete_or_absent
from pendula.report.page import render


def write_report(html: str) -> None:
    """Write the page `html`; what it links to lies beside it."""
    with complete_or_absent(html) as partial:
        Path(partial).write_text(render("base.html.j2"), encoding="utf-8")


if __name__ == "__main__":
    from job import run

    run(write_report, snakemake)  # noqa: F821
