"""A process in which numba says that it is of a version that nobody has tried."""

import os
from pathlib import Path


def another_numba(folder: Path) -> dict[str, str]:
    """Return the environment of a process in which numba says that it is of an unknown version."""
    metadata = folder / "numba-0.0.1.dist-info/METADATA"
    metadata.parent.mkdir()
    metadata.write_text("Metadata-Version: 2.1\nName: numba\nVersion: 0.0.1\n")
    return os.environ | {"PYTHONPATH": str(folder)}
