"""Kahan and Li's symmetric composition of order eight: each step consists of 17 Verlet substeps.

Source: W. Kahan and R.-C. Li, Mathematics of Computation 66 (1997) 1089. The coefficients are in E.
Hairer, C. Lubich and G. Wanner, Geometric Numerical Integration, 2nd edition (Springer, 2006),
section V.3.2. The equations are x' = v, v' = f(x, t), and the rows of a state are x, v in turn.
Each Stoermer-Verlet substep is a drift by half its length, a kick by its whole length, and a drift
by half its length. The kick evaluates f at the time reached by the drifts. Drifts and kicks are
symplectic, so the error of a conserved energy does not grow.
"""

from collections.abc import Callable

import numpy as np

from latticode.kernels.compiled import at_any_time, in_one_pass, kernel
from latticode.kernels.simd import zero_below

from . import DONE, INTERRUPTED, Outcome
from .rest import OF_STAGES, rest_level

Array = np.ndarray

WORK = 1
"""Number of work arrays of the size of a state."""

_OUTER = (
    0.13020248308889008087881763,
    0.56116298177510838456196441,
    -0.38947496264484728640807860,
    0.15884190655515560089621075,
    -0.39590389413323757733623154,
    0.18453964097831570709183254,
    0.25837438768632204729397911,
    0.29501172360931029887096624,
)
_MIDDLE = -0.60550853383003451169892108
KICKS = np.array([*_OUTER, _MIDDLE, *_OUTER[::-1]])
"""Lengths of the substeps and thus of the kicks, as fractions of a step."""
DRIFTS = 0.5 * (np.append(0.0, KICKS) + np.append(KICKS, 0.0))
"""Lengths of the drifts before, between and after the kicks, as fractions of a step."""
NODES = np.cumsum(KICKS) - 0.5 * KICKS
"""Times of the kicks, as fractions of a step."""


@kernel
def add_rows(
    y: Array, first: int, slope: Array, first_slope: int, h: float, threshold: float
) -> None:
    """Add h times every second row of `slope` to every second row of `y`.

    The rows begin at `first_slope` in `slope` and at `first` in `y`. Sums below `threshold` become
    zero.
    """
    for row in range(0, y.shape[0], 2):
        for j in range(1, y.shape[1] - 1):
            value = y[row + first, j] + h * slope[row + first_slope, j]
            y[row + first, j] = zero_below(threshold, value)


def build(rates: Callable, observe: Callable, at_time: Callable = at_any_time) -> Callable:
    """Return the solver of y' = rates with rows x, v; the package describes its arguments.

    The time between two outputs is divided into equal steps, none longer than `step`.
    """

    @in_one_pass
    def solve(system, y, times, controls, work, record, stop) -> Outcome:
        (step,) = controls
        slope, steps, threshold = work[0], 0, rest_level(y, OF_STAGES)
        for i in range(times.size):
            start = times[max(i - 1, 0)]
            span = times[i] - start
            step_count = int(np.ceil(span / step * (1.0 - 1e-12)))
            h = span / max(step_count, 1)
            for step_number in range(step_count):
                t = start + step_number * h
                if stop[0]:
                    return Outcome(INTERRUPTED, t, steps, 0, KICKS.size * steps)
                for stage in range(KICKS.size):
                    # the last drift of a step is joined to the first of the next
                    joined = 2.0 if stage == 0 and step_number > 0 else 1.0
                    add_rows(y, 0, y, 1, joined * DRIFTS[stage] * h, threshold)
                    rates(at_time(system, t + NODES[stage] * h), y, slope)
                    add_rows(y, 1, slope, 1, KICKS[stage] * h, threshold)
                steps += 1
            if step_count > 0:
                add_rows(y, 0, y, 1, DRIFTS[0] * h, threshold)
            observe(system, y, np.int64(i), record)
        return Outcome(DONE, times[-1], steps, 0, KICKS.size * steps)

    return solve
