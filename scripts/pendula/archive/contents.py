"""What an archive holds: the files of the project, the run's configuration, and their checksums.

The archive is a tar.gz whose bytes depend on its members only, so that two people who pack the same
files can compare one checksum.
"""

import gzip
import hashlib
import io
import subprocess
import tarfile
from collections.abc import Iterable, Mapping
from pathlib import Path

import yaml

from pendula.sources import digest_of

MANIFEST = "manifest-sha256.txt"

METADATA = ("ro-crate-metadata.json", "configuration.yaml", MANIFEST)
"""Files that an archive holds beside the project and its results; packing makes them anew."""

MADE = 315532800
"""All files get this time, 1980-01-01: if times differed, Snakemake would make some files again."""

Content = Path | bytes
"""A member of an archive: a file on disk, or the bytes of one."""


class ArchiveError(Exception):
    """The project cannot be packed; the message says why, and what to do."""


def code_files(project: Path) -> list[str]:
    """Return the files that git tracks or, without git, those that the manifest lists."""
    names = _tracked(project) if (project / ".git").exists() else _unpacked(project)
    absent = [name for name in names if not (project / name).is_file()]
    if absent:
        raise ArchiveError(f"{project / absent[0]} is missing; put it back, or `git rm` it")
    return sorted(names)


def _tracked(project: Path) -> list[str]:
    command = ["git", "-C", str(project), "ls-files", "-z"]
    try:
        run = subprocess.run(command, capture_output=True, text=True)
    except FileNotFoundError:
        raise ArchiveError(f"{project} is a clone of git; install git to pack it") from None
    if run.returncode:
        raise ArchiveError(
            f"git does not list the files of {project}: {run.stderr.strip()}; mend the clone, or "
            "pack from a fresh one"
        )
    return [name for name in run.stdout.split("\0") if name]


def _unpacked(project: Path) -> list[str]:
    manifest = project / MANIFEST
    if not manifest.is_file():
        raise ArchiveError(
            f"{manifest} is missing, and {project} is no clone of git: what belongs to the project "
            "is not known; pack it from a clone or from an unpacked archive"
        )
    names = names_in(manifest.read_text("utf-8"))
    return [name for name in names if name not in METADATA and not name.startswith("results/")]


def check_code(made_by: Iterable[str], code: Iterable[str]) -> None:
    """Raise ArchiveError if files that made results are not among `code`, which git tracks."""
    if left := sorted(set(made_by) - set(code)):
        raise ArchiveError(f"{left[0]} made these results but is not tracked; `git add` it")


def manifest(members: Mapping[str, Content]) -> bytes:
    """Return a line of checksum and name for each member, as `sha256sum --check` reads them."""
    return "".join(checksum_line(name, members[name]) for name in sorted(members)).encode()


def checksum_line(name: str, content: Content) -> str:
    """Return the SHA-256 of the content, and the name."""
    is_file = isinstance(content, Path)
    digest = digest_of(content) if is_file else hashlib.sha256(content).hexdigest()
    return f"{digest}  {name}\n"


def names_in(text: str) -> list[str]:
    """Return the names in a manifest."""
    return [row.split("  ", 1)[1] for row in text.splitlines()]


def dump_configuration(configuration: dict) -> bytes:
    """Return the configuration of a run as YAML, sorted by key, so that it can be run again."""
    return yaml.safe_dump(_plain(configuration), allow_unicode=True).encode()


def _plain(value):
    """Return new dictionaries and lists: YAML would write one that occurs twice as an alias."""
    if isinstance(value, dict):
        return {key: _plain(entry) for key, entry in value.items()}
    return [_plain(entry) for entry in value] if isinstance(value, list | tuple) else value


def pack(archive: Path, folder: str, members: Mapping[str, Content]) -> None:
    """Write the members by name below `folder`; a member that runs on disk runs when unpacked."""
    with (
        open(archive, "wb") as raw,
        # The compressed bytes also depend on the version of zlib, the files in them do not. Level 9
        # would take twice the time for two thousandths of the size.
        gzip.GzipFile("", "wb", 6, raw, mtime=MADE) as zipped,
        tarfile.open(mode="w", fileobj=zipped, format=tarfile.USTAR_FORMAT) as tar,
    ):
        for name, content in sorted(members.items()):
            runs = isinstance(content, Path) and content.stat().st_mode & 0o100
            data = content if isinstance(content, bytes) else content.read_bytes()
            entry = tarfile.TarInfo(f"{folder}/{name}")  # belongs to nobody
            entry.size, entry.mtime, entry.mode = len(data), MADE, 0o755 if runs else 0o644
            tar.addfile(entry, io.BytesIO(data))
