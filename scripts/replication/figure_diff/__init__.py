"""Comparison of the files of a run with the accepted baseline, and acceptance of a new baseline."""

from collections import Counter
from collections.abc import Sequence
from enum import StrEnum
from typing import NamedTuple


class Status(StrEnum):
    """Results of the comparison of a file, the most serious first."""

    DIFFERENT, DAMAGED, MISSING, EXTRA = "different", "damaged", "missing", "extra"
    BEYOND, WITHIN, IDENTICAL = "beyond comparison", "within the tolerance", "identical"

    @property
    def is_fault(self) -> bool:
        """Return whether this status fails the comparison."""
        return self not in (Status.BEYOND, Status.WITHIN, Status.IDENTICAL)


class FileResult(NamedTuple):
    """The status of a file and its reason; `name` is the path below results/."""

    name: str
    status: Status
    reason: str = ""


class ComparisonResult(NamedTuple):
    """The results of all files, and a sentence on the measure by which they were judged."""

    judged: str
    findings: Sequence[FileResult]

    @property
    def counts(self) -> dict[Status, int]:
        """Return the number of files by status."""
        counted = Counter(found.status for found in self.findings)
        return {status: counted[status] for status in Status if counted[status]}

    @property
    def faults(self) -> int:
        """Return the number of files that fail the comparison."""
        return sum(found.status.is_fault for found in self.findings)

    @property
    def lines(self) -> list[str]:
        """Return a line for each file that is not identical, then the measure and the counts."""
        differing = [result for result in self.findings if result.status != Status.IDENTICAL]
        messages = [f"{status}: {name}: {reason}" for name, status, reason in differing]
        tally = ", ".join(f"{count} {status}" for status, count in self.counts.items())
        if Status.BEYOND in self.counts:
            tally += f". The files {Status.BEYOND} were not compared: they may be right or wrong"
        return [*messages, self.judged, tally]
