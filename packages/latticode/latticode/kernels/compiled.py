"""Decorators that compile functions and cache their machine code.

A `kernel` is compiled for numbers, arrays and named tuples, and cached on disk. It may call other
kernels, and functions without a cache entry: `uncached`, `inlined_by_llvm` and `in_one_pass`.
All of these become subroutines of the kernel, and none allocates memory.

Two compilers. `inside_numba` compiles and caches kernels faster than numba does, but depends on
private parts of numba. With versions of numba other than TESTED, its public compiler is used.

Names. numba numbers the functions of a process, and machine code calls a function by a name with
this number. Two solvers from one builder, cached by two processes, can thus get the same name. A
third process that loads both would run one of them instead of the other (numba issue 10486). Names
of functions without a cache entry therefore contain a random number.

Bits. No kernel uses fastmath. LLVM then neither reorders nor contracts operations, and + - * / and
sqrt give the same bits on every processor. Functions of the C library (a power, a sine) do not, so
kernels call those of `numerics` instead (tests/test_same_bits.py).
"""

import secrets
import warnings
from collections.abc import Callable
from importlib.metadata import version
from pathlib import Path
from typing import Any

import numba
import numpy as np

from . import DISABLED
from .cache import folder_of, kept_in

if numba.config.DISABLE_JIT:
    raise RuntimeError(DISABLED)

TESTED = tuple(f"0.{minor}" for minor in range(61, 69))
"""Versions of numba with which `inside_numba` was tested."""


def _with_numba_alone(function: Callable, root: Path | None, **options: Any) -> Callable:
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
    from .one_pass import in_one_pass
else:
    make_kernel, in_one_pass = _with_numba_alone, None
    warnings.warn(
        f"kernels take several times as long to compile with numba {version('numba')}; results are"
        f" the same. The faster compiler was tested with numba {', '.join(TESTED)}",
        stacklevel=2,
    )


def kernel(function: Callable) -> Callable:
    """Return the compiled function, whose machine code is cached on disk."""
    return _compiled(function, kept_in())


def uncached(function: Callable) -> Callable:
    """Return a compiled closure, such as a solver built around its rates.

    It is cached with the kernel that calls it, because the text of a closure does not identify it.
    """
    return _compiled(function)


def inlined_by_llvm(function: Callable) -> Callable:
    """Return a function that LLVM inlines, because a call would move vectors to memory."""
    return _compiled(function, forceinline=True)


in_one_pass = in_one_pass or inlined_by_llvm
"""Returns a function that is translated to LLVM's code with all compiled functions that it calls,
because numba's compiler would take longer; see the module `one_pass`."""


def _compiled(function: Callable, root: Path | None = None, **options: Any) -> Callable:
    if not root:
        function.__qualname__ += f"_{secrets.token_hex(8)}"
    return make_kernel(function, root, **options)


@kernel
def copy(source: np.ndarray, target: np.ndarray) -> None:
    """Copy a state (row, column); an array expression would take longer to compile."""
    for row in range(source.shape[0]):
        for j in range(source.shape[1]):
            target[row, j] = source[row, j]


@kernel
def at_any_time(system: Any, t: float) -> Any:
    """Return the system itself: the `at_time` of equations that do not depend on time."""
    return system
