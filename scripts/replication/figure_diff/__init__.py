"""Compares the files of a run with the accepted baseline, and accepts a new baseline."""

from collections import Counter
from collections.abc import Sequence
from enum import StrEnum
from typing import NamedTuple


class Status(StrEnum):
    """Possible results for a file, the most serious first."""

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
    """The results for all files; `judged` is a sentence on how strictly they were compared."""

    judged: str
    findings: Sequence[FileResult]

    @property
    def counts(self) -> dict[Status, int]:
        """Return the number of files by status."""
        counted = Counter(result.status for result in self.findings)
        return {status: counted[status] for status in Status if counted[status]}

    @property
    def faults(self) -> int:
        """Return the number of files that fail the comparison."""
        return sum(result.status.is_fault for result in self.findings)

    @property
    def lines(self) -> list[str]:
        """Return a line for each file that is not identical, then `judged` and the counts."""
        differing = [result for result in self.findings if result.status != Status.IDENTICAL]
        messages = [f"{status}: {name}: {reason}" for name, status, reason in differing]
        tally = ", ".join(f"{count} {status}" for status, count in self.counts.items())
        if Status.BEYOND in self.counts:
            tally += f". The files {Status.BEYOND} were not compared: they may be right or wrong"
        return [*messages, self.judged, tally]
