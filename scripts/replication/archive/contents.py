"""Which files belong to the project: those that git tracks, or those that an archive listed."""

import subprocess
from pathlib import Path

MANIFEST = "manifest-sha256.txt"
METADATA = ("ro-crate-metadata.json", "configuration.yaml", MANIFEST)
"""Files that an archive holds beside the project and its results; packing makes them anew."""


class ArchiveError(Exception):
    """The project cannot be packed; the message says why, and what to do."""


def code_files(project: Path) -> list[str]:
    """Return the files that git tracks or, in an unpacked archive, those that it listed.

    Raise ArchiveError if neither is known, or if a file is missing.
    """
    names = _tracked(project) if (project / ".git").exists() else _unpacked(project)
    if absent := [name for name in names if not (project / name).is_file()]:
        raise ArchiveError(f"{project / absent[0]} is missing; put it back, or `git rm` it")
    return sorted(names)


def _tracked(project: Path) -> list[str]:
    command = ["git", "-C", str(project), "ls-files", "-z"]
    try:
        run = subprocess.run(command, capture_output=True, text=True)
    except FileNotFoundError:
        raise ArchiveError(f"{project} is a clone of git; install git to pack it") from None
    if run.returncode:
        raise ArchiveError(f"git does not list the files of {project}: {run.stderr.strip()}")
    return run.stdout.split("\0")[:-1]


def _unpacked(project: Path) -> list[str]:
    if not (project / MANIFEST).is_file():
        raise ArchiveError(
            f"{project / MANIFEST} is missing, and {project} is no clone of git: what belongs to "
            "the project is not known; pack it from a clone or from an unpacked archive"
        )
    rows = (project / MANIFEST).read_text("utf-8").splitlines()
    names = [row.split("  ", 1)[1] for row in rows]
    return [name for name in names if name not in METADATA and not name.startswith("results/")]
