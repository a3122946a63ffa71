"""The decorators of every compiled function, and a cache that cannot be stale.

A `kernel` is compiled for plain values and kept on disk. What it calls may be other kernels, or
functions that are not kept by themselves: `uncached` ones, `inlined_by_numba` and
`inlined_by_llvm`. All of them become parts of the kernel, and none allocates memory.

Two ways. `inside_numba` compiles and keeps kernels faster than numba does, and rests on private
parts of the versions TESTED. With any other version numba compiles and keeps them by itself.

Names. Machine code calls other functions by their names, in which numba puts the number that a
function has in its process. Two solvers that one builder made can so get one name, if two processes
compiled and kept them, and a third that loads both would run one of them in place of the other
(numba issue 10486). So functions that are not kept by themselves have a random number in the name.

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
"""Versions of numba whose private parts are those that `inside_numba` uses."""


def _with_numba_alone(function: Callable, root: Path | None, **options) -> Callable:
    """Return the compiled function, kept by numba's own cache in the folder of its module's text.

    numba does not see that a function in another file has changed, but such a folder does.
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
    """Compile a function of plain values and keep its code on disk."""
    return _compiled(function, kept_in())


def uncached(function: Callable) -> Callable:
    """Compile a function that is built around given functions, such as a solver around its rates.

    Its code is kept with the kernel that calls it: a closure cannot be named by its text.
    """
    return _compiled(function)


def inlined_by_numba(function: Callable) -> Callable:
    """Put a function's statements in place of its call before compilation, so that a closure that
    one kernel calls is not compiled a second time by itself."""
    return _compiled(function, inline="always")


def inlined_by_llvm(function: Callable) -> Callable:
    """Put a function's instructions in place of its call after compilation: a call would spill
    vectors from their registers into memory."""
    return _compiled(function, forceinline=True)


def _compiled(function: Callable, root: Path | None = None, **options) -> Callable:
    if not root:
        function.__qualname__ += f"_{secrets.token_hex(8)}"
    return make_kernel(function, root, **options)


@kernel
def copy(source, target):
    """Copy a state of (row, column) without the machinery of array expressions."""
    for row in range(source.shape[0]):
        for j in range(source.shape[1]):
            target[row, j] = source[row, j]
