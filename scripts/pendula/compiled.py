"""The decorators of every compiled function, and a cache that cannot be stale.

A `kernel` is compiled for plain values and kept on disk. What it calls may be other kernels, or
functions that are not kept by themselves: `uncached` ones, `inlined_by_numba` and
`inlined_by_llvm`. All of them become parts of the kernel, and none allocates memory (see
`kernel_parts`).

Cache. `kernel_cache` keeps machine code by its content, in one folder for all projects of a user.

Names. Machine code calls other functions by their names, in which numba puts the number that a
function has in its process. Two solvers that one builder made can so get one name, if two processes
compiled and kept them, and a third that loads both would run one of them in place of the other
(numba issue 10486). So each process counts from a random number, and so does each of its forks.

Bits. No kernel uses fastmath: without it LLVM neither reorders nor contracts operations, and +, -,
*, / and sqrt give the same bits on every processor. The functions of the C library (x^0.2, a sine)
do not, so kernels take those of `numerics` (tests/test_same_bits.py).
"""

import itertools
import os
import secrets
from collections.abc import Callable
from pathlib import Path

import numba
from numba.core.bytecode import FunctionIdentity

from .kernel_cache import kept_in
from .kernel_parts import make_kernel


def _count_from_a_random_number() -> None:
    FunctionIdentity._unique_ids = itertools.count(secrets.randbits(60))


_count_from_a_random_number()
if hasattr(os, "register_at_fork"):  # Windows has no forks
    os.register_at_fork(after_in_child=_count_from_a_random_number)


def kernel(function: Callable) -> Callable:
    """Compile a function of plain values and keep its code on disk."""
    return _compiled(function, root=kept_in())


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
    if numba.config.DISABLE_JIT:
        function.py_func = function  # by which name a compiled function has it too
        return function
    return make_kernel(function, root, **options)


@kernel
def copy(source, target):
    """Copy a state of (row, column) without the machinery of array expressions."""
    for row in range(source.shape[0]):
        for j in range(source.shape[1]):
            target[row, j] = source[row, j]
