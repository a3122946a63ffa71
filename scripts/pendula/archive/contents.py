"""Which files of a project are its own, in a clone of git and in an unpacked archive."""

import subprocess
from collections.abc import Iterable
from pathlib import Path

from .checksums import MANIFEST, listed

METADATA = ("ro-crate-metadata.json", "codemeta.json", "configuration.yaml", MANIFEST)
"""What an archive holds beside the project and its results, made anew whenever one is packed."""


class ArchiveError(Exception):
    """What keeps the project from being packed; the message says the way out."""


def code_files(project: Path) -> list[str]:
    """Return the files that git tracks or, without git, those that the manifest lists."""
    names = _tracked(project) if (project / ".git").exists() else _unpacked(project)
    absent = [name for name in names if not (project / name).is_file()]
    if absent:
        raise ArchiveError(f"{project / absent[0]} is missing; put it back, or `git rm` it")
    return sorted(names)


def check_records(records: Iterable[Path], code: Iterable[str]) -> None:
    """Refuse results that were made by code which would be left behind."""
    for record in records:
        lines = record.read_text("utf-8").splitlines()
        if left := sorted({line.split(maxsplit=1)[1] for line in lines} - set(code)):
            raise ArchiveError(f"{left[0]} made these results but is not tracked; `git add` it")


def _tracked(project: Path) -> list[str]:
    command = ["git", "-C", str(project), "ls-files", "-z"]
    try:
        run = subprocess.run(command, capture_output=True, text=True)
    except FileNotFoundError:
        raise ArchiveError(f"{project} is a clone of git; install git to pack it") from None
    if run.returncode:
        raise ArchiveError(f"git does not list the files of {project}: {run.stderr.strip()}")
    return [name for name in run.stdout.split("\0") if name]


def _unpacked(project: Path) -> list[str]:
    manifest = project / MANIFEST
    if not manifest.is_file():
        raise ArchiveError(
            f"{manifest} is missing, and {project} is no clone of git: what belongs to the project "
            "is not known; pack it from a clone or from an unpacked archive"
        )
    names = listed(manifest.read_text("utf-8"))
    return [name for name in names if name not in METADATA and not name.startswith("results/")]
