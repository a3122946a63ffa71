"""The Taylor method: each step sums the power series of the solution, with its own radius.

No step is ever rejected (`taylor_step` says how long it may be), and outputs are sums of the same
series.
"""

import numpy as np

from pendula.compiled import inlined, kernel, merged
from pendula.models.blocks import (
    BLOCK,
    ORDER,
    STEP,
    WORK,
    X,
    Y,
    ghosts_of,
    lay_out,
    start_of,
    write_state,
)
from pendula.simd import LANES, load, store

from .outcome import DONE, NOT_FINITE, SMALLEST_PART, STEP_TOO_SMALL, Outcome
from .taylor_step import allowed_step, size, up_to

__all__ = ["ORDER", "WORK", "build"]


@merged
def sum_at(m, i, h):
    """Return the sum of the series at the distance h of the part of a block that begins at i."""
    h2 = h * h
    h3, h4 = h2 * h, h2 * h2
    total = load(m, i + ORDER * STEP)
    for k in range(ORDER - 4, -1, -4):
        u = i + k * STEP
        high = h3 * load(m, u + 3 * STEP) + h2 * load(m, u + 2 * STEP)
        total = h4 * total + (high + (h * load(m, u + STEP) + load(m, u)))
    return total


@merged
def advance(series, h):
    """Replace order 0 by the sum of the series at the distance h, one or one a lane."""
    m = series.memory
    for block in range(series.components * series.blocks):
        for part in range(X, Y + 1, Y - X):
            i = block * BLOCK + part
            store(m, i, sum_at(m, i, h))


@kernel
def evaluate(series, h, y):
    """Write the sum of the series at the distance h into the state `y`."""
    m, spare = series.memory, ghosts_of(series, 0)  # ghosts are written anew before they are read
    for row in range(y.shape[0]):
        for block in range(series.blocks):
            i = start_of(series, row // 2, block) + row % 2 * LANES
            store(m, spare, sum_at(m, i, h))
            first = 1 + block * LANES
            for column in range(first, min(first + LANES, y.shape[1] - 1)):
                y[row, column] = m[spare + column - first]


def build(continue_series, observe):
    """Return the solver of the system whose power series `continue_series` writes from order 0."""

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
            continue_series(system, series)
            sizes = size(series, 0), size(series, ORDER - 1), size(series, ORDER)
            h = allowed_step(sizes, rtol, atol)
            steps += 1
            if not h > shortest:
                status = STEP_TOO_SMALL if h <= shortest else NOT_FINITE
                return Outcome(status, t, steps, 0, ORDER * steps)
            h = up_to(h, end - t)
            t_new = end if h == end - t else t + h
            while i < times.size and times[i] <= t_new:
                evaluate(series, times[i] - t, y)
                observe(system, y, i, record)
                i += 1
            advance(series, h)
            t = t_new
        return Outcome(DONE, t, steps, 0, ORDER * steps)

    return solve
