"""The Taylor method for a batch of runs of any model: each lane of a vector contains another run.

A short chain leaves most lanes of a vector empty, and spends half of a step outside the series. A
batch has LANES runs of one chain, which may differ in parameters and initial data. A block of the
series (see latticode.integrators.taylor) contains one site of all runs, and its neighbours are the
next blocks. A generated module takes `in_waves`, `left_neighbours` and `right_neighbours` from here
in place of those for one run, and then continues a batch by the text that continues one run.

Each run has its own step, by the same operations as a run alone, so its results have the same bits.
If the series of a run does not determine a step, the run leaves the batch: its status is GONE. It
must then be computed alone, which also finds the reason if it cannot go on.
"""

from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np

from latticode.integrators import DONE, INTERRUPTED, SMALLEST_PART
from latticode.integrators.rest import OF_SERIES, rest_level
from latticode.integrators.taylor import (
    ALL_WAVES,
    LEFT,
    ORDER,
    ORDER_STRIDE,
    RIGHT,
    SMALLEST_COMPONENT,
    SQUARES,
    PowerSeries,
    X,
    Y,
    advance,
    block_start,
    fifteenth_root_of_finite,
    ghosts_start,
    largest_in_lanes,
    sixteenth_root,
    sum_at,
)
from latticode.kernels.compiled import in_one_pass, inlined_by_llvm, kernel
from latticode.kernels.simd import (
    LANES,
    fill,
    load,
    select_positive,
    square_root,
    store,
)

from .series import sites_beyond

REACH = 1
"""The farthest neighbours that a rate may read."""

# --- The series of a batch ------------------------------------------------------------------------


@inlined_by_llvm
def left_neighbours(previous: Any, block: Any) -> Any:
    """Return the left neighbours of a block: the previous block."""
    return previous


@inlined_by_llvm
def right_neighbours(block: Any, following: Any) -> Any:
    """Return the right neighbours of a block: the next block."""
    return following


@inlined_by_llvm
def value_beyond(
    series: PowerSeries, component: int, offset: int, end: tuple[int, int], sign: float
) -> Any:
    """Return the values at the first site beyond an end, at an offset in its block."""
    place = block_start(series, component, end[0]) + offset
    return sign * load(series.memory, place) if end[0] >= 0 else fill(0.0)


@in_one_pass
def close(beyond: tuple, series: PowerSeries, k: int) -> None:
    """Fill the ghosts of order k."""
    right_end, left_end, sign = beyond
    for component in range(series.components):
        for part in range(X, Y + 1, Y - X):
            ghosts, offset = ghosts_start(series, component) + part, k * ORDER_STRIDE + part
            left = value_beyond(series, component, offset, left_end, sign)
            right = value_beyond(series, component, offset, right_end, sign)
            store(series.memory, ghosts + LEFT, left)
            store(series.memory, ghosts + RIGHT, right)


def in_waves(write_next_order: Callable, reach: int) -> Callable:
    """Return the function that continues the series of a batch, all sites of an order at once.

    It replaces `series.in_waves` and so takes its arguments; `reach` is REACH or less.
    """

    @in_one_pass
    def continue_series(chain: Any, series: PowerSeries) -> None:
        beyond = sites_beyond(chain, series.blocks)
        close(beyond, series, 0)
        for k in range(ORDER):
            write_next_order(chain, series, k, 0, series.blocks)
            close(beyond, series, k + 1)

    return continue_series


# --- The runs and their steps ---------------------------------------------------------------------

Array = np.ndarray
MOVING, GONE = -1, -2
"""The status of a run that has not ended, and of one that must be computed alone."""


class Batch(NamedTuple):
    """The runs of a batch, and work arrays; (run,) if no other shape is given."""

    states: Array  # (run * row, column): the initial states
    constants: Array  # (constant * run,): the constants of the equations
    time: Array
    step: Array
    offset: Array  # of the next output from the time
    threshold: Array  # smaller numbers are set to zero
    status: Array  # integers
    output: Array  # the indices of the next outputs
    values: Array  # (row * column * run,): the states at the next output
    state: Array  # (row, column): the state of one run


def make_batch(states: Array, constants: Array) -> Batch:
    """Return a batch from initial `states` (run, row, column) and `constants` (run, constant)."""
    count, rows, columns = states.shape
    floats, integers = np.zeros((4, LANES)), np.zeros((2, LANES), np.int64)
    integers[0] = MOVING
    last = [count - 1] * (LANES - count)  # the other lanes repeat the last run
    return Batch(
        np.concatenate([states, states[last]]).reshape(-1, columns),
        np.concatenate([constants, constants[last]]).T.ravel(),
        *floats,
        *integers,
        np.zeros(rows * columns * LANES),
        np.zeros((rows, columns)),
    )


def memory_of(work: int, states: Array) -> int:
    """Return how many numbers the series of a batch need; states are (run, row, column).

    `work` is the WORK of the rule: SMALLEST_COMPONENT times as many numbers suffice for a block of
    a component. Here each site is a block, and a component has two rows.
    """
    _, rows, columns = states.shape
    return work * SMALLEST_COMPONENT * rows // 2 * (columns - 2)


@inlined_by_llvm
def lay_out(memory: Array, state: Array) -> PowerSeries:
    """Return a series of a batch in `memory`; each block has one site."""
    sites = state.shape[1] - 2
    return PowerSeries(memory, state.shape[0] // 2, sites, LANES, sites, -1, 0, sites, ALL_WAVES)


@kernel
def start_run(batch: Batch, run: int, series: PowerSeries, time: float) -> None:
    """Write the initial state of a run into `state` and into order 0 of the series."""
    rows = batch.state.shape[0]
    for row in range(rows):
        for site in range(series.blocks):
            place = block_start(series, row // 2, site) + row % 2 * (Y - X)
            value = batch.states[run * rows + row, 1 + site]
            batch.state[row, 1 + site] = series.memory[place + run] = value
    batch.time[run], batch.threshold[run] = time, rest_level(batch.state, OF_SERIES)


@kernel
def copy_state(batch: Batch, run: int) -> None:
    """Copy the state of a run from `values` to `state`."""
    rows, columns = batch.state.shape
    for row in range(rows):
        for column in range(1, columns - 1):
            batch.state[row, column] = batch.values[(row * columns + column) * LANES + run]


@kernel
def evaluate(series: PowerSeries, batch: Batch) -> None:
    """Write the sums of the series at each run's `offset` into `values`."""
    rows, columns = batch.state.shape
    h = load(batch.offset, 0)
    for row in range(rows):
        for site in range(series.blocks):
            i = block_start(series, row // 2, site) + row % 2 * (Y - X)
            store(batch.values, (row * columns + 1 + site) * LANES, sum_at(series.memory, i, h))


@inlined_by_llvm
def largest_moduli(series: PowerSeries, k: int) -> Any:
    """Return a vector of what `taylor.largest_modulus` returns for each run alone."""
    square, part = largest_in_lanes(series, k)
    return select_positive(SQUARES - square, part, square_root(square))


@kernel
def allow_steps(series: PowerSeries, rtol: float, atol: float, batch: Batch) -> None:
    """Write the step of each run that `taylor.allowed_step` returns for the run alone.

    It is zero or NaN where the run alone would not use both of the last two orders: if a
    coefficient overflows, or that of order ORDER - 1 vanishes.
    """
    tolerance = atol + rtol * largest_moduli(series, 0)
    of_last_but_one = fifteenth_root_of_finite(tolerance / largest_moduli(series, ORDER - 1))
    of_last = sixteenth_root(tolerance / largest_moduli(series, ORDER))
    # the minimum; NaN if `of_last_but_one` is NaN. If `of_last` is NaN, so is the next state
    store(batch.step, 0, select_positive(of_last_but_one - of_last, of_last, of_last_but_one))


@kernel
def limit_steps(batch: Batch, end: float, shortest: float) -> None:
    """Shorten each step that would pass the end of the run; set it to zero for runs that stand.

    A run whose step is too short, zero or NaN leaves the batch.
    """
    for run in range(LANES):
        h, t = batch.step[run], batch.time[run]
        if batch.status[run] != MOVING:
            h = 0.0
        elif not h > shortest:
            batch.status[run], h = GONE, 0.0
        elif h * (1.0 + 1e-9) >= end - t:
            h = end - t
        batch.step[run] = h


@kernel
def find_outputs(batch: Batch, times: Array, end: float) -> bool:
    """Write the offset of each run's next output in this step; return whether there is one."""
    any_due = False
    for run in range(LANES):
        i, t, h = batch.output[run], batch.time[run], batch.step[run]
        batch.offset[run] = -1.0
        if batch.status[run] == MOVING and i < times.size and times[i] <= end_of_step(t, h, end):
            batch.offset[run], any_due = times[i] - t, True
    return any_due


@kernel
def end_of_step(t: float, h: float, end: float) -> float:
    """Return the time after a step, which is exact at the end of the run."""
    return end if h == end - t else t + h


@kernel
def end_steps(batch: Batch, end: float, outputs: int) -> bool:
    """Set the time of each run to the end of its step; return whether any is still moving."""
    moving = False
    for run in range(LANES):
        batch.time[run] = end_of_step(batch.time[run], batch.step[run], end)
        if batch.output[run] == outputs:
            batch.status[run] = DONE
        moving = moving or batch.status[run] == MOVING
    return moving


def build(continue_series: Callable, with_constants: Callable, observe: Callable) -> Callable:
    """Return the solver of batches of the equations with the rule `continue_series`.

    with_constants(system, constants) returns the system with vectors of the constants of all runs.
    Output i of run r is observed as output r * times.size + i of `record`. The package describes
    the other arguments; the equations must not depend on time.
    """

    @in_one_pass
    def observe_outputs(system: Any, batch: Batch, times: Array, record: Any) -> None:
        """Observe the next output of each run whose offset is not negative."""
        for run in range(LANES):
            if batch.offset[run] >= 0.0:
                copy_state(batch, run)
                observe(system, batch.state, run * times.size + batch.output[run], record)
                batch.output[run] += 1

    @in_one_pass
    def solve(system, batch, times, controls, memory, record, stop) -> int:
        rtol, atol = controls
        end, shortest = times[-1], SMALLEST_PART * (times[-1] - times[0])
        series, systems = lay_out(memory, batch.state), with_constants(system, batch.constants)
        for run in range(LANES):
            start_run(batch, run, series, times[0])
            observe(system, batch.state, run * times.size, record)
            batch.output[run] = 1
        while end_steps(batch, end, times.size):
            if stop[0]:
                return INTERRUPTED
            continue_series(systems, series)
            allow_steps(series, rtol, atol, batch)
            limit_steps(batch, end, shortest)
            while find_outputs(batch, times, end):
                evaluate(series, batch)
                observe_outputs(system, batch, times, record)
            advance(series, load(batch.step, 0), load(batch.threshold, 0))
        return DONE

    return solve
