"""MATLAB's ode45: the Dormand-Prince 5(4) pair under ode45's own step control.

The paper used ode45, and the results depend on the step control: at the same tolerances the energy
drift of SciPy's RK45 is ten times larger. All choices below are therefore MATLAB's. The pair is
from Dormand and Prince, J. Comput. Appl. Math. 6 (1980) 19. The error norm, the initial step and
the step control follow Shampine and Reichelt, The MATLAB ODE Suite, SIAM J. Sci. Comput. 18 (1997)
1. Outputs between steps use the quartic interpolant of the pair.

# ASSUME: the paper's unknowns are MATLAB complex numbers. The error of a component is then the
# modulus of a complex number, relative to the larger modulus at the two ends of the step. Users of
# MATLAB often take real and imaginary parts as separate unknowns with separate errors. This is the
# solver ode45_real; checks/solvers.nc contains the energy drift of both.

In all kernels `y` is the state before a step, `w` the state after it or the argument of a stage,
and `k[s - 1]` the slope of stage s. The slope of the last stage is the first of the next step.

MATLAB computes powers of 1/5 with the C library. Their last bits differ between machines, which
changes the course of a chaotic run. Here fifth roots use only + - * / and are the same everywhere.
"""

from collections.abc import Callable
from math import sqrt

import numpy as np

from latticode.kernels.compiled import at_any_time, copy, in_one_pass, kernel, uncached
from latticode.kernels.simd import largest_in_rows
from latticode.numerics import elementary

from . import DONE, INTERRUPTED, NOT_FINITE, SMALLEST_PART, STEP_TOO_SMALL, Outcome
from .rest import OF_STAGES, rest_level, set_to_rest, square_modulus
from .weighted_sums import table, write_sum

Array = np.ndarray

WORK = 9
"""Number of work arrays of the size of a state."""
fifth_root = uncached(elementary.fifth_root)
# weights b of the fifth-order solution minus those of the fourth-order solution
E1, E3, E4, E5, E6, E7 = 71 / 57600, -71 / 16695, 71 / 1920, -17253 / 339200, 22 / 525, -1 / 40


ROWS = table(
    {
        2: {1: 1 / 5},
        3: {1: 3 / 40, 2: 9 / 40},
        4: {1: 44 / 45, 2: -56 / 15, 3: 32 / 9},
        5: {1: 19372 / 6561, 2: -25360 / 2187, 3: 64448 / 6561, 4: -212 / 729},
        6: {1: 9017 / 3168, 2: -355 / 33, 3: 46732 / 5247, 4: 49 / 176, 5: -5103 / 18656},
        7: {1: 35 / 384, 3: 500 / 1113, 4: 125 / 192, 5: -2187 / 6784, 6: 11 / 84},
    },
    8,
)
"""Weights of the arguments of stages 2 to 7; each row maps the number of a stage to its weight."""
NODES = np.array([np.nan, 0.0, 1 / 5, 3 / 10, 4 / 5, 8 / 9, 1.0, 1.0])
"""Time of each stage as a fraction of the step, by the number of the stage."""


@kernel
def combine(stage: int, y: Array, h: float, k: Array, w: Array) -> None:
    """Write the argument of a stage (2 to 7) into `w`; the argument of stage 7 is the solution.

    `y` and `w` are flat; `k` (stage, number) holds the slopes of the earlier stages.
    """
    write_sum(ROWS, stage, y, h, k, w)


@kernel
def relative_error(y: Array, w: Array, k: Array, threshold: float, scratch: Array) -> float:
    """Return the largest relative error of a complex component in ode45's norm, divided by h.

    The error is relative to the larger modulus at the two ends of the step, or to `threshold` if
    that is larger. It is NaN or infinite if the step overflowed.
    """
    floor = threshold * threshold
    k1, k3, k4, k5, k6, k7 = k[0], k[2], k[3], k[4], k[5], k[6]
    for re in range(0, y.shape[0], 2):
        im = re + 1
        for row in (re, im):
            for j in range(1, y.shape[1] - 1):
                error = E1 * k1[row, j] + E3 * k3[row, j] + E4 * k4[row, j]
                scratch[row, j] = error + E5 * k5[row, j] + E6 * k6[row, j] + E7 * k7[row, j]
        for j in range(1, y.shape[1] - 1):
            size2 = max(square_modulus(y, re, j), square_modulus(w, re, j))
            scratch[re // 2, j] = square_modulus(scratch, re, j) / max(size2, floor)
    return sqrt(largest_in_rows(scratch, y.shape[0] // 2))


@kernel
def relative_error_of_reals(
    y: Array, w: Array, k: Array, threshold: float, scratch: Array
) -> float:
    """Return the largest relative error of a real or imaginary part, divided by h."""
    for row in range(y.shape[0]):
        for j in range(1, y.shape[1] - 1):
            error = E1 * k[0, row, j] + E3 * k[2, row, j] + E4 * k[3, row, j]
            error = error + E5 * k[4, row, j] + E6 * k[5, row, j] + E7 * k[6, row, j]
            size = max(max(abs(y[row, j]), abs(w[row, j])), threshold)
            scratch[row, j] = error / size
    return largest_in_rows(scratch, y.shape[0])


@kernel
def interpolate(s: float, y: Array, h: float, k: Array, out: Array) -> None:
    """Write the quartic interpolant at the fraction `s` of the step from `y` into `out`."""
    s2, s3, s4 = s * s, s * s * s, s * s * s * s
    b1 = s - 183 / 64 * s2 + 37 / 12 * s3 - 145 / 128 * s4
    b3 = 1500 / 371 * s2 - 1000 / 159 * s3 + 1000 / 371 * s4
    b4 = -125 / 32 * s2 + 125 / 12 * s3 - 375 / 64 * s4
    b5 = 9477 / 3392 * s2 - 729 / 106 * s3 + 25515 / 6784 * s4
    b6 = -11 / 7 * s2 + 11 / 3 * s3 - 55 / 28 * s4
    b7 = 3 / 2 * s2 - 4 * s3 + 5 / 2 * s4
    for row in range(y.shape[0]):
        for j in range(1, y.shape[1] - 1):
            slope = b1 * k[0, row, j] + b3 * k[2, row, j] + b4 * k[3, row, j]
            slope += b5 * k[4, row, j] + b6 * k[5, row, j] + b7 * k[6, row, j]
            out[row, j] = y[row, j] + h * slope


@kernel
def relative_rate(y: Array, slope: Array, threshold: float) -> float:
    """Return the largest rate of a complex component, relative to its modulus or `threshold`."""
    rate2 = 0.0
    for re in range(0, y.shape[0], 2):
        for j in range(1, y.shape[1] - 1):
            size2 = y[re, j] * y[re, j] + y[re + 1, j] * y[re + 1, j]
            slope2 = slope[re, j] * slope[re, j] + slope[re + 1, j] * slope[re + 1, j]
            rate2 = max(rate2, slope2 / max(size2, threshold * threshold))
    return sqrt(rate2)


@kernel
def relative_rate_of_reals(y: Array, slope: Array, threshold: float) -> float:
    """Return the largest relative rate of real and imaginary parts as separate unknowns."""
    rate = 0.0
    for row in range(y.shape[0]):
        for j in range(1, y.shape[1] - 1):
            rate = max(rate, abs(slope[row, j]) / max(abs(y[row, j]), threshold))
    return rate


@kernel
def initial_step(rate: float, rtol: float, longest: float) -> float:
    """Return ode45's first step: 0.8 rtol^(1/5) over the largest relative rate, or `longest`."""
    rate /= 0.8 * fifth_root(rtol)
    return 1.0 / rate if longest * rate > 1.0 else longest


@kernel
def spacing(t: float) -> float:
    """Return the shortest step that MATLAB allows at time t, 16 eps(t)."""
    return 16.0 * np.spacing(max(abs(t), 2.0**-1022))


def build(
    rates: Callable, observe: Callable, at_time: Callable = at_any_time, of_reals: bool = False
) -> Callable:
    """Return the solver of y' = rates; the package describes its arguments.

    With `of_reals` each row is a real unknown, otherwise each pair of rows is a complex unknown.
    """
    driven = at_time is not at_any_time
    measure = relative_error_of_reals if of_reals else relative_error
    rate_of = relative_rate_of_reals if of_reals else relative_rate

    @in_one_pass
    def solve(system, y, times, controls, work, record, stop) -> Outcome:
        rtol, atol = controls
        threshold = atol / rtol
        t, end = times[0], times[-1]
        longest, too_short = 0.1 * (end - t), SMALLEST_PART * (end - t)
        k, w, out = work[:7], work[7], work[8]
        y_flat, k_flat, w_flat = y.reshape(-1), k.reshape(7, -1), w.reshape(-1)
        rest = rest_level(y, OF_STAGES)
        rates(at_time(system, t), y, k[0])
        rate = rate_of(y, k[0], threshold)
        h = initial_step(rate, rtol, min(longest, times[1] - times[0]))
        i = np.int64(0)  # numba types a literal 0 separately and would compile `observe` twice
        observe(system, y, i, record)
        i += 1
        steps, rejected, evaluations = 0, 0, 1
        while i < times.size:
            shortest = spacing(t)
            h = min(longest, max(shortest, h))
            if 1.1 * h >= end - t:  # lengthen the last step instead of adding a very short one
                h = end - t
            elif not h > too_short:  # also where h is NaN
                return Outcome(STEP_TOO_SMALL, t, steps, rejected, evaluations)
            failed = False
            while True:  # shrink h until the step passes; as a function it would take 7 % longer
                if stop[0]:
                    return Outcome(INTERRUPTED, t, steps, rejected, evaluations)
                if driven and h != end - t:
                    h = (t + h) - t
                for stage in range(2, 8):
                    combine(stage, y_flat, h, k_flat, w_flat)
                    if stage == 7:
                        set_to_rest(w, rest)
                    rates(at_time(system, t + NODES[stage] * h), w, k[stage - 1])
                evaluations += 6
                error = h * measure(y, w, k, threshold, out)
                if error <= rtol:
                    break
                if not h > shortest:
                    status = STEP_TOO_SMALL if error < np.inf else NOT_FINITE
                    return Outcome(status, t, steps, rejected, evaluations)
                # the first rejection uses the error estimate, each further one halves the step
                shrink = 0.5 if failed else max(0.1, 0.8 * fifth_root(rtol / error))
                h = max(shortest, h * shrink)
                rejected += 1
                failed = True
            t_new = end if h == end - t else t + h
            while i < times.size and times[i] <= t_new:
                interpolate((times[i] - t) / h, y, h, k, out)
                observe(system, out, i, record)
                i += 1
            copy(w, y)
            copy(k[6], k[0])
            t = t_new
            steps += 1
            if not failed:  # no growth right after a rejection
                shrink = 1.25 * fifth_root(error / rtol)
                h = h / shrink if shrink > 0.2 else 5.0 * h
        return Outcome(DONE, t, steps, rejected, evaluations)

    return solve
