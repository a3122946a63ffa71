"""Decorators that compile functions and cache their machine code.

A `kernel` is compiled for numbers, arrays and named tuples, and cached on disk. It may call other
kernels and functions that have no cache entry of their own: `uncached`, `inlined_by_numba` and
`inlined_by_llvm`. All of them become subroutines of the kernel, and none allocates memory.

Two compilers. `inside_numba` compiles and caches kernels faster than numba does, but uses private
parts of numba in the versions TESTED. With any other version, numba's public compiler is used.

Names. Machine code calls functions by names that contain numba's number of the function in its
process. Two solvers from one builder, cached by two processes, can thus get the same name, and a
third process that loads both would run one of them in place of the other (numba issue 10486).
Functions without a cache entry therefore have a random number in their names.

Bits. No kernel uses fastmath: without it LLVM neither reorders nor contracts operations, and +, -,
*, / and sqrt give the same bits on every processor. The functions of the C library (x^0.2, a sine)
do not, so kernels take those of `numerics` (tests/test_same_bits.py).
"""

import secrets
import warnings
from collections.abc import Callable
from importlib.metadata import version
from pathlib import Path

import numba

from . import DISABLED
from .cache import folder_of, kept_in

if numba.config.DISABLE_JIT:
    raise RuntimeError(DISABLED)

TESTED = tuple(f"0.{minor}" for minor in range(61, 69))
"""Versions of numba with which `inside_numba` was tested."""


def _with_numba_alone(function: Callable, root: Path | None, **options) -> Callable:
    """Return the function compiled and cached by numba itself.

    The cache folder is named by a hash of the module and its imports, because numba does not notice
    changes in other files.
    """
    before, numba.config.CACHE_DIR = numba.config.CACHE_DIR, str(folder_of(function, root) or "")
    try:
        return numba.njit(function, error_model="numpy", nogil=True, cache=bool(root), **options)
    finally:
        numba.config.CACHE_DIR = before


if version("numba").rpartition(".")[0] in TESTED:
    from .inside_numba import make_kernel
else:
    make_kernel = _with_numba_alone
    warnings.warn(
        f"numba {version('numba')} compiles kernels in its own way, which takes twice as long and"
        f" gives the same numbers; the faster way was tested with numba {', '.join(TESTED)}",
        stacklevel=2,
    )


def kernel(function: Callable) -> Callable:
    """Return the compiled function, whose machine code is cached on disk."""
    return _compiled(function, kept_in())


def uncached(function: Callable) -> Callable:
    """Return a compiled closure, such as a solver built around its rates.

    It is cached with the kernel that calls it, because its text does not identify a closure.
    """
    return _compiled(function)


def inlined_by_numba(function: Callable) -> Callable:
    """Return a function inlined before compilation: its only caller need not compile it twice."""
    return _compiled(function, inline="always")


def inlined_by_llvm(function: Callable) -> Callable:
    """Return a function inlined after compilation: a call would spill vectors into memory."""
    return _compiled(function, forceinline=True)


def _compiled(function: Callable, root: Path | None = None, **options) -> Callable:
    if not root:
        function.__qualname__ += f"_{secrets.token_hex(8)}"
    return make_kernel(function, root, **options)


@kernel
def copy(source, target) -> None:
    """Copy a state (row, column); array expressions would take longer to compile."""
    for row in range(source.shape[0]):
        for j in range(source.shape[1]):
            target[row, j] = source[row, j]
