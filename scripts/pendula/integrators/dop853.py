"""DOP853, the explicit Runge-Kutta method of order eight of Hairer, Norsett and Wanner.

Its error estimate combines those of orders five and three, its seventh-order interpolant takes
three more stages, evaluated only in steps that hold an output. One thing differs from dop853.f:
errors are measured by the largest component (a complex number's modulus), not by the root mean
square, so that a half chain takes the same steps as the whole.

A long state goes through a step in stretches: the stages of all its sites would not fit into the
cache, and memory would set the pace.
"""

from math import sqrt

import numpy as np

from pendula.compiled import copy, inlined_by_numba, kernel, uncached

from .dop853_errors import estimates, step_error, weighted_norm, worse
from .dop853_interpolant import interpolate, prepare_interpolant
from .dop853_stages import combine
from .outcome import DONE, NOT_FINITE, SMALLEST_PART, STEP_TOO_SMALL, Outcome
from .stretches import count_stretches, give, length_of, place_of, take

WORK, PART = 11, 27
"""Work arrays of the size of a state, and those of the size of a stretch."""


@kernel
def eighth_root(x):
    """Return x^(1/8) by square roots, whose bits are the same everywhere."""
    return sqrt(sqrt(sqrt(x)))


@kernel
def euler_step(y, slope):
    """Return a first guess of the step from the sizes of the state and of its rate."""
    return 0.01 * y / slope if min(y, slope) > 1e-5 else 1e-6


@kernel
def in_one(system):
    return False


@kernel
def whole(system, starts, ends):
    return system


def build(rates, observe, may_cut=in_one, cut=whole):
    """Return the solver of y' = rates; see the package for its arguments.

    Where `may_cut(system)`, rates at a site depend on that site and its two neighbours alone, and
    `cut(system, starts, ends)` is the system of a stretch that starts, or ends, where the whole
    does, or is cut off there.
    """

    @uncached
    def initial_step(system, y, slope, spare, tolerances, longest):
        """Return the starting step of Hairer, Norsett and Wanner (section II.4)."""
        w, turned, scratch, sites = spare[0], spare[1], spare[2], (1, y.shape[1] - 1)
        size = weighted_norm(y, y, y, scratch, tolerances, sites)
        speed = weighted_norm(slope, y, y, scratch, tolerances, sites)
        h = min(longest, euler_step(size, speed))
        for row in range(y.shape[0]):
            for j in range(y.shape[1]):
                w[row, j] = y[row, j] + h * slope[row, j]
        rates(system, w, turned)
        for row in range(y.shape[0]):
            for j in range(y.shape[1]):
                w[row, j] = turned[row, j] - slope[row, j]
        steepest = max(speed, weighted_norm(w, y, y, scratch, tolerances, sites) / h)
        if steepest <= 1e-15:
            return min(longest, max(1e-6, 1e-3 * h))
        return min(longest, 100.0 * h, eighth_root(0.01 / steepest))

    @uncached
    def take_stages(system, first, last, y, h, k, w):
        """Write the arguments of stages `first` to `last` into `w`, and their slopes into `k`."""
        y_flat, k_flat, w_flat = y.reshape(-1), k.reshape(16, -1), w.reshape(-1)
        for stage in range(first, last + 1):
            combine(stage, y_flat, h, k_flat, w_flat)
            rates(system, w, k[stage - 1])

    @uncached
    def step(system, count, part, y, slope, h, tolerances, due, w, final_slope, c):
        """Write the state and its slope after a step in `count` stretches; return its error.

        Where outputs are `due` the interpolant `c` is prepared too; of several stretches before it
        is known that the step passes, for what the later ones find can make the error smaller.
        """
        k, scratch, spare, alone = part[:16], part[16], part[17], count == 1
        start, end, curve = (y, w, c) if alone else (part[18], part[19], part[20:])
        sites, held = y.shape[1] - 2, part.shape[2] - 2
        fifth = third = error = 0.0
        for stretch in range(count):
            left, first, stop = place_of(stretch, count, sites)
            here = cut(system, left == 0, left + held == sites)
            take(slope, left, k[0])
            if not alone:
                take(y, left, start)
            take_stages(here, 2, 13, start, h, k, end)
            own = (1 + first - left, 1 + stop - left)
            near = estimates(start, end, k, scratch, spare, tolerances, own)
            fifth, third = worse(fifth, near[0]), worse(third, near[1])
            error = step_error(h, fifth, third)
            give(k[12], left, first, stop, final_slope)
            if not alone:
                give(end, left, first, stop, w)
            if due and (error <= 1.0 or not alone):
                take_stages(here, 14, 16, start, h, k, scratch)
                prepare_interpolant(start, end, h, k, curve)
                for m in range(0 if alone else c.shape[0]):
                    give(curve[m], left, first, stop, c[m])
        return error

    @inlined_by_numba
    def solve(system, y, times, controls, work, record):
        t, end = times[0], times[-1]
        state, w, slope, final_slope, out, c = y, work[0], work[1], work[2], work[3], work[4:]
        count = count_stretches(y.shape[1] - 2) if may_cut(system) else 1
        part = np.zeros((PART, y.shape[0], length_of(y.shape[1] - 2, count) + 2))
        rates(system, y, slope)
        h = initial_step(system, y, slope, c, controls, end - t)
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
            t_new = end if h == end - t else t + h
            due = times[i] <= t_new
            error = step(system, count, part, state, slope, h, controls, due, w, final_slope, c)
            evaluations += 12
            overflowed = error == np.inf
            growth = 0.9 / eighth_root(error) if error > 0.0 else 6.0
            if not error <= 1.0:
                h *= max(1 / 3, growth)
                rejected += 1
                most_growth = 1.0
                continue
            evaluations += 3 * due
            while i < times.size and times[i] <= t_new:
                interpolate((times[i] - t) / h, state, c, out)
                observe(system, out, i, record)
                i += 1
            state, w, slope, final_slope = w, state, final_slope, slope
            t = t_new
            steps += 1
            h *= min(most_growth, max(1 / 3, growth))
            most_growth = 6.0
        if steps % 2:  # the two states have changed places
            copy(state, y)
        return Outcome(DONE, t, steps, rejected, evaluations)

    return solve
