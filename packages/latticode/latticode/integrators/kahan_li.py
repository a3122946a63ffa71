"""Kahan and Li's symmetric composition of order eight: 17 Stoermer-Verlet steps make one.

W. Kahan and R.-C. Li, Mathematics of Computation 66 (1997) 1089; the coefficients stand in E.
Hairer, C. Lubich and G. Wanner, Geometric Numerical Integration, 2nd edition (Springer, 2006),
section V.3.2. It is for systems x' = v, v' = f(x, t): the rows of a state are pairs of x and v.
Each small step drifts by half its length, kicks by the whole, and drifts by the other half, and f
is taken at the time that the drifts have reached. Drifts and kicks are symplectic, so that the
energy of a system that has one errs but does not drift.
"""

import numpy as np

from latticode.kernels.compiled import inlined_by_numba, kernel
from latticode.kernels.simd import zero_below

from . import DONE, INTERRUPTED, Outcome
from .autonomous import at_any_time
from .rest import OF_STAGES, rest_level

WORK = 1
"""Work arrays of the size of a state."""

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
"""Parts of a step that the small steps take, and so the kicks."""
DRIFTS = 0.5 * (np.append(0.0, KICKS) + np.append(KICKS, 0.0))
"""Parts of a step between the kicks, before the first and behind the last among them."""
NODES = np.cumsum(KICKS) - 0.5 * KICKS
"""The part of the step at which each kick stands."""


@kernel
def add_rows(y, first, slope, first_slope, h, threshold):
    """Add h times every second row of `slope`, from `first_slope` on, to those of `y`.

    These begin at `first`.
    """
    for row in range(0, y.shape[0], 2):
        for j in range(1, y.shape[1] - 1):
            value = y[row + first, j] + h * slope[row + first_slope, j]
            y[row + first, j] = zero_below(threshold, value)


def build(rates, observe, at_time=at_any_time):
    """Return the solver of y' = rates, of the kind that is said above; see the package.

    The distance between two outputs is covered in equal steps, none longer than `step`.
    """

    @inlined_by_numba
    def solve(system, y, times, controls, work, record, stop):
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
                    # the last drift of a step and the first of the next are one
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
