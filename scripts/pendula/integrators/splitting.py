"""BM6, the symmetric splitting of order six with ten stages of Blanes and Moan, in equal steps.

S. Blanes and P. C. Moan, Journal of Computational and Applied Mathematics 142 (2002) 313, table 2.
A step alternates between the linear flow (of the linear terms alone), which is summed as a power
series to the last digit, and the nonlinear flow (of the cubic terms alone), which is known exactly.
Each is symplectic, so that the energy errs but does not drift.
"""

import numpy as np

from pendula.compiled import copy, inlined_by_numba, kernel, uncached

from . import DONE, INTERRUPTED, STEP_TOO_LONG, Outcome

WORK = 2
"""Work arrays of the size of a state."""

_LINEAR = (
    0.0502627644003922,
    0.413514300428344,
    0.0450798897943977,
    -0.188054853819569,
    0.541960678450780,
)
_NONLINEAR = (0.148816447901042, -0.132385865767784, 0.067307604692185, 0.432666402578175)
_MIDDLE = 1.0 - 2.0 * sum(_LINEAR)
_LAST = 0.5 - sum(_NONLINEAR)
LINEAR_PARTS = np.array([*_LINEAR, _MIDDLE, *_LINEAR[:0:-1]])
"""Parts of a step that the linear flow takes (a_i in the paper), and the first again at the end."""
NONLINEAR_PARTS = np.array([*_NONLINEAR, _LAST, _LAST, *_NONLINEAR[::-1]])
"""Parts of a step that the nonlinear flow takes between them, b_i in the paper."""


@kernel
def count_terms(x):
    """Return how many terms of the series of exp(x), x > 0, matter in double precision."""
    count, term = 0, 1.0
    while term > 1e-17:
        count += 1
        term *= x / count
    return count


@kernel
def add_scaled(slope, factor, term, y):
    """Write factor * slope into `term` and add it to `y`."""
    for row in range(y.shape[0]):
        for j in range(1, y.shape[1] - 1):
            term[row, j] = factor * slope[row, j]
            y[row, j] += term[row, j]


def build(linear_rates, radius, nonlinear_flow, observe):
    """Return the solver of y' = linear_rates + nonlinear terms.

    `nonlinear_flow(y, h)` is the exact flow of the nonlinear terms and returns whether the step is
    short enough for it, `radius(system)` bounds the linear rates of a state of size one. The
    distance between two outputs is covered in equal steps, none longer than `step`.
    """

    @uncached
    def linear_flow(system, y, h, term, slope):
        """Carry `y` along the linear flow; return the evaluations of the linear rates."""
        terms = count_terms(abs(h) * radius(system))
        copy(y, term)
        for k in range(1, terms + 1):
            linear_rates(system, term, slope)
            add_scaled(slope, h / k, term, y)
        return terms

    @inlined_by_numba
    def solve(system, y, times, controls, work, record, stop):
        (step,) = controls
        term, slope = work[0], work[1]
        steps = evaluations = 0
        for i in range(times.size):
            span = times[i] - times[max(i - 1, 0)]
            parts = int(np.ceil(span / step * (1.0 - 1e-12)))
            h = span / max(parts, 1)
            for part in range(parts):
                if stop[0]:
                    return Outcome(INTERRUPTED, times[i - 1] + part * h, steps, 0, evaluations)
                for stage in range(NONLINEAR_PARTS.size):
                    # the last linear flow of a step and the first of the next are one
                    joined = 2.0 if stage == 0 and part > 0 else 1.0
                    evaluations += linear_flow(
                        system, y, joined * LINEAR_PARTS[stage] * h, term, slope
                    )
                    if not nonlinear_flow(y, NONLINEAR_PARTS[stage] * h):
                        at = times[i - 1] + part * h
                        return Outcome(STEP_TOO_LONG, at, steps, 0, evaluations)
                steps += 1
            if parts > 0:
                evaluations += linear_flow(system, y, LINEAR_PARTS[0] * h, term, slope)
            observe(system, y, i, record)
        return Outcome(DONE, times[-1], steps, 0, evaluations)

    return solve
