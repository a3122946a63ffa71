"""DOP853, the explicit Runge-Kutta method of order eight of Dormand and Prince.

After E. Hairer, S. P. Norsett and G. Wanner, Solving Ordinary Differential Equations I, 2nd edition
(Springer, 1993), and their program dop853.f: section II.5 for the method, II.10 for its error
estimate from the orders five and three, II.4 for the control and the first choice of the step, II.6
for the interpolant of order seven, whose three more stages are evaluated only in steps that hold an
output. One thing differs from dop853.f: errors are measured by the largest component (the modulus
of a complex number) instead of the root mean square, so that half a chain takes the same steps as
the whole.

From top to bottom: the stages, the error, the interpolant, the first step; then `build` with one
step, which may go tile by tile (see `tiles`), and the loop over the steps. In all kernels `y` is
the state before a step, `w` the state after it or the argument of a stage, `k[s - 1]` the slope of
stage s. The stages and sums are written out term by term: each is one pass over the state, in which
LLVM keeps every coefficient in a register, and the order of its operations is fixed.
"""

from math import sqrt

import numpy as np

from pendula.compiled import copy, inlined_by_numba, kernel, uncached
from pendula.simd import largest_magnitude

from . import DONE, INTERRUPTED, NOT_FINITE, SMALLEST_PART, STEP_TOO_SMALL, Outcome
from .dop853_coefficients import (
    A2,
    A3,
    A4,
    A5,
    A6,
    A7,
    A8,
    A9,
    A10,
    A11,
    A12,
    A13,
    A14,
    A15,
    A16,
    D4,
    D5,
    D6,
    D7,
    E3,
    E5,
)
from .tiles import count_tiles, give, take, tile_length, tile_place

TILE_WORK = 27
"""Work arrays of the size of a tile."""
WHOLE_WORK = 11
"""Work arrays of the size of a state beside them."""
WORK = WHOLE_WORK + TILE_WORK
"""Work arrays in all. Tiles of a long chain are shorter than it and leave most of theirs untouched,
so that the system gives no memory to it."""


# --- The stages ---------------------------------------------------------------------------------


@kernel
def combine(stage, y, h, k, w):
    """Write the argument of stage 2 to 16 into `w`; stage 13 is the solution itself.

    `y` and `w` are flat, `k[stage - 1]` holds the slopes found so far.
    """
    k1, k2, k3, k4, k5, k6, k7, k8 = k[0], k[1], k[2], k[3], k[4], k[5], k[6], k[7]
    k9, k10, k11, k12, k13, k14, k15 = k[8], k[9], k[10], k[11], k[12], k[13], k[14]
    size = y.size
    if stage == 2:
        for i in range(size):
            w[i] = y[i] + h * (A2[0] * k1[i])
    elif stage == 3:
        for i in range(size):
            w[i] = y[i] + h * (A3[0] * k1[i] + A3[1] * k2[i])
    elif stage == 4:
        for i in range(size):
            w[i] = y[i] + h * (A4[0] * k1[i] + A4[1] * k3[i])
    elif stage == 5:
        for i in range(size):
            w[i] = y[i] + h * (A5[0] * k1[i] + A5[1] * k3[i] + A5[2] * k4[i])
    elif stage == 6:
        for i in range(size):
            w[i] = y[i] + h * (A6[0] * k1[i] + A6[1] * k4[i] + A6[2] * k5[i])
    elif stage == 7:
        for i in range(size):
            w[i] = y[i] + h * (A7[0] * k1[i] + A7[1] * k4[i] + A7[2] * k5[i] + A7[3] * k6[i])
    elif stage == 8:
        for i in range(size):
            w[i] = y[i] + h * (
                A8[0] * k1[i] + A8[1] * k4[i] + A8[2] * k5[i] + A8[3] * k6[i]
                + A8[4] * k7[i]
            )  # fmt: skip
    elif stage == 9:
        for i in range(size):
            w[i] = y[i] + h * (
                A9[0] * k1[i] + A9[1] * k4[i] + A9[2] * k5[i] + A9[3] * k6[i]
                + A9[4] * k7[i] + A9[5] * k8[i]
            )  # fmt: skip
    elif stage == 10:
        for i in range(size):
            w[i] = y[i] + h * (
                A10[0] * k1[i] + A10[1] * k4[i] + A10[2] * k5[i] + A10[3] * k6[i]
                + A10[4] * k7[i] + A10[5] * k8[i] + A10[6] * k9[i]
            )  # fmt: skip
    elif stage == 11:
        for i in range(size):
            w[i] = y[i] + h * (
                A11[0] * k1[i] + A11[1] * k4[i] + A11[2] * k5[i] + A11[3] * k6[i]
                + A11[4] * k7[i] + A11[5] * k8[i] + A11[6] * k9[i] + A11[7] * k10[i]
            )  # fmt: skip
    elif stage == 12:
        for i in range(size):
            w[i] = y[i] + h * (
                A12[0] * k1[i] + A12[1] * k4[i] + A12[2] * k5[i] + A12[3] * k6[i]
                + A12[4] * k7[i] + A12[5] * k8[i] + A12[6] * k9[i] + A12[7] * k10[i]
                + A12[8] * k11[i]
            )  # fmt: skip
    elif stage == 13:
        for i in range(size):
            w[i] = y[i] + h * (
                A13[0] * k1[i] + A13[1] * k6[i] + A13[2] * k7[i] + A13[3] * k8[i]
                + A13[4] * k9[i] + A13[5] * k10[i] + A13[6] * k11[i] + A13[7] * k12[i]
            )  # fmt: skip
    elif stage == 14:
        for i in range(size):
            w[i] = y[i] + h * (
                A14[0] * k1[i] + A14[1] * k7[i] + A14[2] * k8[i] + A14[3] * k9[i]
                + A14[4] * k10[i] + A14[5] * k11[i] + A14[6] * k12[i] + A14[7] * k13[i]
            )  # fmt: skip
    elif stage == 15:
        for i in range(size):
            w[i] = y[i] + h * (
                A15[0] * k1[i] + A15[1] * k6[i] + A15[2] * k7[i] + A15[3] * k8[i]
                + A15[4] * k11[i] + A15[5] * k12[i] + A15[6] * k13[i] + A15[7] * k14[i]
            )  # fmt: skip
    elif stage == 16:
        for i in range(size):
            w[i] = y[i] + h * (
                A16[0] * k1[i] + A16[1] * k6[i] + A16[2] * k7[i] + A16[3] * k8[i]
                + A16[4] * k9[i] + A16[5] * k13[i] + A16[6] * k14[i] + A16[7] * k15[i]
            )  # fmt: skip


# --- The error of a step: by its largest component, in units of the tolerance ---------------------


@kernel
def weighted_norm(v, y, w, spare, tolerances, columns):
    """Return the largest modulus in `v`, each relative to atol + rtol max(|y|, |w|).

    Only the `columns` (first, stop) count; `spare` has room for a number for each of them.
    """
    (rtol, atol), squares, size = tolerances, spare.reshape(-1), np.uint64(0)
    # unsigned, so that no code asks whether an index counts from the end of a row
    first, count = np.uint64(columns[0]), np.uint64(columns[1] - columns[0])
    for re in range(0, v.shape[0], 2):
        im = re + 1
        for i in range(count):
            j = first + i
            before = y[re, j] * y[re, j] + y[im, j] * y[im, j]
            after = w[re, j] * w[re, j] + w[im, j] * w[im, j]
            scale = atol + rtol * sqrt(max(before, after))
            squares[size + i] = (v[re, j] * v[re, j] + v[im, j] * v[im, j]) / (scale * scale)
        size += count
    return sqrt(largest_magnitude(squares[:size]))


@kernel
def weigh_slopes(k, e, out):
    """Write the combination of stages 1 and 6 to 12 that an error estimate is made of (flat)."""
    k1, k6, k7, k8, k9, k10, k11, k12 = k[0], k[5], k[6], k[7], k[8], k[9], k[10], k[11]
    for i in range(out.size):
        out[i] = (
            e[0] * k1[i] + e[1] * k6[i] + e[2] * k7[i] + e[3] * k8[i]
            + e[4] * k9[i] + e[5] * k10[i] + e[6] * k11[i] + e[7] * k12[i]
        )  # fmt: skip


@kernel
def error_estimates(y, w, k, scratch, spare, tolerances, columns):
    """Return the estimates of orders five and three of the error on `columns` (first, stop)."""
    k_flat, flat = k.reshape(16, -1), scratch.reshape(-1)
    weigh_slopes(k_flat, E5, flat)
    fifth = weighted_norm(scratch, y, w, spare, tolerances, columns)
    weigh_slopes(k_flat, E3, flat)
    return fifth, weighted_norm(scratch, y, w, spare, tolerances, columns)


@kernel
def step_error(h, fifth, third):
    """Return the error of a step in units of the tolerance, infinite where it is not finite.

    The two estimates are joined as in section II.10, h e5^2 / sqrt(e5^2 + 0.01 e3^2), which falls
    with the eighth power of the step.
    """
    if not fifth + third < np.inf:
        return np.inf
    if fifth == 0.0:
        return 0.0
    return h * fifth * fifth / sqrt(fifth * fifth + 0.01 * third * third)


@kernel
def worse(one, other):
    """Return the larger of two errors, or the one that is NaN: max() would drop it."""
    return other if other > one or other != other else one


# --- The interpolant of order seven between the steps -------------------------------------------


@kernel
def combine_for_interpolant(k, d, h, out):
    """Write h times the combination of stages 1 and 6 to 16 with the weights `d` (flat)."""
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
    """Write the coefficients c[0..6] of the interpolant over the step from `y` to `w`.

    The first three match values and slopes at both ends, the others come from the stages.
    """
    for row in range(y.shape[0]):
        for j in range(1, y.shape[1] - 1):
            difference = w[row, j] - y[row, j]
            c[0, row, j] = difference
            c[1, row, j] = h * k[0, row, j] - difference
            c[2, row, j] = 2.0 * difference - h * (k[12, row, j] + k[0, row, j])
    k_flat = k.reshape(16, -1)
    combine_for_interpolant(k_flat, D4, h, c[3].reshape(-1))
    combine_for_interpolant(k_flat, D5, h, c[4].reshape(-1))
    combine_for_interpolant(k_flat, D6, h, c[5].reshape(-1))
    combine_for_interpolant(k_flat, D7, h, c[6].reshape(-1))


@kernel
def interpolate(x, y, c, out):
    """Write the interpolant at the fraction `x` of the step into `out`.

    It is a nested product in x and z = 1 - x by turns: y + x (c0 + z (c1 + x (c2 + z (c3 + ...)))).
    """
    z = 1.0 - x
    for row in range(y.shape[0]):
        for j in range(1, y.shape[1] - 1):
            inner = c[3, row, j] + x * (c[4, row, j] + z * (c[5, row, j] + x * c[6, row, j]))
            outer = c[0, row, j] + z * (c[1, row, j] + x * (c[2, row, j] + z * inner))
            out[row, j] = y[row, j] + x * outer


# --- Step control -------------------------------------------------------------------------------


@kernel
def eighth_root(x):
    """Return x^(1/8) by square roots, whose bits are the same on every processor."""
    return sqrt(sqrt(sqrt(x)))


@kernel
def step_factor(error):
    """Return by what the step may change: equation (4.13) of section II.4, safety factor 0.9."""
    return 0.9 / eighth_root(error) if error > 0.0 else 6.0


@kernel
def euler_step(size, speed):
    """Return a first guess of the step from the sizes of the state and of its rate."""
    return 0.01 * size / speed if min(size, speed) > 1e-5 else 1e-6


@kernel
def never(system):
    return False


@kernel
def unchanged(system, at_left_end, at_right_end):
    return system


def build(rates, observe, can_be_tiled=never, system_of_tile=unchanged):
    """Return the solver of y' = rates; see the package for its arguments.

    Where `can_be_tiled(system)`, rates at a site depend on that site and its two neighbours alone,
    and `system_of_tile(system, at_left_end, at_right_end)` is the system of a tile, which may or
    may not hold the ends of the whole.
    """

    @uncached
    def initial_step(system, y, slope, spare, tolerances, longest):
        """Return the starting step of Hairer, Norsett and Wanner (section II.4).

        It compares the sizes of y, y' and, by a step of Euler's method, of y''.
        """
        w, new_slope, scratch, columns = spare[0], spare[1], spare[2], (1, y.shape[1] - 1)
        size = weighted_norm(y, y, y, scratch, tolerances, columns)
        speed = weighted_norm(slope, y, y, scratch, tolerances, columns)
        h = min(longest, euler_step(size, speed))
        for row in range(y.shape[0]):
            for j in range(y.shape[1]):
                w[row, j] = y[row, j] + h * slope[row, j]
        rates(system, w, new_slope)
        for row in range(y.shape[0]):
            for j in range(y.shape[1]):
                w[row, j] = new_slope[row, j] - slope[row, j]
        steepest = max(speed, weighted_norm(w, y, y, scratch, tolerances, columns) / h)
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
    def step(system, count, work, y, slope, h, tolerances, due, w, new_slope, c):
        """Write state and slope after a step, in `count` tiles, into `w` and `new_slope`.

        Return the error of the step; `work` holds TILE_WORK arrays of the size of a tile. Where an
        output is `due`, the interpolant `c` is prepared too. A single tile works on `y`, `w` and
        `c` themselves, and leaves the interpolant if the step fails. Of several tiles each prepares
        it at once, before it is known whether the whole step passes: the next tile overwrites its
        stages, and may make the error larger, or smaller by a larger estimate of order three.
        """
        k, scratch, spare, alone = work[:16], work[16], work[17], count == 1
        start, end, curve = (y, w, c) if alone else (work[18], work[19], work[20:])
        sites, held = y.shape[1] - 2, work.shape[2] - 2
        fifth = third = error = 0.0
        for tile in range(count):
            left, first, stop = tile_place(tile, count, sites)
            here = system_of_tile(system, left == 0, left + held == sites)
            take(slope, left, k[0])
            if not alone:
                take(y, left, start)
            take_stages(here, 2, 13, start, h, k, end)
            own = (1 + first - left, 1 + stop - left)
            near = error_estimates(start, end, k, scratch, spare, tolerances, own)
            fifth, third = worse(fifth, near[0]), worse(third, near[1])
            error = step_error(h, fifth, third)
            give(k[12], left, first, stop, new_slope)
            if not alone:
                give(end, left, first, stop, w)
            if due and (error <= 1.0 or not alone):
                take_stages(here, 14, 16, start, h, k, scratch)
                prepare_interpolant(start, end, h, k, curve)
                for m in range(0 if alone else c.shape[0]):
                    give(curve[m], left, first, stop, c[m])
        return error

    @inlined_by_numba
    def solve(system, y, times, controls, work, record, stop):
        t, end = times[0], times[-1]
        state, w, slope, new_slope, out = y, work[0], work[1], work[2], work[3]
        c = work[4:WHOLE_WORK]
        count = count_tiles(y.shape[1] - 2) if can_be_tiled(system) else 1
        columns = tile_length(y.shape[1] - 2, count) + 2
        tiles = work[WHOLE_WORK:].reshape(-1)[: TILE_WORK * y.shape[0] * columns]
        part = tiles.reshape((TILE_WORK, y.shape[0], columns))
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
            if stop[0]:
                return Outcome(INTERRUPTED, t, steps, rejected, evaluations)
            if h * (1.0 + 1e-9) >= end - t:  # leave no remnant of the order of rounding
                h = end - t
            if not h > shortest:  # also where h is NaN
                status = NOT_FINITE if overflowed else STEP_TOO_SMALL
                return Outcome(status, t, steps, rejected, evaluations)
            t_new = end if h == end - t else t + h
            due = times[i] <= t_new
            error = step(system, count, part, state, slope, h, controls, due, w, new_slope, c)
            evaluations += 12
            overflowed = error == np.inf
            factor = step_factor(error)
            if not error <= 1.0:
                h *= max(1 / 3, factor)
                rejected += 1
                most_growth = 1.0  # no growth right after a rejection
                continue
            evaluations += 3 * due
            while i < times.size and times[i] <= t_new:
                interpolate((times[i] - t) / h, state, c, out)
                observe(system, out, i, record)
                i += 1
            # the last stage of a step is the first of the next (first same as last)
            state, w, slope, new_slope = w, state, new_slope, slope
            t = t_new
            steps += 1
            h *= min(most_growth, max(1 / 3, factor))
            most_growth = 6.0
        if steps % 2:  # the two states have changed places
            copy(state, y)
        return Outcome(DONE, t, steps, rejected, evaluations)

    return solve
