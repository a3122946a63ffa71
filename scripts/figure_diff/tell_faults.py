"""Say in one line each what is not as in the baseline, and fail if any of it is a fault."""

import sys
from collections import Counter

from pendula.figure_diff import IDENTICAL, STATUSES, load


def tell_faults(verdict: str, html: str) -> None:
    """Read the verdict, print a line for each file that is not identical, and a summary.

    Files that are nearly the same are told too, with the reason, although they fail nothing: the
    same code should make the same bits. `html` is where to look closer.
    """
    found = load(verdict)
    counts = Counter(finding.status for finding in found)
    tally = ", ".join(f"{counts[status]} {status}" for status in STATUSES if counts[status])
    lines = [finding.line for finding in found if finding.status != IDENTICAL]
    print("\n".join([*lines, f"{tally}; see {html}"]))
    if any(finding.is_fault for finding in found):
        sys.exit(1)


if __name__ == "__main__":
    from job import run

    run(tell_faults, snakemake)  # noqa: F821
