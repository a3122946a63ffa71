"""Committed results of long studies that an article quotes, copied beside it.

So each link of the article works where the results are sent or hosted alone.
"""

from collections.abc import Iterable, Mapping
from pathlib import Path
from shutil import copyfile
from typing import NamedTuple

from latticode.datasets import complete_or_absent

FOLDER = "quoted"
"""Where the copies lie, seen from the article."""
BASELINE = "tests/baseline"
"""Where the originals lie below the project."""


class LongStudy(NamedTuple):
    """The command that makes a long study, and its function where no file names it."""

    command: str
    function: str = ""


LongStudies = Mapping[str, LongStudy]
"""Long studies by the name, or by the folder, of the copies that are quoted of them."""


def copy_of(original: str) -> str:
    """Return where the article finds the copy of a file below tests/baseline."""
    return f"{FOLDER}/{original.removeprefix(f'{BASELINE}/').removeprefix('quoted/')}"


def original_of(copy: str) -> str:
    """Return the path below the project of the file whose copy the article finds at `copy`."""
    name = copy.removeprefix(f"{FOLDER}/")
    return f"{BASELINE}/{name if '/' in name else f'quoted/{name}'}"


def is_quoted(name: str) -> bool:
    """Return whether a dataset is of a long study, which a full run does not make again."""
    return name.startswith(f"{FOLDER}/")


def copy_quoted(originals: Iterable[str], copies: Iterable[str]) -> None:
    """Copy committed files to where the article links to them, in the same order."""
    for original, copy in zip(originals, copies, strict=True):
        with complete_or_absent(copy) as partial:
            copyfile(Path(original), partial)
