"""Committed results of long studies that an article quotes, copied into its folder.

With the copies, all links of the article work in a folder without the project.
"""

from collections.abc import Iterable, Mapping
from pathlib import Path
from shutil import copyfile
from typing import NamedTuple

from latticode.datasets import complete_or_absent

FOLDER = "quoted"
"""The folder of the copies in the article's folder."""
BASELINE = "tests/baseline"
"""The folder of the originals in the project."""


class LongStudy(NamedTuple):
    """The command of a long study, and its function if the files do not record the function."""

    command: str
    function: str = ""


LongStudies = Mapping[str, LongStudy]
"""Long studies by the name or the folder of the quoted copies."""


def copy_of(original: str) -> str:
    """Return the path, relative to the article, of the copy of a file in tests/baseline."""
    return f"{FOLDER}/{original.removeprefix(f'{BASELINE}/').removeprefix('quoted/')}"


def original_of(copy: str) -> str:
    """Return the path in the project of the original of `copy`."""
    name = copy.removeprefix(f"{FOLDER}/")
    return f"{BASELINE}/{name if '/' in name else f'quoted/{name}'}"


def is_quoted(name: str) -> bool:
    """Return whether a dataset comes from a long study, which a full run does not compute."""
    return name.startswith(f"{FOLDER}/")


def copy_quoted(originals: Iterable[str], copies: Iterable[str]) -> None:
    """Copy committed files to the paths `copies`, in the same order."""
    for original, copy in zip(originals, copies, strict=True):
        with complete_or_absent(copy) as partial:
            copyfile(Path(original), partial)
