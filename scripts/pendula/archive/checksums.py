"""Checksums of an archive's files, in the format that `sha256sum --check` reads."""

import hashlib
from collections.abc import Mapping
from pathlib import Path

from pendula.sources import digest_of

MANIFEST = "manifest-sha256.txt"


def manifest(members: Mapping[str, Path | bytes]) -> bytes:
    """Return a line for each member, by name."""
    return "".join(line(name, members[name]) for name in sorted(members)).encode()


def line(name: str, content: Path | bytes) -> str:
    """Return the checksum and the name of a file on disk or of bytes."""
    if isinstance(content, bytes):
        return f"{hashlib.sha256(content).hexdigest()}  {name}\n"
    return f"{digest_of(content)}  {name}\n"


def listed(text: str) -> list[str]:
    """Return the names in a manifest."""
    return [row.split("  ", 1)[1] for row in text.splitlines()]
