"""BM6, the symmetric splitting of order six with ten stages of Blanes and Moan, in equal steps.

Journal of Computational and Applied Mathematics 142 (2002) 313, table 2. A step alternates between
the flow of the linear terms, summed as a power series to the last digit, and the exact flow of the
others: each is symplectic, so that the energy errs but does not drift. Sines and cosines of the
C library make the last bits depend on the machine.
"""

import numpy as np

from pendula.compiled import copy, inlined_by_numba, kernel, uncached

from .outcome import DONE, STEP_TOO_LONG, Outcome

WORK = 2  # arrays of the size of a state

_FLOWS = (
    0.0502627644003922,
    0.413514300428344,
    0.0450798897943977,
    -0.188054853819569,
    0.541960678450780,
)
_TURNS = (0.148816447901042, -0.132385865767784, 0.067307604692185, 0.432666402578175)
_MIDDLE = 1.0 - 2.0 * sum(_FLOWS)
_LAST_TURN = 0.5 - sum(_TURNS)
FLOWS = np.array([*_FLOWS, _MIDDLE, *_FLOWS[:0:-1]])
"""Parts of the step that the linear flow takes; the first once more at the end."""
TURNS = np.array([*_TURNS, _LAST_TURN, _LAST_TURN, *_TURNS[::-1]])
"""Parts of the step that the other flow takes between them."""


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


def build(linear_rates, radius, turn, observe):
    """Return the solver of y' = linear_rates + others.

    `turn` is the exact flow of the others and returns whether the step is short enough for it,
    `radius` bounds the linear rates of a state of size one. The distance between two outputs is
    covered in equal steps, none longer than `step`.
    """

    @uncached
    def flow(system, y, h, term, slope):
        """Carry `y` along the linear flow; return the evaluations of the linear rates."""
        terms = count_terms(abs(h) * radius(system))
        copy(y, term)
        for k in range(1, terms + 1):
            linear_rates(system, term, slope)
            add_scaled(slope, h / k, term, y)
        return terms

    @inlined_by_numba
    def solve(system, y, times, controls, work, record):
        (step,) = controls
        term, slope = work[0], work[1]
        steps = evaluations = 0
        for i in range(times.size):
            span = times[i] - times[max(i - 1, 0)]
            parts = int(np.ceil(span / step * (1.0 - 1e-12)))
            h = span / max(parts, 1)
            for part in range(parts):
                for stage in range(TURNS.size):
                    joined = 2.0 if stage == 0 and part > 0 else 1.0
                    evaluations += flow(system, y, joined * FLOWS[stage] * h, term, slope)
                    if not turn(y, TURNS[stage] * h):
                        at = times[i - 1] + part * h
                        return Outcome(STEP_TOO_LONG, at, steps, 0, evaluations)
                steps += 1
            if parts > 0:
                evaluations += flow(system, y, FLOWS[0] * h, term, slope)
            observe(system, y, i, record)
        return Outcome(DONE, times[-1], steps, 0, evaluations)

    return solve
