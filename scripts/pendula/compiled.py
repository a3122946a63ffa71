"""The decorators of every compiled function, and a cache that cannot be stale.

A `kernel` is compiled for plain values and kept on disk. What it calls may be other kernels, or
functions that are compiled into it: `uncached` ones, `inlined_by_numba` and `inlined_by_llvm`.

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

import numba
from numba.core import event
from numba.core.bytecode import FunctionIdentity

from . import spent
from .kernel_cache import KernelCache, kept_in


def _count_from_a_random_number() -> None:
    FunctionIdentity._unique_ids = itertools.count(secrets.randbits(60))


_count_from_a_random_number()
if hasattr(os, "register_at_fork"):  # Windows has no forks
    os.register_at_fork(after_in_child=_count_from_a_random_number)


class _Listener(event.Listener):
    """Tells how long numba compiles."""

    def on_start(self, event: event.Event) -> None:
        spent.begin("compiling")

    def on_end(self, event: event.Event) -> None:
        spent.end("compiling")


event.register("numba:compile", _Listener())


def kernel(function: Callable) -> Callable:
    """Compile a function of plain values and keep the machine code on disk."""
    compiled = numba.njit(error_model="numpy", nogil=True)(function)
    folder = kept_in()
    if folder and not numba.config.DISABLE_JIT:
        compiled._cache = KernelCache(function, folder)
    return compiled


uncached = numba.njit(error_model="numpy", nogil=True)
"""Compile a function that is built around given functions, such as a solver around its rates.

Its machine code is kept with the kernel that calls it: numba cannot cache a closure by itself.
"""

inlined_by_numba = numba.njit(error_model="numpy", nogil=True, inline="always")
"""Put a function's statements in place of its call before compilation, so that a closure that one
kernel calls is not compiled a second time by itself."""

inlined_by_llvm = numba.njit(error_model="numpy", nogil=True, forceinline=True)
"""Put a function's instructions in place of its call after compilation: a call would spill vectors
from their registers into memory."""


@kernel
def copy(source, target):
    """Copy a state of (row, column) without the machinery of array expressions."""
    for row in range(source.shape[0]):
        for j in range(source.shape[1]):
            target[row, j] = source[row, j]
