"""Write the report of a run: one page of HTML that opens anywhere."""

import json
from pathlib import Path

from job import TOOK
from pendula.datasets import complete_or_absent
from pendula.report import document
from pendula.report.results import Results
from pendula.report.sections import Measured


def write_report(
    datasets: list[str],
    pictures: list[str],
    ledger: str,
    speed_data: str,
    speed_table: str,
    speed_pictures: list[str],
    sources: list[str],
    speed_is_fresh: bool,
    settings: str,
    differs: dict[str, str],
    logs: str,
    html: str,
) -> None:
    """Write the page `html` on the files of a run, which lie beside it in folders.

    `sources` are the records of code and the references,
    `settings` the configuration as text, `differs` says where it is not the paper's, and `logs` is
    the folder of the jobs' logs.
    """
    files = [*datasets, *pictures, ledger, speed_data, speed_table, *speed_pictures, *sources]
    results = Results(files, html, json.loads(settings), differs)
    (times, table), drawn, made_of = (
        [Path(path).relative_to(Path(html).parent).as_posix() for path in paths]
        for paths in ([speed_data, speed_table], speed_pictures, sources)
    )
    measured = Measured(times, table, drawn, speed_is_fresh)
    made = {"inputs": made_of, "settings": settings, "logs": logs, "took": TOOK}
    with complete_or_absent(html) as partial:
        Path(partial).write_text(document.write(results, measured, made), "utf-8")


if __name__ == "__main__":
    from job import run

    run(write_report, snakemake)  # noqa: F821
