"""Compares what a run made with the accepted baseline: data, images, and one page about both."""

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass
from enum import StrEnum
from typing import NamedTuple

IDENTICAL, NEARLY = "identical", "nearly the same"
DIFFERENT, DAMAGED, MISSING, EXTRA = "different", "damaged", "missing", "extra"
FAULTS = (DIFFERENT, DAMAGED, MISSING, EXTRA)
STATUSES = (*FAULTS, NEARLY, IDENTICAL)
"""The statuses in the order of the page: a person must look at the first ones."""


IF_MEANT = (
    "agree within the allowances: if you meant the change, look at them and accept them "
    "(`snakemake accept_figures`)"
)


class Motion(StrEnum):
    """How far the numbers of a dataset moved: it decides how all that shows them is judged."""

    NONE = "they have the accepted bits"
    UNSEEN = "they have other bits, and no eye sees the difference"
    SEEN = "they moved visibly, within what chaos allows"
    WRONG = "they moved by more than is allowed, or cannot be read"


@dataclass(frozen=True)
class Finding:
    """The finding for one file, which `name` gives by its path below results/."""

    name: str
    status: str
    says: str = ""
    visible: bool = False
    """Of a dataset: whether curves within tolerance moved so far that a picture shows it."""
    agrees: bool = False
    """Of a fault: whether the allowances would excuse it, so that only its bits are wrong."""

    @property
    def is_fault(self) -> bool:
        """Return whether this finding fails the comparison."""
        return self.status in FAULTS

    @property
    def motion(self) -> Motion:
        """Return how far the numbers of this dataset moved."""
        if self.is_fault:
            return Motion.WRONG
        if self.status == IDENTICAL:
            return Motion.NONE
        return Motion.SEEN if self.visible else Motion.UNSEEN

    @property
    def line(self) -> str:
        """Return the finding in one line."""
        return " ".join(f"{self.status}: {self.name}: {self.says}".rstrip(": ").split())


class Verdict(NamedTuple):
    """What was found of all files, and in words by which measure they were judged."""

    judged: str
    findings: Sequence[Finding]

    @property
    def failed(self) -> bool:
        """Return whether any finding is a fault."""
        return any(found.is_fault for found in self.findings)

    @property
    def lines(self) -> list[str]:
        """Return a line for each file that is not identical, then the measure and the counts.

        Files that are nearly the same are told too, with the reason, although they fail nothing.
        """
        counts = Counter(found.status for found in self.findings)
        tally = ", ".join(f"{counts[status]} {status}" for status in STATUSES if counts[status])
        told = [found.line for found in self.findings if found.status != IDENTICAL]
        agree = sum(found.agrees for found in self.findings)
        if agree:
            tally += f". {agree} of the different files {IF_MEANT}"
        return [*told, self.judged, tally]
