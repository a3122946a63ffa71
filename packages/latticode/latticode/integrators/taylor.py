"""The Taylor method: each step sums the power series of the solution, as far as its terms allow.

The system gives a rule that continues a power series in time: from the coefficients of order 0,
which are the state, it writes those of the orders 1 to ORDER. What stands here is where the
coefficients lie in memory, their sums, the step that they allow, and the loop. No step is ever
rejected, and outputs between steps are sums of the same series.

Layout. Sites go LANES to a block, a `Vector` (see latticode.kernels.simd). A block holds, order
after order, the real parts of its sites, their imaginary parts, and a number a site for the rule,
which keeps |A|^2 / 2 there. All coefficients of a block lie side by side: each is at a fixed
distance from the start of the block, and a short chain fits into the fastest cache. Behind all
blocks lie the ghosts, what each component sees beyond its two ends, for the order that is at work,
and behind them what a rule needs beside that (`work_arrays`, `spare_start`).

Step control. Jorba and Zou, Experimental Mathematics 14 (2005) 99: the last two
coefficients give the step at which their terms fall below the tolerance. They are measured by the
largest modulus of a component, so that half of an even chain takes the same steps as the whole.
Roots are taken by square roots alone, whose bits are the same on every processor.
"""

from math import sqrt
from typing import NamedTuple

import numpy as np

from latticode.kernels.compiled import inlined_by_llvm, inlined_by_numba, kernel
from latticode.kernels.simd import (
    LANES,
    fill,
    larger_magnitude,
    largest_lane,
    load,
    store,
    zero_below,
)

from . import DONE, INTERRUPTED, NOT_FINITE, SMALLEST_PART, STEP_TOO_SMALL, Outcome
from .autonomous import at_any_time
from .rest import OF_SERIES, rest_level

# --- A power series in memory -------------------------------------------------------------------

ORDER = 16
"""Order of the method: the highest exponent of time in the series."""
X, Y, EXTRA = 0, LANES, 2 * LANES
"""Where real parts, imaginary parts and the rule's own numbers lie in a coefficient of a block."""
ORDER_STRIDE = 3 * LANES
"""Numbers from one order of a block to the next."""
BLOCK_SIZE = (ORDER + 1) * ORDER_STRIDE
"""Numbers from one block to the next."""
LEFT, RIGHT = 0, ORDER_STRIDE
"""Where the ghosts to the left and to the right of a component lie, each laid out as one order."""
GHOSTS_SIZE = 2 * ORDER_STRIDE
_SMALLEST_COMPONENT = 2 * 3  # numbers of a component of one site: two rows of a site and two ghosts


def work_arrays(more: int) -> int:
    """Return how many work arrays of the size of a state hold a series, and `more` numbers a block.

    That is enough for a single site, whose block is mostly padding.
    """
    return -(-(BLOCK_SIZE + GHOSTS_SIZE + more) // _SMALLEST_COMPONENT)


WORK = work_arrays(0)
"""Work arrays of the size of a state."""


class PowerSeries(NamedTuple):
    """Power series of a state of (row, column), whose rows are Re and Im of each component."""

    memory: np.ndarray  # flat: component, block, order, part, lane; then the ghosts
    components: int
    blocks: int  # of one component
    sites_in_last: int  # lanes of a component's last block that are sites, the rest is padding


@inlined_by_llvm
def lay_out(work, y):
    """Return a series of states like `y` in the memory of `work`."""
    sites = y.shape[1] - 2
    blocks = (sites + LANES - 1) // LANES
    return PowerSeries(work.reshape(-1), y.shape[0] // 2, blocks, sites - (blocks - 1) * LANES)


@inlined_by_llvm
def block_start(series, component, block):
    """Return where in memory a block begins."""
    return (component * series.blocks + block) * BLOCK_SIZE


@inlined_by_llvm
def ghosts_start(series, component):
    """Return where in memory the ghosts of a component begin."""
    return series.components * series.blocks * BLOCK_SIZE + component * GHOSTS_SIZE


@inlined_by_llvm
def spare_start(series):
    """Return where in memory begins what a rule that asked for more numbers may use as it likes."""
    return ghosts_start(series, series.components)


@kernel
def write_state(y, series):
    """Let the series begin with the state `y`; padding begins with zero."""
    for row in range(y.shape[0]):
        for b in range(series.blocks):
            place = block_start(series, row // 2, b) + row % 2 * LANES
            for j in range(LANES):
                column = 1 + b * LANES + j
                series.memory[place + j] = y[row, column] if column < y.shape[1] - 1 else 0.0


# --- Sums of the series -------------------------------------------------------------------------


@inlined_by_llvm
def sum_at(m, i, h):
    """Return the sum over all orders, at the time `h`, of the part of a block that begins at `i`.

    Horner's rule in h^4: four orders at a time do not wait for one another, as those of Horner's
    rule in h would.
    """
    h2 = h * h
    h3, h4 = h2 * h, h2 * h2
    total = load(m, i + ORDER * ORDER_STRIDE)
    for k in range(ORDER - 4, -1, -4):
        u = i + k * ORDER_STRIDE
        high = h3 * load(m, u + 3 * ORDER_STRIDE) + h2 * load(m, u + 2 * ORDER_STRIDE)
        total = h4 * total + (high + (h * load(m, u + ORDER_STRIDE) + load(m, u)))
    return total


@inlined_by_llvm
def advance(series, h, threshold):
    """Replace order 0 by the sum of the series at the time `h`, the state after the step.

    Numbers below `threshold` become zero.
    """
    m = series.memory
    for block in range(series.components * series.blocks):
        for offset in range(X, Y + 1, Y - X):
            i = block * BLOCK_SIZE + offset
            store(m, i, zero_below(threshold, sum_at(m, i, h)))


@kernel
def evaluate(series, h, y):
    """Write the sum of the series at the time `h` into the state `y`."""
    # a vector cannot be written site by site: that of the last block goes by way of the ghosts,
    # which are written anew before they are read
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
"""Below this size squares lose digits or vanish."""


@kernel
def largest_modulus(series, k):
    """Return the largest modulus of a component in order `k`, NaN where there is one.

    Where the squares vanish, it returns the largest real or imaginary part instead, which is as
    good for a step and never zero by underflow. Padding does not matter: it repeats what sites hold
    (see `close` of the system's rule).
    """
    m, square, magnitude = series.memory, fill(0.0), fill(0.0)
    for block in range(series.components * series.blocks):
        u = block * BLOCK_SIZE + k * ORDER_STRIDE
        x, y = load(m, u + X), load(m, u + Y)
        square = larger_magnitude(square, x * x + y * y)
        magnitude = larger_magnitude(magnitude, larger_magnitude(x, y))
    largest_square, largest_part = largest_lane(square), largest_lane(magnitude)
    return largest_part if largest_square < SQUARES else sqrt(largest_square)


@kernel
def sixteenth_root(x):
    """Return x^(1/16) by square roots, whose bits are the same on every machine (not so pow)."""
    return sqrt(sqrt(sqrt(sqrt(x))))


@kernel
def fifteenth_root(x):
    """Return x^(1/15) to four digits, from 1/15 = 1/16 + 1/16^2 + 1/16^3 + ...

    Every root is the sixteenth of the one before; of x^(1/4096), which is close to 1, the rest of
    the series is taken as a rational function that agrees with the fifteenth root to second order.
    """
    if not x < np.inf:
        return x
    first = sixteenth_root(x)
    second = sixteenth_root(first)
    third = sixteenth_root(second)
    remainder = (16.0 * third + 14.0) / (14.0 * third + 16.0)
    return (first * second) * (third * remainder)


@kernel
def step_of_earlier_orders(series, tolerance):
    """Return a step where the last two terms vanish, as in a series of t^4 alone.

    It is that of the highest order above ORDER / 2 that does not, infinite where there is none. The
    eighth root is shorter than that of such an order where the tolerance is below the coefficient.
    """
    for k in range(ORDER - 2, ORDER // 2, -1):
        coefficient = largest_modulus(series, k)
        if coefficient > 0.0:
            root = sixteenth_root(tolerance / coefficient)
            return root * root if root < 1.0 else root
    return np.inf


@kernel
def allowed_step(series, rtol, atol):
    """Return the step at which the last two terms equal the tolerance; NaN where they overflow."""
    size = largest_modulus(series, 0)
    last_but_one, last = largest_modulus(series, ORDER - 1), largest_modulus(series, ORDER)
    if not last + last_but_one < np.inf:
        return np.nan
    tolerance = atol + rtol * size
    if last == 0.0 and last_but_one == 0.0:
        return step_of_earlier_orders(series, tolerance)
    return min(sixteenth_root(tolerance / last), fifteenth_root(tolerance / last_but_one))


def build(continue_series, observe, at_time=at_any_time):
    """Return the solver of the system whose rule `continue_series(system, series)` is given.

    The rule writes the coefficients of the orders 1 to ORDER from those of order 0. The solver is
    called as the package says, which also says what `at_time` is.
    """
    driven = at_time is not at_any_time

    @inlined_by_numba
    def solve(system, y, times, controls, work, record, stop):
        rtol, atol = controls
        t, end = times[0], times[-1]
        series = lay_out(work, y)
        shortest, threshold = SMALLEST_PART * (end - t), rest_level(y, OF_SERIES)
        i = np.int64(0)  # a plain 0 would be a type of its own and compile `observe` anew
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
            if h * (1.0 + 1e-9) >= end - t:  # leave no remnant of the order of rounding
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
