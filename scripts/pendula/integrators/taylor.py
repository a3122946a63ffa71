"""The Taylor method: each step sums the power series of the solution, with its own radius.

Step control after Jorba and Zou (Experimental Mathematics 14 (2005) 99): the last two coefficients
give the length at which the last terms fall below the tolerance, largest component, so that a half
chain takes the same steps as the whole. No step is ever rejected, and outputs are sums of the same
series.
"""

from math import sqrt
from typing import NamedTuple

import numpy as np

from ..compiled import copy, generic, inlined, kernel
from ..reductions import largest_of_rows
from .outcome import DONE, NOT_FINITE, SMALLEST_PART, STEP_TOO_SMALL, Outcome

ORDER = 16
ARRAYS = 2 * (ORDER + 1) + 1
WORK = 3 * ARRAYS  # arrays of the size of a state: rows of one site grow from 3 to 8 columns


class Series(NamedTuple):
    """Coefficients of the state and of its densities, and work space; columns are padded."""

    c: np.ndarray  # (order + 1, row, column)
    density: np.ndarray  # (order + 1, row, column)
    scratch: np.ndarray  # (row, column)
    flat_c: np.ndarray  # (order + 1, row * column)
    flat_scratch: np.ndarray  # (row * column,)
    columns: int  # of the state


@generic
def lay_out(work, y):
    """Return a series in the memory of `work`, whose rows take vectors of four sites.

    Column 1, the first site, comes where an aligned vector starts; the padding is never summed.
    """
    rows, columns = y.shape
    padded = (columns + 1) // 4 * 4 + 4
    size = rows * padded
    memory = work.reshape(-1)[3 : 3 + ARRAYS * size]
    arrays = memory.reshape(ARRAYS, rows, padded)
    flat = memory.reshape(ARRAYS, size)
    c, density, scratch = arrays[: ORDER + 1], arrays[ORDER + 1 : -1], arrays[-1]
    return Series(c, density, scratch, flat[: ORDER + 1], flat[-1], columns)


@kernel
def size(y, scratch):
    """Return the largest modulus of a component."""
    for re in range(0, y.shape[0], 2):
        for j in range(1, y.shape[1] - 1):
            scratch[re // 2, j] = y[re, j] * y[re, j] + y[re + 1, j] * y[re + 1, j]
        for j in range(y.shape[1], scratch.shape[1]):
            scratch[re // 2, j] = 0.0
        scratch[re // 2, y.shape[1] - 1] = 0.0
    return sqrt(largest_of_rows(scratch, y.shape[0] // 2))


@kernel
def root(x, n):
    """Return the n-th root of x in [0, inf] to 4 digits by *, / and -: the same bits everywhere."""
    if not 0.0 < x < np.inf:
        return x
    guess = 1.0
    while guess**n < x:
        guess *= 2.0
    while (0.5 * guess) ** n >= x:
        guess *= 0.5
    # now within a factor of two above: halve the distance of the logarithms four times
    for factor in (0.7071067811865476, 0.8408964152537145, 0.9170040432046712, 0.9576032806985737):
        if (factor * guess) ** n >= x:
            guess *= factor
    for _ in range(3):  # Newton's iteration
        guess -= (guess - x / guess ** (n - 1)) / n
    return guess


@kernel
def evaluate(flat, x, total):
    """Write the series at the distance x from the start of the step into `total` (all flat)."""
    k = flat.shape[0] - 1
    top = flat[k]
    for i in range(total.size):
        total[i] = top[i]
    x2 = x * x
    x3, x4 = x2 * x, x2 * x2
    while k >= 4:
        c1, c2, c3, c4 = flat[k - 1], flat[k - 2], flat[k - 3], flat[k - 4]
        for i in range(total.size):
            total[i] = total[i] * x4 + ((c1[i] * x3 + c2[i] * x2) + (c3[i] * x + c4[i]))
        k -= 4
    while k >= 1:
        c1 = flat[k - 1]
        for i in range(total.size):
            total[i] = total[i] * x + c1[i]
        k -= 1


def build(next_coefficient, observe):
    """Return the solver of the system whose power series `next_coefficient` continues."""

    @generic
    def expand(system, series, rtol, atol):
        """Fill the series from c[0]; return the step that its last terms allow."""
        c, scratch = series.c, series.scratch
        for k in range(c.shape[0] - 1):
            next_coefficient(system, series, k)
        columns, order = series.columns, c.shape[0] - 1
        allowed = atol + rtol * size(c[0, :, :columns], scratch)
        last, before = (
            size(c[order, :, :columns], scratch),
            size(c[order - 1, :, :columns], scratch),
        )
        if not last + before < np.inf:
            return np.nan
        return min(root(allowed / last, order), root(allowed / before, order - 1))

    @inlined
    def solve(system, y, times, controls, work, record):
        rtol, atol = controls
        t, end = times[0], times[-1]
        series = lay_out(work, y)
        c, scratch = series.c, series.scratch
        flat, total = series.flat_c, series.flat_scratch
        shortest = SMALLEST_PART * (end - t)
        i = np.int64(0)  # a plain 0 would be a type of its own and compile `observe` anew
        observe(system, y, i, record)
        i += 1
        steps = 0
        copy(y, c[0])
        while i < times.size:
            h = expand(system, series, rtol, atol)
            steps += 1
            if not h > shortest:
                status = STEP_TOO_SMALL if h <= shortest else NOT_FINITE
                return Outcome(status, t, steps, 0, ORDER * steps)
            if h * (1.0 + 1e-9) >= end - t:
                h = end - t
            t_new = end if h == end - t else t + h
            while i < times.size and times[i] <= t_new:
                evaluate(flat, times[i] - t, total)
                copy(scratch[:, : y.shape[1]], y)
                observe(system, y, i, record)
                i += 1
            evaluate(flat, h, total)
            copy(scratch[:, : y.shape[1]], y)
            copy(y, c[0])
            t = t_new
        return Outcome(DONE, t, steps, 0, ORDER * steps)

    return solve
