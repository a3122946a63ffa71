"""DOP853, the explicit Runge-Kutta method of order eight of Hairer, Norsett and Wanner.

Its error estimate combines those of orders five and three, its seventh-order interpolant takes
three more stages, evaluated only in steps that hold an output. One thing differs from dop853.f:
errors are measured by the largest component (a complex number's modulus), not by the root mean
square, so that a half chain takes the same steps as the whole.
"""

from math import sqrt

import numpy as np

from ..compiled import copy, generic, inlined, kernel
from ..reductions import largest_of_rows
from .dop853_stages import combine
from .dop853_tableau import D4, D5, D6, D7, E3, E5
from .outcome import DONE, NOT_FINITE, SMALLEST_PART, STEP_TOO_SMALL, Outcome

WORK = 25  # arrays of the size of a state


@kernel
def weighted_norm(v, y, w, rtol, atol, scratch):
    """Return the largest modulus in `v`, each relative to atol + rtol max(|y|, |w|)."""
    for re in range(0, v.shape[0], 2):
        im = re + 1
        for j in range(1, v.shape[1] - 1):
            before = y[re, j] * y[re, j] + y[im, j] * y[im, j]
            after = w[re, j] * w[re, j] + w[im, j] * w[im, j]
            scale = atol + rtol * sqrt(max(before, after))
            scratch[re // 2, j] = (v[re, j] * v[re, j] + v[im, j] * v[im, j]) / (scale * scale)
    return sqrt(largest_of_rows(scratch, y.shape[0] // 2))


@kernel
def weigh(k, e, out):
    """Write the combination of stages 1 and 6 to 12 that an error estimate is made of (flat)."""
    k1, k6, k7, k8, k9, k10, k11, k12 = k[0], k[5], k[6], k[7], k[8], k[9], k[10], k[11]
    for i in range(out.size):
        out[i] = (
            e[0] * k1[i] + e[1] * k6[i] + e[2] * k7[i] + e[3] * k8[i]
            + e[4] * k9[i] + e[5] * k10[i] + e[6] * k11[i] + e[7] * k12[i]
        )  # fmt: skip


@kernel
def step_error(y, w, h, k, v, scratch, rtol, atol):
    """Return the error of a step in units of the tolerance; `v` and `scratch` are work space."""
    k_flat, v_flat = k.reshape(16, -1), v.reshape(-1)
    weigh(k_flat, E5, v_flat)
    fifth = weighted_norm(v, y, w, rtol, atol, scratch)
    weigh(k_flat, E3, v_flat)
    third = weighted_norm(v, y, w, rtol, atol, scratch)
    if not fifth + third < np.inf:
        return np.inf
    if fifth == 0.0:
        return 0.0
    return h * fifth * fifth / sqrt(fifth * fifth + 0.01 * third * third)


@kernel
def combine_all(k, d, h, out):
    """Write h times the combination of stages 1 and 6 to 16 with weights `d` (flat)."""
    k1, k6, k7, k8, k9, k10 = k[0], k[5], k[6], k[7], k[8], k[9]
    k11, k12, k13, k14, k15, k16 = k[10], k[11], k[12], k[13], k[14], k[15]
    for i in range(out.size):
        out[i] = h * (
            d[0] * k1[i] + d[1] * k6[i] + d[2] * k7[i] + d[3] * k8[i]
            + d[4] * k9[i] + d[5] * k10[i] + d[6] * k11[i] + d[7] * k12[i]
            + d[8] * k13[i] + d[9] * k14[i] + d[10] * k15[i] + d[11] * k16[i]
        )  # fmt: skip


@kernel
def prepare_interpolant(y, w, h, k, c):
    """Write the coefficients c[0..6] of the interpolant over the step from `y` to `w`."""
    for row in range(y.shape[0]):
        for j in range(1, y.shape[1] - 1):
            change = w[row, j] - y[row, j]
            c[0, row, j] = change
            c[1, row, j] = h * k[0, row, j] - change
            c[2, row, j] = 2.0 * change - h * (k[12, row, j] + k[0, row, j])
    k_flat = k.reshape(16, -1)
    combine_all(k_flat, D4, h, c[3].reshape(-1))
    combine_all(k_flat, D5, h, c[4].reshape(-1))
    combine_all(k_flat, D6, h, c[5].reshape(-1))
    combine_all(k_flat, D7, h, c[6].reshape(-1))


@kernel
def interpolate(x, y, c, out):
    """Write the interpolant at the fraction `x` of the step into `out`."""
    z = 1.0 - x
    for row in range(y.shape[0]):
        for j in range(1, y.shape[1] - 1):
            inner = c[3, row, j] + x * (c[4, row, j] + z * (c[5, row, j] + x * c[6, row, j]))
            outer = c[0, row, j] + z * (c[1, row, j] + x * (c[2, row, j] + z * inner))
            out[row, j] = y[row, j] + x * outer


@kernel
def eighth_root(x):
    """Return x^(1/8) by square roots, whose bits are the same everywhere."""
    return sqrt(sqrt(sqrt(x)))


@kernel
def euler_step(y, slope):
    """Return a first guess of the step from the sizes of the state and of its rate."""
    return 0.01 * y / slope if min(y, slope) > 1e-5 else 1e-6


def build(rates, observe):
    """Return the solver of y' = rates; see the package for its arguments."""

    @generic
    def initial_step(system, y, k, w, rtol, atol, longest):
        """Return the starting step of Hairer, Norsett and Wanner (section II.4)."""
        size = weighted_norm(y, y, y, rtol, atol, w)
        slope = weighted_norm(k[0], y, y, rtol, atol, w)
        h = min(longest, euler_step(size, slope))
        for row in range(y.shape[0]):
            for j in range(y.shape[1]):
                w[row, j] = y[row, j] + h * k[0, row, j]
        rates(system, w, k[1])
        for row in range(y.shape[0]):
            for j in range(y.shape[1]):
                w[row, j] = k[1, row, j] - k[0, row, j]
        steepest = max(slope, weighted_norm(w, y, y, rtol, atol, k[2]) / h)
        if steepest <= 1e-15:
            return min(longest, max(1e-6, 1e-3 * h))
        return min(longest, 100.0 * h, eighth_root(0.01 / steepest))

    @inlined
    def solve(system, y, times, controls, work, record):
        rtol, atol = controls
        t, end = times[0], times[-1]
        k, c, w, scratch = work[:16], work[16:23], work[23], work[24]
        y_flat, k_flat = y.reshape(-1), k.reshape(16, -1)
        w_flat, scratch_flat = w.reshape(-1), scratch.reshape(-1)
        rates(system, y, k[0])
        h = initial_step(system, y, k, w, rtol, atol, end - t)
        i = np.int64(0)  # a plain 0 would be a type of its own and compile `observe` anew
        observe(system, y, i, record)
        i += 1
        steps, rejected, evaluations = 0, 0, 2
        most_growth = 6.0
        overflowed = not h < np.inf
        shortest = SMALLEST_PART * (end - t)
        if h <= shortest:  # a first guess only: data at rest would otherwise be refused
            h = 2.0 * shortest
        while i < times.size:
            if h * (1.0 + 1e-9) >= end - t:  # leave no remnant of the order of rounding
                h = end - t
            if not h > shortest:  # also where h is NaN
                status = NOT_FINITE if overflowed else STEP_TOO_SMALL
                return Outcome(status, t, steps, rejected, evaluations)
            for stage in range(2, 14):
                combine(stage, y_flat, h, k_flat, w_flat)
                rates(system, w, k[stage - 1])
            evaluations += 12
            error = step_error(y, w, h, k, scratch, c[0], rtol, atol)
            overflowed = error == np.inf
            growth = 0.9 / eighth_root(error) if error > 0.0 else 6.0
            if not error <= 1.0:
                h *= max(1 / 3, growth)
                rejected += 1
                most_growth = 1.0
                continue
            t_new = end if h == end - t else t + h
            if times[i] <= t_new:
                for stage in range(14, 17):
                    combine(stage, y_flat, h, k_flat, scratch_flat)
                    rates(system, scratch, k[stage - 1])
                evaluations += 3
                prepare_interpolant(y, w, h, k, c)
            while i < times.size and times[i] <= t_new:
                interpolate((times[i] - t) / h, y, c, scratch)
                observe(system, scratch, i, record)
                i += 1
            copy(w, y)
            copy(k[12], k[0])
            t = t_new
            steps += 1
            h *= min(most_growth, max(1 / 3, growth))
            most_growth = 6.0
        return Outcome(DONE, t, steps, rejected, evaluations)

    return solve
