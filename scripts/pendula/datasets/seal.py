"""A seal at the end of a dataset, by which a bit that a disk gives back wrong is found.

HDF5 can keep a checksum of an array of numbers, and `netcdf` asks it for that, so that any reader
is told of a changed number. HDF5 keeps none of words, of single numbers, and of the tables that say
where the pieces of an array lie; where such a table is damaged, the library of HDF5 may crash. So
`seal` adds a last line to each file, which HDF5 does not look at, with the SHA-256 of all bytes
before it. `check` compares it before HDF5 opens the file.
"""

from hashlib import sha256
from pathlib import Path

from . import DatasetError

MARK = b"\nSHA-256 of all bytes before this line: "
LENGTH = len(MARK) + 64 + 1
"""Bytes of the line: the mark, 64 hexadecimal digits and the end of the line."""


def seal(path: str | Path) -> None:
    """Add the line to a file that is written and closed."""
    line = _line(Path(path).read_bytes())
    with open(path, "ab") as file:
        file.write(line)


def check(path: str | Path) -> None:
    """Raise DatasetError if a sealed file is not what was written.

    A file without the line is left to HDF5: other programs write such files.
    """
    content = Path(path).read_bytes()
    written, line = content[:-LENGTH], content[-LENGTH:]
    if line.startswith(MARK) and line != _line(written):
        raise DatasetError("its content is not the one that was written")


def _line(content: bytes) -> bytes:
    return MARK + sha256(content).hexdigest().encode() + b"\n"
