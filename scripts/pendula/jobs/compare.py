"""Compare a run with the accepted results.

    python -m pendula.jobs.compare tests/baseline RESULTS...

measures the scatter of chaotic numbers among folders of valid results, such as those of
`.ci/elsewhere moved`, and writes it into the baseline.
"""

import sys
from pathlib import Path

from replication.figure_diff import comparison_page
from replication.figure_diff.chaos import Trust
from replication.figure_diff.scatter import write_scatter

TRUST = Trust(
    dataset="checks/trust.nc",
    variable="difference",
    labels={"solver": "taylor"},
    time="tau",
    steps=("tau", "snapshot", "snapshot_tau"),
)
"""Errors of the Taylor method against the references, which are only rounding errors."""


def compare_results(
    results: list[str],
    made: str,
    baseline: str,
    configuration: dict,
    any_bits: bool,
    html: str,
    verdict: str,
) -> None:
    """Compare a run's files in the folder `made` with a baseline, and write page and verdict."""
    comparison_page.compare_results(
        results, made, baseline, configuration, any_bits, html, verdict, TRUST
    )


if __name__ == "__main__":
    folder, *runs = map(Path, sys.argv[1:])
    write_scatter(folder, runs, TRUST)
