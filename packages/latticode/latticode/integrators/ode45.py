"""MATLAB's ode45: the Dormand-Prince 5(4) pair under ode45's own step control.

The paper used ode45, and another control of the same pair makes another run: SciPy's RK45 drifts
ten times as much in energy at the same tolerances. So every choice here is MATLAB's. The pair is
from Dormand and Prince, J. Comput. Appl. Math. 6 (1980) 19; the error norm, the initial step and
the step control follow Shampine and Reichelt, The MATLAB ODE Suite, SIAM J. Sci. Comput. 18 (1997)
1; outputs between steps come from the pair's quartic interpolant.

# ASSUME: the paper's unknowns are MATLAB complex numbers, so that the error of a component is the
# modulus of a complex number, relative to the larger modulus at the two ends of the step. MATLAB's
# users as often take real and imaginary parts as unknowns, each with an error of its own: that is
# the solver ode45_real, and checks/solvers.nc holds the drift of the energy by both.

From top to bottom: the stages, the error, the interpolant, the choice of the first step, and the
loop. `y` is the state before a step, `w` the state after it or the argument of a stage, `k[s - 1]`
the slope of stage s; the slope of the last stage is the first of the next step.

MATLAB takes powers of 1/5 from the C library. Their last bits differ between machines, and a
chaotic run takes another path for it. Here fifth roots are made of + - * / and are the same
everywhere.
"""

from math import sqrt

import numpy as np

from latticode.kernels.compiled import copy, inlined_by_numba, kernel, uncached
from latticode.kernels.simd import largest_in_rows
from latticode.numerics import elementary

from . import DONE, INTERRUPTED, NOT_FINITE, SMALLEST_PART, STEP_TOO_SMALL, Outcome
from .autonomous import at_any_time
from .rest import OF_STAGES, rest_level, set_to_rest, square_modulus
from .weighted_sums import table, write_sum

WORK = 9
"""Work arrays of the size of a state."""
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
"""The weights of the arguments of stages 2 to 7, by the stages that they multiply."""
NODES = np.array([np.nan, 0.0, 1 / 5, 3 / 10, 4 / 5, 8 / 9, 1.0, 1.0])
"""The part of the step at which each stage stands, by its number."""


@kernel
def combine(stage, y, h, k, w):
    """Write the argument of stage 2 to 7 into `w`; that of stage 7 is the fifth-order solution.

    `y` and `w` are flat, `k[stage - 1]` holds the slopes found so far.
    """
    write_sum(ROWS, stage, y, h, k, w)


@kernel
def relative_error(y, w, k, threshold, scratch):
    """Return the largest error of a complex component, over h, as ode45 measures it.

    It is relative to the larger modulus at the two ends of the step, but at least to `threshold`;
    it is NaN or infinite where the step overflowed. Squares are compared, one root is taken.
    """
    floor = threshold * threshold
    k1, k3, k4, k5, k6, k7 = k[0], k[2], k[3], k[4], k[5], k[6]
    for re in range(0, y.shape[0], 2):
        im = re + 1
        for row in (re, im):
            for j in range(1, y.shape[1] - 1):
                scratch[row, j] = (
                    E1 * k1[row, j] + E3 * k3[row, j] + E4 * k4[row, j]
                    + E5 * k5[row, j] + E6 * k6[row, j] + E7 * k7[row, j]
                )  # fmt: skip
        for j in range(1, y.shape[1] - 1):
            size2 = max(square_modulus(y, re, j), square_modulus(w, re, j))
            scratch[re // 2, j] = square_modulus(scratch, re, j) / max(size2, floor)
    return sqrt(largest_in_rows(scratch, y.shape[0] // 2))


@kernel
def relative_error_of_reals(y, w, k, threshold, scratch):
    """Return the same where real and imaginary parts are unknowns of their own."""
    for row in range(y.shape[0]):
        for j in range(1, y.shape[1] - 1):
            error = (
                E1 * k[0, row, j] + E3 * k[2, row, j] + E4 * k[3, row, j]
                + E5 * k[4, row, j] + E6 * k[5, row, j] + E7 * k[6, row, j]
            )  # fmt: skip
            size = max(max(abs(y[row, j]), abs(w[row, j])), threshold)
            scratch[row, j] = error / size
    return largest_in_rows(scratch, y.shape[0])


@kernel
def interpolate(s, y, h, k, out):
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
def relative_rate(y, slope, threshold):
    """Return the largest rate of a complex component, relative to it or to `threshold`."""
    rate2 = 0.0
    for re in range(0, y.shape[0], 2):
        for j in range(1, y.shape[1] - 1):
            size2 = y[re, j] * y[re, j] + y[re + 1, j] * y[re + 1, j]
            slope2 = slope[re, j] * slope[re, j] + slope[re + 1, j] * slope[re + 1, j]
            rate2 = max(rate2, slope2 / max(size2, threshold * threshold))
    return sqrt(rate2)


@kernel
def relative_rate_of_reals(y, slope, threshold):
    """Return the same where real and imaginary parts are unknowns of their own."""
    rate = 0.0
    for row in range(y.shape[0]):
        for j in range(1, y.shape[1] - 1):
            rate = max(rate, abs(slope[row, j]) / max(abs(y[row, j]), threshold))
    return rate


@kernel
def initial_step(rate, rtol, longest):
    """Return ode45's first step: 0.8 rtol^(1/5) over the largest relative rate, or `longest`."""
    rate /= 0.8 * fifth_root(rtol)
    return 1.0 / rate if longest * rate > 1.0 else longest


@kernel
def spacing(t):
    """Return the shortest step that MATLAB allows at time t: 16 eps(t)."""
    return 16.0 * np.spacing(max(abs(t), 2.0**-1022))


def build(rates, observe, at_time=at_any_time, of_reals=False):
    """Return the solver of y' = rates; see the package for its arguments.

    `of_reals` makes each row of the state a real unknown; else two rows are a complex one.
    """
    driven = at_time is not at_any_time
    measure = relative_error_of_reals if of_reals else relative_error
    rate_of = relative_rate_of_reals if of_reals else relative_rate

    @inlined_by_numba
    def solve(system, y, times, controls, work, record, stop):
        rtol, atol = controls
        threshold = atol / rtol
        t, end = times[0], times[-1]
        longest, refused = 0.1 * (end - t), SMALLEST_PART * (end - t)
        k, w, out = work[:7], work[7], work[8]
        y_flat, k_flat, w_flat = y.reshape(-1), k.reshape(7, -1), w.reshape(-1)
        rest = rest_level(y, OF_STAGES)
        rates(at_time(system, t), y, k[0])
        rate = rate_of(y, k[0], threshold)
        h = initial_step(rate, rtol, min(longest, times[1] - times[0]))
        i = np.int64(0)  # a plain 0 would be a type of its own and compile `observe` anew
        observe(system, y, i, record)
        i += 1
        steps, rejected, evaluations = 0, 0, 1
        while i < times.size:
            shortest = spacing(t)
            h = min(longest, max(shortest, h))
            if 1.1 * h >= end - t:  # lengthen the last step rather than leave a short one
                h = end - t
            elif not h > refused:  # also where h is NaN
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
                # the first failure takes the error for its guide, each further one halves the step
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
