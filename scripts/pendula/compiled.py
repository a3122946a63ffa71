"""The two decorators of every compiled function, and a cache that cannot be stale.

numba's on-disk cache notices a change in the file of a cached function, but not in the files of
the functions that it calls. So the cache lives in a folder named after the text of the whole
library: any edit starts an empty one. No kernel uses fastmath: without it no operation is
reordered or contracted, and +, -, *, / and sqrt give the same bits on every processor.
"""

import hashlib
import os
from pathlib import Path

import numba

LIBRARY = Path(__file__).parent


def sources_digest(folder: Path = LIBRARY) -> str:
    """Return a hash of every module that a kernel could depend on (all but the plots)."""
    digest = hashlib.sha256()
    for path in sorted(folder.rglob("*.py")):
        if "plots" not in path.relative_to(folder).parts:
            digest.update(path.relative_to(folder).as_posix().encode())
            digest.update(path.read_bytes())
    return digest.hexdigest()[:16]


def _cache_folder() -> str:
    root = os.environ.get("NUMBA_CACHE_DIR") or LIBRARY / "__pycache__"
    return str(Path(root) / f"kernels-{sources_digest()}")


numba.config.CACHE_DIR = _cache_folder()

kernel = numba.njit(cache=True, error_model="numpy", nogil=True)
"""Compile a function of plain values and keep the machine code on disk."""

generic = numba.njit(error_model="numpy", nogil=True)
"""Compile a function built around given functions: it is kept with the kernel that calls it."""

inlined = numba.njit(error_model="numpy", nogil=True, inline="always")
"""The same, merged into the kernel that calls it, so that it is not compiled twice."""


@kernel
def copy(source, target):
    """Copy a state of (row, column) without the machinery of array expressions."""
    for row in range(source.shape[0]):
        for j in range(source.shape[1]):
            target[row, j] = source[row, j]
