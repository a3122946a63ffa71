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
stage s. Stages, error estimates and the interpolant are sums of slopes with the weights of a table.
"""

from math import sqrt

import numpy as np

from latticode.kernels.compiled import copy, inlined_by_numba, kernel, uncached
from latticode.kernels.simd import largest_magnitude

from . import DONE, INTERRUPTED, NOT_FINITE, SMALLEST_PART, STEP_TOO_SMALL, Outcome
from .autonomous import at_any_time
from .dop853_coefficients import D4, D5, D6, D7, E3, E5, NODES, STAGES
from .rest import OF_STAGES, rest_level, set_to_rest, square_modulus
from .tiles import count_tiles, give, take, tile_length, tile_place
from .weighted_sums import table, write_sum

TILE_WORK = 27
"""Work arrays of the size of a tile."""
WHOLE_WORK = 11
"""Work arrays of the size of a state beside them."""
WORK = WHOLE_WORK + TILE_WORK
"""Work arrays in all, where a state is its own only tile."""


def work_arrays(sites: int) -> int:
    """Return how many work arrays a state of so many sites needs if it may go in tiles."""
    columns = tile_length.py_func(sites, count_tiles.py_func(sites)) + 2
    return WHOLE_WORK + -(-TILE_WORK * columns // (sites + 2))


# --- The stages ---------------------------------------------------------------------------------

# plain numbers would be types of their own and compile `write_sum` anew
FIFTH, THIRD, CURVE = np.int64(17), np.int64(18), 19
"""Rows of the weights of both error estimates, and the first of those of the interpolant."""
ROWS = table(
    {**STAGES, FIFTH: E5, THIRD: E3, **dict(enumerate((D4, D5, D6, D7), CURVE))}, CURVE + 4
)


@kernel
def combine(stage, y, h, k, w):
    """Write the argument of stage 2 to 16 into `w`; stage 13 is the solution itself.

    `y` and `w` are flat, `k[stage - 1]` holds the slopes found so far.
    """
    write_sum(ROWS, stage, y, h, k, w)


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
        for i in range(count):
            j = first + i
            size2 = max(square_modulus(y, re, j), square_modulus(w, re, j))
            scale = atol + rtol * sqrt(size2)
            squares[size + i] = square_modulus(v, re, j) / (scale * scale)
        size += count
    return sqrt(largest_magnitude(squares[:size]))


@kernel
def weigh_slopes(k, row, out):
    """Write the combination of stages that an error estimate is made of (flat)."""
    write_sum(ROWS, row, out[:0], 1.0, k, out)


@kernel
def error_estimates(y, w, k, scratch, spare, tolerances, columns):
    """Return the estimates of orders five and three of the error on `columns` (first, stop)."""
    k_flat, flat = k.reshape(16, -1), scratch.reshape(-1)
    weigh_slopes(k_flat, FIFTH, flat)
    fifth = weighted_norm(scratch, y, w, spare, tolerances, columns)
    weigh_slopes(k_flat, THIRD, flat)
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
def worse(first_error, second_error):
    """Return the larger of two errors, or the one that is NaN: max() would drop it."""
    return (
        second_error if second_error > first_error or second_error != second_error else first_error
    )


# --- The interpolant of order seven between the steps -------------------------------------------


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
    for m in range(4):
        out = c[3 + m].reshape(-1)
        write_sum(ROWS, CURVE + m, out[:0], h, k_flat, out)


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


def build(rates, observe, can_be_tiled=never, system_of_tile=unchanged, at_time=at_any_time):
    """Return the solver of y' = rates; see the package for its arguments.

    Where `can_be_tiled(system)`, rates at a site depend on that site and its two neighbours alone,
    and `system_of_tile(system, at_left_end, at_right_end)` is the system of a tile, which may or
    may not hold the ends of the whole.
    """
    driven = at_time is not at_any_time

    @uncached
    def initial_step(system, t, y, slope, spare, tolerances, longest):
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
        rates(at_time(system, t + h), w, new_slope)
        for row in range(y.shape[0]):
            for j in range(y.shape[1]):
                w[row, j] = new_slope[row, j] - slope[row, j]
        steepest = max(speed, weighted_norm(w, y, y, scratch, tolerances, columns) / h)
        if steepest <= 1e-15:
            return min(longest, max(1e-6, 1e-3 * h))
        return min(longest, 100.0 * h, eighth_root(0.01 / steepest))

    @uncached
    def take_stages(system, first, last, t, y, h, threshold, k, w):
        """Write the arguments of stages `first` to `last` into `w`, and their slopes into `k`.

        In the solution, numbers below `threshold` become zero before its slope is taken.
        """
        y_flat, k_flat, w_flat = y.reshape(-1), k.reshape(16, -1), w.reshape(-1)
        for stage in range(first, last + 1):
            combine(stage, y_flat, h, k_flat, w_flat)
            if stage == 13:
                set_to_rest(w, threshold)
            rates(at_time(system, t + NODES[stage] * h), w, k[stage - 1])

    @uncached
    def step(system, count, work, t, y, slope, h, threshold, tolerances, due, w, new_slope, c):
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
            tile_system = system_of_tile(system, left == 0, left + held == sites)
            take(slope, left, k[0])
            if not alone:
                take(y, left, start)
            take_stages(tile_system, 2, 13, t, start, h, threshold, k, end)
            own_columns = (1 + first - left, 1 + stop - left)
            near = error_estimates(start, end, k, scratch, spare, tolerances, own_columns)
            fifth, third = worse(fifth, near[0]), worse(third, near[1])
            error = step_error(h, fifth, third)
            give(k[12], left, first, stop, new_slope)
            if not alone:
                give(end, left, first, stop, w)
            if due and (error <= 1.0 or not alone):
                take_stages(tile_system, 14, 16, t, start, h, threshold, k, scratch)
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
        tile_work = tiles.reshape((TILE_WORK, y.shape[0], columns))
        threshold = rest_level(y, OF_STAGES)
        rates(at_time(system, t), y, slope)
        h = initial_step(system, t, y, slope, c, controls, end - t)
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
            if driven:
                h = t_new - t
            due = times[i] <= t_new
            error = step(
                system,
                count,
                tile_work,
                t,
                state,
                slope,
                h,
                threshold,
                controls,
                due,
                w,
                new_slope,
                c,
            )
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
