"""The Taylor method: each step sums the power series of the solution, with its own radius.

Step control after Jorba and Zou (Experimental Mathematics 14 (2005) 99): the last two coefficients
give the length at which the last terms fall below the tolerance, largest component, so that a half
chain takes the same steps as the whole. No step is ever rejected, and outputs are sums of the same
series.
"""

from math import sqrt

import numpy as np

from ..blocks import BLOCK, ORDER, STEP, WORK, X, Y, ghosts_of, lay_out, start_of, write_state
from ..compiled import generic, inlined, kernel, merged
from ..lanes import larger, largest_lane
from ..vectors import LANES, fill, load, store
from .outcome import DONE, NOT_FINITE, SMALLEST_PART, STEP_TOO_SMALL, Outcome

__all__ = ["ORDER", "WORK", "build"]

SQUARES = 1e-280
"""Below this, squares lose digits or vanish."""


@kernel
def size(series, k):
    """Return the largest modulus in order k, or where its square vanishes the largest part."""
    m, square, part = series.memory, fill(0.0), fill(0.0)
    for block in range(series.components * series.blocks):
        u = block * BLOCK + k * STEP
        x, y = load(m, u + X), load(m, u + Y)
        square, part = larger(square, x * x + y * y), larger(part, larger(x, y))
    largest = largest_lane(square)
    return largest_lane(part) if largest < SQUARES else sqrt(largest)


@kernel
def root(x):
    """Return x^(1/16) by operations that give the same bits everywhere, unlike a power."""
    return sqrt(sqrt(sqrt(sqrt(x))))


@kernel
def root_before(x):
    """Return x^(1/15) = x^(1/16 + 1/256 + 1/4096 + ...) to four digits."""
    if not x < np.inf:
        return x
    first = root(x)
    second = root(first)
    third = root(second)
    rest = (16.0 * third + 14.0) / (14.0 * third + 16.0)  # third^(1/15), and third is close to 1
    return (first * second) * (third * rest)


@merged
def sum_at(m, i, h, h2, h3, h4):
    """Return the sum of the series at the distance h of the part of a block that begins at i."""
    total = load(m, i + ORDER * STEP)
    for k in range(ORDER - 4, -1, -4):
        u = i + k * STEP
        high = h3 * load(m, u + 3 * STEP) + h2 * load(m, u + 2 * STEP)
        total = h4 * total + (high + (h * load(m, u + STEP) + load(m, u)))
    return total


@kernel
def advance(series, h):
    """Replace order 0 by the sum of the series at the distance h."""
    m, h2 = series.memory, h * h
    h3, h4 = h2 * h, h2 * h2
    for block in range(series.components * series.blocks):
        for part in range(X, Y + 1, Y - X):
            i = block * BLOCK + part
            store(m, i, sum_at(m, i, h, h2, h3, h4))


@kernel
def evaluate(series, h, y):
    """Write the sum of the series at the distance h into the state `y`."""
    m, h2 = series.memory, h * h
    h3, h4 = h2 * h, h2 * h2
    spare = ghosts_of(series, 0)  # ghosts are written anew before they are read
    for row in range(y.shape[0]):
        for block in range(series.blocks):
            i = start_of(series, row // 2, block) + row % 2 * LANES
            store(m, spare, sum_at(m, i, h, h2, h3, h4))
            first = 1 + block * LANES
            for column in range(first, min(first + LANES, y.shape[1] - 1)):
                y[row, column] = m[spare + column - first]


def build(continue_series, observe):
    """Return the solver of the system whose power series `continue_series` writes from order 0."""

    @generic
    def allowed_step(system, series, rtol, atol):
        """Fill the series; return the step that its last terms allow, NaN if they overflow."""
        continue_series(system, series)
        allowed = atol + rtol * size(series, 0)
        last, before = size(series, ORDER), size(series, ORDER - 1)
        if not last + before < np.inf:
            return np.nan
        return min(root(allowed / last), root_before(allowed / before))

    @inlined
    def solve(system, y, times, controls, work, record):
        rtol, atol = controls
        t, end = times[0], times[-1]
        series = lay_out(work, y)
        shortest = SMALLEST_PART * (end - t)
        i = np.int64(0)  # a plain 0 would be a type of its own and compile `observe` anew
        observe(system, y, i, record)
        i += 1
        steps = 0
        write_state(y, series)
        while i < times.size:
            h = allowed_step(system, series, rtol, atol)
            steps += 1
            if not h > shortest:
                status = STEP_TOO_SMALL if h <= shortest else NOT_FINITE
                return Outcome(status, t, steps, 0, ORDER * steps)
            if h * (1.0 + 1e-9) >= end - t:
                h = end - t
            t_new = end if h == end - t else t + h
            while i < times.size and times[i] <= t_new:
                evaluate(series, times[i] - t, y)
                observe(system, y, i, record)
                i += 1
            advance(series, h)
            t = t_new
        return Outcome(DONE, t, steps, 0, ORDER * steps)

    return solve
