"""Compares what a run made with the accepted baseline: data, images, and one page about both."""

import json
from collections.abc import Iterable
from dataclasses import asdict, dataclass
from pathlib import Path

from pendula.datasets.netcdf import readable

IDENTICAL, NEARLY = "identical", "nearly the same"
DIFFERENT, DAMAGED, MISSING, EXTRA = "different", "damaged", "missing", "extra"
FAULTS = (DIFFERENT, DAMAGED, MISSING, EXTRA)
STATUSES = (*FAULTS, NEARLY, IDENTICAL)
"""The statuses in the order of the page: a person must look at the first ones."""


@dataclass(frozen=True)
class Finding:
    """The finding for one file, which `name` gives by its path below results/.

    `moved` is true where the curves are within tolerance but no longer in the same place, so that
    an image of them may not be compared pixel by pixel.
    """

    name: str
    status: str
    says: str = ""
    moved: bool = False

    @property
    def is_fault(self) -> bool:
        """Return whether this finding fails the comparison."""
        return self.status in FAULTS

    @property
    def line(self) -> str:
        """Return the finding in one line."""
        return " ".join(f"{self.status}: {self.name}: {self.says}".rstrip(": ").split())


def dump(findings: Iterable[Finding], path: str | Path) -> None:
    """Write the findings to `path` as JSON."""
    text = json.dumps([asdict(finding) for finding in findings], indent=1)
    Path(path).write_text(text + "\n", encoding="utf-8")


def load(path: str | Path) -> list[Finding]:
    """Return the findings that `dump` wrote to `path`."""
    with readable(path):
        return [Finding(**entry) for entry in json.loads(Path(path).read_text(encoding="utf-8"))]
