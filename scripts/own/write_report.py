"""Write the report of one's own cases and sweeps."""

from pathlib import Path

from pendula.datasets import complete_or_absent
from pendula.own_cases.section import write


def write_report(html: str, cases: list[str], sweeps: dict[str, str], files: list[str]) -> None:
    """Write the page `html` about `cases`, and `sweeps` with the case of each.

    Their `files` lie below its folder.
    """
    with complete_or_absent(html) as partial:
        Path(partial).write_text(write(cases, sweeps, Path(html).parent), encoding="utf-8")


if __name__ == "__main__":
    from job import run

    run(write_report, snakemake)  # noqa: F821
