"""What generated kernels take from the library: their system, sine and cosine, and imports.

A generated module imports all of this. It stands in a file, so that a change of any of it compiles
the kernels again and reruns the jobs that call them.
"""
# ruff: noqa: F401

from typing import NamedTuple

import numpy as np

from pendula.compiled import inlined_by_llvm, kernel
from pendula.integrators import taylor
from pendula.integrators.taylor import EXTRA, ORDER, ORDER_STRIDE, X, Y, block_start, spare_start
from pendula.numerics import elementary
from pendula.numerics.elementary import HALF_PI
from pendula.simd import (
    LANES,
    define_shift,
    fill,
    left_neighbours,
    load,
    right_neighbours,
    store,
)

from .chain import at_every_site, close, widen
from .series import in_waves, sides_of


class System(NamedTuple):
    """What the kernels of any traced model are given."""

    constants: tuple[float, ...]
    clocks: tuple[float, ...]  # the functions of the time, and behind them their derivatives
    at: np.ndarray  # (row, 1 + site), parameters that depend on the site, with room for a vector
    wide: np.ndarray  # (row, reach + site), room for a state with more ghost columns
    left: int
    right: int


# --- Sine and cosine of numbers or vectors of sites, with the same bits on every machine ----------

sine_near_zero, cosine_near_zero = map(
    inlined_by_llvm, (elementary.sine_near_zero, elementary.cosine_near_zero)
)


@inlined_by_llvm
def _whole(x):
    """Return the whole number nearest to x, for abs(x) < 2^51; x is a number or a Vector."""
    return -(6755399441055744.0 - (6755399441055744.0 + x))  # 1.5 * 2^52, where doubles are whole


@inlined_by_llvm
def _reduced(x):
    """Return sin r, cos r, o and s of x = r + (o + 2 j) pi / 2, abs(r) <= pi / 4.

    o is -1, 0 or 1, and s = (-1)^j. So sin x = s (sin r + o cos r) with one of the two terms, and
    no lane of a vector needs another code than the next.
    """
    quarters = _whole((1.0 / HALF_PI[0]) * x)
    near = (x - HALF_PI[0] * quarters) - HALF_PI[1] * quarters
    rest = -(HALF_PI[2] * quarters)
    halves = _whole(0.5 * quarters)
    odd = quarters - 2.0 * halves
    parity = halves - 2.0 * _whole(0.5 * halves)
    sign = 1.0 - 2.0 * (parity * parity)
    return sine_near_zero(near, rest), cosine_near_zero(near, rest), odd, sign


@inlined_by_llvm
def sine_and_cosine(x):
    """Return sin x and cos x with errors of some 1e-16, for angles of up to thousands of turns."""
    s, c, odd, sign = _reduced(x)
    even = 1.0 - odd * odd
    return sign * (even * s + odd * c), sign * (even * c - odd * s)
