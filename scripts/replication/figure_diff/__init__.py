"""Compares what a run made with the accepted baseline, and takes a run as the new baseline."""

from collections import Counter
from collections.abc import Sequence
from enum import StrEnum
from typing import NamedTuple


class Status(StrEnum):
    """What is found of a file; a person must look at the first ones first."""

    DIFFERENT, DAMAGED, MISSING, EXTRA = "different", "damaged", "missing", "extra"
    BEYOND, WITHIN, IDENTICAL = "beyond comparison", "within the tolerance", "identical"

    @property
    def is_fault(self) -> bool:
        """Return whether this status fails the comparison."""
        return self not in (Status.BEYOND, Status.WITHIN, Status.IDENTICAL)


class FileResult(NamedTuple):
    """The finding for one file, which `name` gives by its path below results/."""

    name: str
    status: Status
    reason: str = ""


class ComparisonResult(NamedTuple):
    """What was found of all files, and in words by which measure they were judged."""

    judged: str
    findings: Sequence[FileResult]

    @property
    def counts(self) -> dict[Status, int]:
        """Return how many files have each status that occurs."""
        counted = Counter(found.status for found in self.findings)
        return {status: counted[status] for status in Status if counted[status]}

    @property
    def faults(self) -> int:
        """Return how many files fail the comparison."""
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
