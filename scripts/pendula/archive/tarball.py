"""A tar.gz that depends on what is packed and on nothing else: the same files, the same bytes."""

import gzip
import io
import tarfile
from collections.abc import Mapping
from pathlib import Path

MADE = 315532800  # 1980-01-01: one time for all files, or Snakemake would make some of them again


def pack(archive: Path, folder: str, members: Mapping[str, Path | bytes]) -> None:
    """Write the members, by name, below `folder`; one may be run if it may be on disk."""
    with (
        open(archive, "wb") as raw,
        # The compressed bytes also depend on the version of zlib, the files in them do not.
        gzip.GzipFile("", "wb", 9, raw, mtime=MADE) as zipped,
        tarfile.open(mode="w", fileobj=zipped, format=tarfile.USTAR_FORMAT) as tar,
    ):
        for name in sorted(members):
            _add(tar, f"{folder}/{name}", members[name])


def _add(tar: tarfile.TarFile, name: str, content: Path | bytes) -> None:
    """Add one file that belongs to nobody."""
    runs = isinstance(content, Path) and content.stat().st_mode & 0o100
    data = content if isinstance(content, bytes) else content.read_bytes()
    entry = tarfile.TarInfo(name)
    entry.size, entry.mtime, entry.mode = len(data), MADE, 0o755 if runs else 0o644
    tar.addfile(entry, io.BytesIO(data))
