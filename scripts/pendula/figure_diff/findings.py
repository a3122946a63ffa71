"""What the comparison of one file found, in a word and in one line."""

import json
from collections.abc import Iterable
from dataclasses import asdict, dataclass
from pathlib import Path

IDENTICAL, NEARLY = "identical", "nearly the same"
DIFFERENT, DAMAGED, MISSING, EXTRA = "different", "damaged", "missing", "extra"
FAULTS = (DIFFERENT, DAMAGED, MISSING, EXTRA)
STATUSES = (*FAULTS, NEARLY, IDENTICAL)
"""In the order of the page: what a person must look at comes first."""


@dataclass(frozen=True)
class Finding:
    """One file, named as below results/; `moved`: its curves are alike, but not in place."""

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
    """Write the findings as JSON."""
    text = json.dumps([asdict(finding) for finding in findings], indent=1)
    Path(path).write_text(text + "\n", encoding="utf-8")


def load(path: str | Path) -> list[Finding]:
    """Read them again."""
    return [Finding(**entry) for entry in json.loads(Path(path).read_text(encoding="utf-8"))]
