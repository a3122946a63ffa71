"""Say in one line each what differs from the baseline, and fail if anything does."""

import sys
from collections import Counter

from pendula.figure_diff import STATUSES, load


def tell_faults(verdict: str, html: str) -> None:
    """Read the verdict, print its faults and a summary; `html` is where to look closer."""
    found = load(verdict)
    faults = [finding.line for finding in found if finding.is_fault]
    counts = Counter(finding.status for finding in found)
    tally = ", ".join(f"{counts[status]} {status}" for status in STATUSES if counts[status])
    print("\n".join([*faults, f"{tally}; see {html}"]))
    if faults:
        sys.exit(1)


if __name__ == "__main__":
    from job import run

    run(tell_faults, snakemake)  # noqa: F821
