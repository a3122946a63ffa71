"""JSON results with a checksum: a changed byte causes an error, not a wrong number.

A dataset has its checksum after the last byte of HDF5 (see `netcdf`). In JSON, which allows nothing
after its end, the checksum is the last entry of the object: the SHA-256 of all bytes before it.
"""

import json
import re
from collections.abc import Mapping
from hashlib import sha256
from pathlib import Path
from typing import Any

from . import complete_or_absent
from .netcdf import readable

ENTRY = "sha256"
"""The key of the checksum; results must not use it."""

END = re.compile(rf',\n "{ENTRY}": "([0-9a-f]{{64}})"\n}}\n\Z')


def write_json(path: str | Path, content: Mapping[str, Any]) -> None:
    """Write an object with its checksum; raises the errors of `sealed`."""
    with complete_or_absent(path) as partial:
        Path(partial).write_bytes(sealed(content).encode())


def sealed(content: Mapping[str, Any]) -> str:
    """Return the JSON of a non-empty object with its checksum, with each number on its own line.

    Raises ValueError for NaN and infinity, which JSON cannot represent.
    """
    text = json.dumps(content, indent=1, ensure_ascii=False, allow_nan=False).removesuffix("\n}")
    return f'{text},\n "{ENTRY}": "{_checksum(text)}"\n}}\n'


def load_json(path: str | Path) -> dict[str, Any]:
    """Return the object that `write_json` has written, without the checksum.

    Raises DatasetError, with the remedy, if the file is missing, damaged or edited.
    """
    with readable(path):
        text = Path(path).read_bytes().decode()
        end = END.search(text)
        if end is None or end[1] != _checksum(text[: end.start()]):
            raise ValueError("its content does not match its checksum")
        return {key: value for key, value in json.loads(text).items() if key != ENTRY}


def _checksum(text: str) -> str:
    return sha256(text.encode()).hexdigest()
