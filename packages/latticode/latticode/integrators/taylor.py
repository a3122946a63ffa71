"""The Taylor method: each step sums the power series of the solution in time.

The equations provide a rule that writes the coefficients of orders 1 to ORDER from those of order
0, the state. This module has the memory layout of the coefficients, their sums, the step control
and the loop. No step is ever rejected, and outputs between steps are sums of the same series.

Layout: LANES sites form a block, a `Vector` (see latticode.kernels.simd). For each order, a block
contains the real parts of its sites, their imaginary parts, and one number per site for the rule,
for example |A|^2 / 2. All coefficients of a block are adjacent, so that each is at a fixed distance
from the start of the block and a short chain fits into the L1 cache. The ghosts follow the blocks:
the values beyond the two ends of each component at the current order. Additional memory for the
rule is at the end (`work_arrays`, `spare_start`).

Step control: Jorba and Zou, Experimental Mathematics 14 (2005) 99. The last two coefficients give
the step at which their terms equal the tolerance. They are measured by the largest modulus of a
component, so that half of an even chain takes the same steps as the whole chain. Roots are computed
by square roots, which have the same bits on every processor.
"""

from collections.abc import Callable
from math import sqrt
from typing import Any, NamedTuple

import numpy as np

from latticode.kernels.compiled import at_any_time, in_one_pass, inlined_by_llvm, kernel
from latticode.kernels.simd import (
    LANES,
    fill,
    larger_magnitude,
    largest_lane,
    load,
    square_root,
    store,
    zero_below,
)

from . import DONE, INTERRUPTED, NOT_FINITE, SMALLEST_PART, STEP_TOO_SMALL, Outcome
from .rest import OF_SERIES, rest_level

Array = np.ndarray

# --- A power series in memory -------------------------------------------------------------------

ORDER = 16
"""Order of the method, the highest power of time in the series."""
X, Y, EXTRA = 0, LANES, 2 * LANES
"""Offsets of real parts, imaginary parts and the rule's numbers within a coefficient of a block."""
ORDER_STRIDE = 3 * LANES
"""Distance in memory from one order of a block to the next, in numbers."""
BLOCK_SIZE = (ORDER + 1) * ORDER_STRIDE
"""Distance in memory from one block to the next, in numbers."""
LEFT, RIGHT = 0, ORDER_STRIDE
"""Offsets of the left and right ghosts of a component, each with the layout of one order."""
GHOSTS_SIZE = 2 * ORDER_STRIDE
SMALLEST_COMPONENT = 2 * 3
"""Numbers in the smallest component of a state: two rows of one site and two ghosts."""
GROUP = 8
"""Number of blocks computed together in a long chain (see generation.series)."""
ALL_WAVES = -1
"""The value of `wave` if all waves are computed."""


def work_arrays(more: int) -> int:
    """Return how many work arrays of the size of a state hold a series.

    `more` is the number of additional numbers per block. The arrays suffice even for a single site,
    whose block is mostly padding.
    """
    return -(-(BLOCK_SIZE + GHOSTS_SIZE + more) // SMALLEST_COMPONENT)


WORK = work_arrays(0)
"""Number of work arrays of the size of a state."""


class PowerSeries(NamedTuple):
    """Power series of a state (row, column) with rows Re and Im of each component."""

    memory: Array  # flat: component, block, order, part, lane; then the ghosts
    components: int
    blocks: int  # of one component
    sites_in_last: int  # lanes with sites in a component's last block; the others are padding
    held: int  # blocks of one component for which there is memory
    mask: int  # block & mask is the place of a block in memory: all bits, or `held` - 1
    first: int  # the first block that moves, and the block after the last one
    stop: int
    wave: int  # the block at which a single wave starts, or ALL_WAVES (see generation.series)


@kernel
def lay_out(work: Array, y: Array) -> PowerSeries:
    """Return a series for states of the shape of `y`, in the memory of `work`."""
    sites, memory = y.shape[1] - 2, work.reshape(-1)
    blocks = (sites + LANES - 1) // LANES
    in_last = sites - (blocks - 1) * LANES
    return PowerSeries(memory, y.shape[0] // 2, blocks, in_last, blocks, -1, 0, blocks, ALL_WAVES)


@inlined_by_llvm
def block_start(series: PowerSeries, component: int, block: int) -> int:
    """Return the index in memory at which a block begins."""
    return (component * series.held + (block & series.mask)) * BLOCK_SIZE


@inlined_by_llvm
def ghosts_start(series: PowerSeries, component: int) -> int:
    """Return the index in memory at which the ghosts of a component begin."""
    return series.components * series.held * BLOCK_SIZE + component * GHOSTS_SIZE


@inlined_by_llvm
def spare_start(series: PowerSeries) -> int:
    """Return the index at which the additional memory of the rule begins (see `work_arrays`)."""
    return ghosts_start(series, series.components)


@kernel
def write_state(y: Array, series: PowerSeries) -> None:
    """Write the state `y` into order 0 of the series, and zeros into its padding."""
    for row in range(y.shape[0]):
        for b in range(series.blocks):
            place = block_start(series, row // 2, b) + row % 2 * LANES
            for j in range(LANES):
                column = 1 + b * LANES + j
                series.memory[place + j] = y[row, column] if column < y.shape[1] - 1 else 0.0


# --- Sums of the series -------------------------------------------------------------------------


@inlined_by_llvm
def sum_at(m: Array, i: int, h: float) -> Any:
    """Return the sum of the series at time `h`, for the vector of a block that begins at `i`.

    It uses Horner's rule in h^4: within each group of four orders the operations are independent,
    unlike those of Horner's rule in h.
    """
    h2 = h * h
    h3, h4 = h2 * h, h2 * h2
    total = load(m, i + ORDER * ORDER_STRIDE)
    for k in range(ORDER - 4, -1, -4):
        u = i + k * ORDER_STRIDE
        high = h3 * load(m, u + 3 * ORDER_STRIDE) + h2 * load(m, u + 2 * ORDER_STRIDE)
        total = h4 * total + (high + (h * load(m, u + ORDER_STRIDE) + load(m, u)))
    return total


@in_one_pass
def advance(series: PowerSeries, h: float, threshold: float) -> None:
    """Replace order 0 by the sum of the series at time `h`, the state after the step.

    Numbers below `threshold` are set to zero.
    """
    m = series.memory
    for block in range(series.components * series.blocks):
        for offset in range(X, Y + 1, Y - X):
            i = block * BLOCK_SIZE + offset
            store(m, i, zero_below(threshold, sum_at(m, i, h)))


@kernel
def evaluate(series: PowerSeries, h: float, y: Array) -> None:
    """Write the sum of the series at time `h` into the state `y`."""
    # The lanes of a vector cannot be stored separately. The last block, which may have padding, is
    # copied through the memory of the ghosts; they are rewritten before they are read again.
    m, spare = series.memory, ghosts_start(series, 0)
    for row in range(y.shape[0]):
        start, column = row % 2 * LANES, row * y.shape[1] + 1
        for block in range(series.blocks - 1):
            value = sum_at(m, block_start(series, row // 2, block) + start, h)
            store(y, column + block * LANES, value)
        last = series.blocks - 1
        store(m, spare, sum_at(m, block_start(series, row // 2, last) + start, h))
        for j in range(series.sites_in_last):
            y[row, 1 + last * LANES + j] = m[spare + j]


# --- Step control -------------------------------------------------------------------------------

SQUARES = 1e-280
"""Squares below this value lose digits or vanish."""
LOWEST = ORDER // 2 + 1
"""Lowest order from which the step may follow."""


@kernel
def largest_modulus(series: PowerSeries, k: int) -> float:
    """Return the largest modulus of a component in order `k`, NaN if a coefficient is NaN.

    If the squares underflow, it returns the largest real or imaginary part instead, which is good
    enough for the step. Padding is included, because it repeats the values of sites (see `close` of
    the rule).
    """
    square, part = largest_in_lanes(series, k)
    return largest_of(largest_lane(square), largest_lane(part))


@inlined_by_llvm
def largest_in_lanes(series: PowerSeries, k: int) -> tuple[Any, Any]:
    """Return the largest squared modulus and the largest part of order `k` in each lane."""
    m, square, part = series.memory, fill(0.0), fill(0.0)
    for block in range(series.components * series.blocks):
        u = block * BLOCK_SIZE + k * ORDER_STRIDE
        x, y = load(m, u + X), load(m, u + Y)
        square = larger_magnitude(square, x * x + y * y)
        part = larger_magnitude(part, larger_magnitude(x, y))
    return square, part


@inlined_by_llvm
def largest_of(square: float, part: float) -> float:
    """Return the largest modulus, from the largest squared modulus and the largest part."""
    return part if square < SQUARES else sqrt(square)


@inlined_by_llvm
def sixteenth_root(x: Any) -> Any:
    """Return x^(1/16) by square roots, which have the same bits on every machine, unlike pow."""
    return square_root(square_root(square_root(square_root(x))))


@kernel
def fifteenth_root(x: float) -> float:
    """Return x^(1/15) to four digits; infinity and NaN are returned as they are."""
    return fifteenth_root_of_finite(x) if x < np.inf else x


@inlined_by_llvm
def fifteenth_root_of_finite(x: Any) -> Any:
    """Return x^(1/15) to four digits, by 1/15 = 1/16 + 1/16^2 + 1/16^3 + ...; NaN for infinity.

    The first three factors are successive sixteenth roots. The last of these, x^(1/4096), is close
    to 1. The remaining factor is its fifteenth root, by a rational function of second order.
    """
    first = sixteenth_root(x)
    second = sixteenth_root(first)
    third = sixteenth_root(second)
    remainder = (16.0 * third + 14.0) / (14.0 * third + 16.0)
    return (first * second) * (third * remainder)


@kernel
def step_of_earlier_orders(series: PowerSeries, tolerance: float) -> float:
    """Return the step if the last two coefficients vanish, as in a series in t^4.

    It follows from the highest order from LOWEST on with a nonzero coefficient, and is infinite if
    there is none.
    """
    for k in range(ORDER - 2, LOWEST - 1, -1):
        coefficient = largest_modulus(series, k)
        if coefficient > 0.0:
            return step_of_order(coefficient, tolerance)
    return np.inf


@kernel
def step_of_order(coefficient: float, tolerance: float) -> float:
    """Return the eighth root of tolerance / coefficient, the sixteenth if the ratio is at least 1.

    It is never longer than the root of any order from LOWEST on.
    """
    root = sixteenth_root(tolerance / coefficient)
    return root * root if root < 1.0 else root


@kernel
def allowed_step(series: PowerSeries, rtol: float, atol: float) -> float:
    """Return the step at which the last two terms equal the tolerance, NaN if they overflow."""
    size = largest_modulus(series, 0)
    last_but_one, last = largest_modulus(series, ORDER - 1), largest_modulus(series, ORDER)
    if not last + last_but_one < np.inf:
        return np.nan
    tolerance = atol + rtol * size
    if last == 0.0 and last_but_one == 0.0:
        return step_of_earlier_orders(series, tolerance)
    return step_of_last_orders(last_but_one, last, tolerance)


@kernel
def step_of_last_orders(last_but_one: float, last: float, tolerance: float) -> float:
    """Return the step at which the terms of the last two orders are at most the tolerance."""
    return min(sixteenth_root(tolerance / last), fifteenth_root(tolerance / last_but_one))


def build(
    continue_series: Callable, observe: Callable, at_time: Callable = at_any_time
) -> Callable:
    """Return the solver of the equations with the rule `continue_series(system, series)`.

    The rule writes the coefficients of orders 1 to ORDER from those of order 0. The package
    describes the other arguments, and those of the solver.
    """
    driven = at_time is not at_any_time

    @in_one_pass
    def solve(system, y, times, controls, work, record, stop) -> Outcome:
        rtol, atol = controls
        t, end = times[0], times[-1]
        series = lay_out(work, y)
        shortest, threshold = SMALLEST_PART * (end - t), rest_level(y, OF_SERIES)
        i = np.int64(0)  # numba types a literal 0 separately and would compile `observe` twice
        observe(system, y, i, record)
        i += 1
        steps = 0
        write_state(y, series)
        while i < times.size:
            if stop[0]:
                return Outcome(INTERRUPTED, t, steps, 0, ORDER * steps)
            continue_series(at_time(system, t), series)
            h = allowed_step(series, rtol, atol)
            steps += 1
            if not h > shortest:  # also where h is NaN
                status = STEP_TOO_SMALL if h <= shortest else NOT_FINITE
                return Outcome(status, t, steps, 0, ORDER * steps)
            if h * (1.0 + 1e-9) >= end - t:  # avoid a last step of the size of a rounding error
                h = end - t
            t_new = end if h == end - t else t + h
            if driven:
                h = t_new - t
            while i < times.size and times[i] <= t_new:
                evaluate(series, times[i] - t, y)
                observe(system, y, i, record)
                i += 1
            advance(series, h, threshold)
            t = t_new
        return Outcome(DONE, t, steps, 0, ORDER * steps)

    return solve
