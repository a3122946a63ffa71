"""The files of the project: those that git tracks, or those in the manifest of an archive."""

import subprocess
from pathlib import Path

MANIFEST = "manifest-sha256.txt"
METADATA = ("ro-crate-metadata.json", "configuration.yaml", MANIFEST)
"""Files that packing adds to the project and its results."""


class ArchiveError(Exception):
    """The project cannot be packed; the message has the reason and what to do."""


def code_files(project: Path) -> list[str]:
    """Return the files that git tracks or, in an unpacked archive, those in its manifest.

    Raises ArchiveError if there is neither, or if a file is missing.
    """
    names = _tracked(project) if (project / ".git").exists() else _unpacked(project)
    if absent := [name for name in names if not (project / name).is_file()]:
        raise ArchiveError(f"{project / absent[0]} is missing: restore it, or `git rm` it")
    return sorted(names)


def _tracked(project: Path) -> list[str]:
    command = ["git", "-C", str(project), "ls-files", "-z"]
    try:
        run = subprocess.run(command, capture_output=True, text=True)
    except FileNotFoundError:
        raise ArchiveError(f"{project} is a git clone: install git to pack it") from None
    if run.returncode:
        raise ArchiveError(f"git cannot list the files of {project}: {run.stderr.strip()}")
    return run.stdout.split("\0")[:-1]


def _unpacked(project: Path) -> list[str]:
    if not (project / MANIFEST).is_file():
        raise ArchiveError(
            f"{project} is neither a git clone nor an unpacked archive ({MANIFEST} is missing): "
            "pack it from a clone or from an unpacked archive, which list the files of the project"
        )
    rows = (project / MANIFEST).read_text("utf-8").splitlines()
    names = [row.split("  ", 1)[1] for row in rows]
    return [name for name in names if name not in METADATA and not name.startswith("results/")]
