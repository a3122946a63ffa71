"""DOP853, the explicit Runge-Kutta method of order eight of Dormand and Prince.

Source: E. Hairer, S. P. Norsett and G. Wanner, Solving Ordinary Differential Equations I, 2nd
edition (Springer, 1993), and their program dop853.f. The method is in section II.5, the step
control with the initial step in II.4, the interpolant of order seven in II.6, and the error
estimate from orders five and three in II.10. The interpolant needs three more stages, which are
evaluated only in steps with an output. Unlike dop853.f, errors are measured by the largest
component (the modulus of a complex number) instead of the root mean square, so that half of an even
chain takes the same steps as the whole chain.

In all kernels `y` is the state before a step, `w` the state after it or the argument of a stage,
and `k[s - 1]` the slope of stage s. Arguments of stages, error estimates and the interpolant are
weighted sums of slopes. A step may be computed tile by tile (see `tiles`).
"""

from collections.abc import Callable
from math import sqrt
from typing import Any

import numpy as np

from latticode.kernels.compiled import at_any_time, copy, in_one_pass, kernel, uncached
from latticode.kernels.simd import largest_magnitude

from . import DONE, INTERRUPTED, NOT_FINITE, SMALLEST_PART, STEP_TOO_SMALL, Outcome
from .dop853_coefficients import D4, D5, D6, D7, E3, E5, NODES, STAGES
from .rest import OF_STAGES, rest_level, set_to_rest, square_modulus
from .tiles import count_tiles, is_zero, read_tile, tile_length, tile_place, write_tile
from .weighted_sums import table, write_sum

Array = np.ndarray
Pair, Columns = tuple[float, float], tuple[int, int]

TILE_WORK = 27
"""Number of work arrays of the size of a tile."""
WHOLE_WORK = 11
"""Number of work arrays of the size of a state."""
WORK = WHOLE_WORK + TILE_WORK
"""Number of all work arrays if the whole state is one tile."""


def work_arrays(sites: int) -> int:
    """Return how many work arrays of the size of a state a run in tiles needs."""
    columns = tile_length.py_func(sites, count_tiles.py_func(sites)) + 2
    return WHOLE_WORK + -(-TILE_WORK * columns // (sites + 2))


# --- The stages ---------------------------------------------------------------------------------

# numba types literals separately and would compile `write_sum` again
FIFTH, THIRD, CURVE = np.int64(17), np.int64(18), 19
"""Rows of the table: weights of the two error estimates, and the first row of the interpolant."""
ROWS = table(
    {**STAGES, FIFTH: E5, THIRD: E3, **dict(enumerate((D4, D5, D6, D7), CURVE))}, CURVE + 4
)


@kernel
def combine(stage: int, y: Array, h: float, k: Array, w: Array) -> None:
    """Write the argument of a stage (2 to 16) into `w`; the argument of stage 13 is the solution.

    `y` and `w` are flat; `k` (stage, number) holds the slopes of the earlier stages.
    """
    write_sum(ROWS, stage, y, h, k, w)


# --- The error of a step: its largest component in units of the tolerance -------------------------


@kernel
def weighted_norm(
    v: Array, y: Array, w: Array, spare: Array, tolerances: Pair, columns: Columns
) -> float:
    """Return the largest |v| / (atol + rtol max(|y|, |w|)) in the `columns` (first, stop).

    `spare` is scratch memory of the size of these columns.
    """
    (rtol, atol), squares, size = tolerances, spare.reshape(-1), np.uint64(0)
    # unsigned indices need no test for negative ones, which would count from the end
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
def weigh_slopes(k: Array, row: int, out: Array) -> None:
    """Write the sum of slopes with the weights of a row of the table into the flat `out`."""
    write_sum(ROWS, row, out[:0], 1.0, k, out)


@kernel
def error_estimates(
    y: Array, w: Array, k: Array, scratch: Array, spare: Array, tolerances: Pair, columns: Columns
) -> Pair:
    """Return the error estimates of orders five and three in the `columns` (first, stop)."""
    k_flat, flat = k.reshape(16, -1), scratch.reshape(-1)
    weigh_slopes(k_flat, FIFTH, flat)
    fifth = weighted_norm(scratch, y, w, spare, tolerances, columns)
    weigh_slopes(k_flat, THIRD, flat)
    return fifth, weighted_norm(scratch, y, w, spare, tolerances, columns)


@kernel
def step_error(h: float, fifth: float, third: float) -> float:
    """Return the error of a step in units of the tolerance, infinity if it is not finite.

    It is h e5^2 / sqrt(e5^2 + 0.01 e3^2) with e5 = `fifth` and e3 = `third` (section II.10). It is
    proportional to the eighth power of the step.
    """
    if not fifth + third < np.inf:
        return np.inf
    if fifth == 0.0:
        return 0.0
    return h * fifth * fifth / sqrt(fifth * fifth + 0.01 * third * third)


@kernel
def worse(first_error: float, second_error: float) -> float:
    """Return the larger of two errors, NaN if the second is NaN, which max() would ignore."""
    return (
        second_error if second_error > first_error or second_error != second_error else first_error
    )


# --- The interpolant of order seven within a step -----------------------------------------------


@kernel
def prepare_interpolant(y: Array, w: Array, h: float, k: Array, c: Array) -> None:
    """Write the coefficients c[0..6] of the interpolant over the step from `y` to `w`.

    The first three follow from values and slopes at both ends, the others from all stages.
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
def interpolate(x: float, y: Array, c: Array, out: Array) -> None:
    """Write the interpolant at the fraction `x` of the step into `out`.

    It is y + x (c0 + z (c1 + x (c2 + z (c3 + ...)))) with z = 1 - x.
    """
    z = 1.0 - x
    for row in range(y.shape[0]):
        for j in range(1, y.shape[1] - 1):
            inner = c[3, row, j] + x * (c[4, row, j] + z * (c[5, row, j] + x * c[6, row, j]))
            outer = c[0, row, j] + z * (c[1, row, j] + x * (c[2, row, j] + z * inner))
            out[row, j] = y[row, j] + x * outer


# --- Step control -------------------------------------------------------------------------------


@kernel
def eighth_root(x: float) -> float:
    """Return x^(1/8) by square roots, which have the same bits on every processor."""
    return sqrt(sqrt(sqrt(x)))


@kernel
def step_factor(error: float) -> float:
    """Return the factor for the next step: equation (4.13) of section II.4, safety factor 0.9."""
    return 0.9 / eighth_root(error) if error > 0.0 else 6.0


@kernel
def euler_step(size: float, speed: float) -> float:
    """Return a first guess of the step from the norms of the state and of its rate."""
    return 0.01 * size / speed if min(size, speed) > 1e-5 else 1e-6


@kernel
def never(system: Any) -> bool:
    return False


@kernel
def unchanged(system: Any, at_left_end: bool, at_right_end: bool) -> Any:
    return system


def build(
    rates: Callable,
    observe: Callable,
    can_be_tiled: Callable = never,
    system_of_tile: Callable = unchanged,
    at_time: Callable = at_any_time,
) -> Callable:
    """Return the solver of y' = rates; the package describes its arguments.

    `can_be_tiled(system)` returns whether the rates at a site depend only on this site and its two
    neighbours. `system_of_tile(system, at_left_end, at_right_end)` then returns the system of a
    tile, which may contain one or both ends of the chain.
    """
    driven = at_time is not at_any_time

    @uncached
    def initial_step(system, t, y, slope, spare, tolerances, longest):
        """Return the initial step of Hairer, Norsett and Wanner (section II.4).

        It follows from the norms of y, y' and y'', where y'' is estimated by an Euler step.
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

        In the solution, numbers below `threshold` become zero before its slope is computed.
        """
        y_flat, k_flat, w_flat = y.reshape(-1), k.reshape(16, -1), w.reshape(-1)
        for stage in range(first, last + 1):
            combine(stage, y_flat, h, k_flat, w_flat)
            if stage == 13:
                set_to_rest(w, threshold)
            rates(at_time(system, t + NODES[stage] * h), w, k[stage - 1])

    @uncached
    def step(system, count, work, t, y, slope, h, threshold, tolerances, due, w, new_slope, c):
        """Compute a step in `count` tiles, and return its error.

        State and slope after the step are written into `w` and `new_slope`, and, if an output is
        `due`, the coefficients of the interpolant into `c`. `work` holds TILE_WORK arrays of the
        size of a tile. A single tile uses `y`, `w` and `c` directly, and prepares the interpolant
        only if the step is accepted. Several tiles prepare it before this is known, because the
        next tile overwrites the stages.
        """
        k, scratch, spare, alone = work[:16], work[16], work[17], count == 1
        start, end, curve = (y, w, c) if alone else (work[18], work[19], work[20:])
        sites, in_tile = y.shape[1] - 2, work.shape[2] - 2
        fifth = third = error = 0.0
        for tile in range(count):
            left, first, stop = tile_place(tile, count, sites)
            tile_system = system_of_tile(system, left == 0, left + in_tile == sites)
            read_tile(slope, left, k[0])
            if not alone:
                read_tile(y, left, start)
                if not driven and is_zero(start) and is_zero(k[0]):
                    write_tile(start, left, first, stop, w)
                    write_tile(start, left, first, stop, new_slope)
                    for m in range(c.shape[0] if due else 0):
                        write_tile(start, left, first, stop, c[m])
                    continue
            take_stages(tile_system, 2, 13, t, start, h, threshold, k, end)
            own_columns = (1 + first - left, 1 + stop - left)
            near = error_estimates(start, end, k, scratch, spare, tolerances, own_columns)
            fifth, third = worse(fifth, near[0]), worse(third, near[1])
            error = step_error(h, fifth, third)
            write_tile(k[12], left, first, stop, new_slope)
            if not alone:
                write_tile(end, left, first, stop, w)
            if due and (error <= 1.0 or not alone):
                take_stages(tile_system, 14, 16, t, start, h, threshold, k, scratch)
                prepare_interpolant(start, end, h, k, curve)
                for m in range(0 if alone else c.shape[0]):
                    write_tile(curve[m], left, first, stop, c[m])
        return error

    @in_one_pass
    def solve(system, y, times, controls, work, record, stop) -> Outcome:
        t, end = times[0], times[-1]
        state, w, slope, new_slope, out = y, work[0], work[1], work[2], work[3]
        c = work[4:WHOLE_WORK]
        count = count_tiles(y.shape[1] - 2) if can_be_tiled(system) else 1
        columns = tile_length(y.shape[1] - 2, count) + 2
        size = TILE_WORK * y.shape[0] * columns
        tiles = work[WHOLE_WORK:].reshape(-1)[:size].reshape((TILE_WORK, y.shape[0], columns))
        threshold = rest_level(y, OF_STAGES)
        rates(at_time(system, t), y, slope)
        h = initial_step(system, t, y, slope, c, controls, end - t)
        i = np.int64(0)  # numba types a literal 0 separately and would compile `observe` twice
        observe(system, y, i, record)
        i += 1
        steps, rejected, evaluations = 0, 0, 2
        most_growth = 6.0
        overflowed = not h < np.inf
        shortest = SMALLEST_PART * (end - t)
        if h <= shortest:  # a first guess that is too short is no reason to stop
            h = 2.0 * shortest
        while i < times.size:
            if stop[0]:
                return Outcome(INTERRUPTED, t, steps, rejected, evaluations)
            if h * (1.0 + 1e-9) >= end - t:  # avoid a last step of the size of a rounding error
                h = end - t
            if not h > shortest:  # also where h is NaN
                status = NOT_FINITE if overflowed else STEP_TOO_SMALL
                return Outcome(status, t, steps, rejected, evaluations)
            t_new = end if h == end - t else t + h
            if driven:
                h = t_new - t
            due = times[i] <= t_new
            error = step(
                system, count, tiles, t, state, slope, h, threshold, controls, due, w, new_slope, c
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
        if steps % 2:  # `state` is a work array
            copy(state, y)
        return Outcome(DONE, t, steps, rejected, evaluations)

    return solve
