"""The Taylor method for long chains: only the blocks of a few waves have their series in memory.

The coefficients of a long chain do not fit into the cache, so memory would limit the speed. Here
each block is summed as soon as its last order is known, and its memory is then used again by the
block RING blocks farther along the chain. See `generation.series` for the waves.

Step control: the allowed step (see `taylor`) is known only after all blocks are summed. A step
therefore has the length of SHARE times the last allowed step. If it turns out to be longer than its
own allowed step, it is repeated with the latter, so no step exceeds the tolerance. Outputs are
summed together with the state after the step, so a step passes at most OUTPUTS of them.

Window: if a chain at rest stays at rest, only the blocks that can move during a step are computed.
"""

from collections.abc import Callable

import numpy as np

from latticode.kernels.compiled import (
    at_any_time,
    copy,
    in_one_pass,
    inlined_by_llvm,
    kernel,
    uncached,
)
from latticode.kernels.simd import (
    LANES,
    fill,
    larger_magnitude,
    largest_lane,
    load,
    store,
    zero_below,
)

from . import DONE, INTERRUPTED, NOT_FINITE, SMALLEST_PART, STEP_TOO_SMALL, Outcome
from .rest import OF_SERIES, rest_level
from .taylor import (
    BLOCK_SIZE,
    GROUP,
    LOWEST,
    ORDER,
    ORDER_STRIDE,
    PowerSeries,
    X,
    Y,
    block_start,
    largest_of,
    step_of_last_orders,
    step_of_order,
    sum_at,
)

Array = np.ndarray

LONGER_THAN = 8192
"""Largest number of sites whose series are all in memory: these chains fit into the cache."""
RING = 32
"""Number of blocks of a component in memory, a power of two. A wave needs ORDER + GROUP + 1."""
OUTPUTS = 4
"""Largest number of outputs in a step."""
SHARE = 0.93
"""Length of a step divided by the allowed length of the previous step. On chaotic chains a larger
share would be repeated more often, and a smaller share would take more steps."""
PEAKS = 2 * (ORDER + 1) * LANES
"""Memory for the largest squares and the largest parts in each order."""
SPARE = PEAKS + LANES
"""Memory in addition to the ring."""


def work_arrays(work: int, sites: int) -> int:
    """Return how many work arrays of the size of a state a chain of `sites` sites needs.

    `work` is the number that holds a series of any chain.
    """
    return 1 + OUTPUTS - (-(work * (RING * LANES + 2) + SPARE) // (sites + 2))


@kernel
def ring_in(memory: Array, y: Array) -> PowerSeries:
    """Return a series with RING blocks of each component in memory, for states of `y`'s shape."""
    sites, components = y.shape[1] - 2, y.shape[0] // 2
    blocks = (sites + LANES - 1) // LANES
    in_last = sites - (blocks - 1) * LANES
    return PowerSeries(memory, components, blocks, in_last, RING, RING - 1, 0, blocks, 0)


@kernel
def at_wave(series: PowerSeries, first: int, stop: int, wave: int) -> PowerSeries:
    """Return the series with a window of blocks and the wave that begins at block `wave`."""
    memory, components, blocks, in_last, held, mask, _, _, _ = series
    return PowerSeries(memory, components, blocks, in_last, held, mask, first, stop, wave)


@kernel
def fill_with_zeros(memory: Array) -> None:
    """Set an array (number,) to zero; an array expression would take longer to compile."""
    for i in range(memory.size):
        memory[i] = 0.0


# --- The window of blocks that can move -----------------------------------------------------------


@kernel
def moves(y: Array, block: int) -> bool:
    """Return whether a site of a block is not at rest."""
    for row in range(y.shape[0]):
        for j in range(1 + block * LANES, min(1 + (block + 1) * LANES, y.shape[1] - 1)):
            if y[row, j] != 0.0:
                return True
    return False


@kernel
def window_of(y: Array, first: int, stop: int, margin: int) -> tuple[int, int]:
    """Return the first block that can move in the next step, and the block after the last one.

    All blocks outside first..stop - 1 are at rest. A step moves at most `margin` more blocks on
    each side.
    """
    left, right = first, stop - 1
    while left < stop and not moves(y, left):
        left += 1
    while right > left and not moves(y, right):
        right -= 1
    blocks = (y.shape[1] - 2 + LANES - 1) // LANES
    return max(0, left - margin), min(blocks, right + 1 + margin)


# --- One block ------------------------------------------------------------------------------------


@inlined_by_llvm
def read_block(state: Array, series: PowerSeries, block: int) -> None:
    """Write a block of a state into order 0 of the series, and zeros into its padding.

    The state is flat, which saves the check that a reshaped array needs no copy.
    """
    m, rows = series.memory, 2 * series.components
    for row in range(rows):
        place = block_start(series, row // 2, block) + row % 2 * LANES
        column = row * (state.size // rows) + 1 + block * LANES
        if block < series.blocks - 1:
            store(m, place, load(state, column))
        else:
            for j in range(LANES):
                m[place + j] = state[column + j] if j < series.sites_in_last else 0.0


@inlined_by_llvm
def clear_block(series: PowerSeries, block: int) -> None:
    """Set the series of a block to zero: it is at rest during the step."""
    for component in range(series.components):
        start = block_start(series, component, block)
        for i in range(start, start + BLOCK_SIZE, LANES):
            store(series.memory, i, fill(0.0))


@inlined_by_llvm
def write_block(
    series: PowerSeries, block: int, h: float, threshold: float, state: Array, spare: Array
) -> None:
    """Write the sums of a block's series at time `h` into a flat state.

    Numbers below `threshold` are set to zero. `spare` holds one vector.
    """
    m, rows = series.memory, 2 * series.components
    for row in range(rows):
        place = block_start(series, row // 2, block) + row % 2 * LANES
        column = row * (state.size // rows) + 1 + block * LANES
        value = zero_below(threshold, sum_at(m, place, h))
        if block < series.blocks - 1:
            store(state, column, value)
        else:
            store(spare, 0, value)
            for j in range(series.sites_in_last):
                state[column + j] = spare[j]


@inlined_by_llvm
def raise_peak(series: PowerSeries, block: int, k: int, peaks: Array) -> float:
    """Include order `k` of a block in the largest squares and the largest parts of this order.

    Return the largest part so far.
    """
    m, i = series.memory, 2 * k * LANES
    square, part = load(peaks, i), load(peaks, i + LANES)
    for component in range(series.components):
        u = block_start(series, component, block) + k * ORDER_STRIDE
        x, y = load(m, u + X), load(m, u + Y)
        square = larger_magnitude(square, x * x + y * y)
        part = larger_magnitude(part, larger_magnitude(x, y))
    store(peaks, i, square)
    store(peaks, i + LANES, part)
    return largest_lane(part)


@kernel
def raise_peaks(series: PowerSeries, block: int, peaks: Array) -> None:
    """Include a block in the peaks of the orders from which the step follows.

    The other orders matter only if the last two vanish in all blocks.
    """
    raise_peak(series, block, 0, peaks)
    last_but_one = raise_peak(series, block, ORDER - 1, peaks)
    last = raise_peak(series, block, ORDER, peaks)
    if last == 0.0 and last_but_one == 0.0:
        for k in range(LOWEST, ORDER - 1):
            raise_peak(series, block, k, peaks)


# --- Step control ---------------------------------------------------------------------------------


@kernel
def peak(peaks: Array, k: int) -> float:
    """Return the largest modulus in order `k`."""
    square, part = load(peaks, 2 * k * LANES), load(peaks, (2 * k + 1) * LANES)
    return largest_of(largest_lane(square), largest_lane(part))


@kernel
def allowed_step(peaks: Array, rtol: float, atol: float) -> float:
    """Return the step that `taylor.allowed_step` returns."""
    last_but_one, last = peak(peaks, ORDER - 1), peak(peaks, ORDER)
    if not last + last_but_one < np.inf:
        return np.nan
    tolerance = atol + rtol * peak(peaks, 0)
    if last > 0.0 or last_but_one > 0.0:
        return step_of_last_orders(last_but_one, last, tolerance)
    for k in range(ORDER - 2, LOWEST - 1, -1):
        if peak(peaks, k) > 0.0:
            return step_of_order(peak(peaks, k), tolerance)
    return np.inf


def build(
    continue_series: Callable,
    observe: Callable,
    reach: int,
    stays_at_rest: bool,
    at_time: Callable = at_any_time,
) -> Callable:
    """Return the solver of a long chain with the rule `continue_series(system, series)`.

    The rates of a site depend on at most `reach` sites on each side, and the chain is no ring.
    `stays_at_rest` tells whether all rates of a chain at rest are zero. The package describes the
    other arguments, and those of the solver.
    """
    driven = at_time is not at_any_time
    margin = reach * ORDER // LANES

    @uncached
    def take_step(system, series, t, h, times, threshold, state, new, outputs, peaks):
        """Write the state after a step of length `h` from the time `t` into `new`.

        Also write the states at `times` into `outputs`, and the peaks of the series.
        """
        first, stop, spare = series.first, series.stop, peaks[PEAKS:]
        old, following = state.reshape(-1), new.reshape(-1)
        at_times = outputs.reshape((outputs.shape[0], -1))
        fill_with_zeros(peaks)
        for wave in range(first, stop + ORDER, GROUP):
            if wave == first and first > 0:
                clear_block(series, first - 1)
            for block in range(wave, min(wave + GROUP, stop)):
                read_block(old, series, block)
            if wave < stop <= wave + GROUP and stop < series.blocks:
                clear_block(series, stop)
            continue_series(system, at_wave(series, first, stop, wave))
            for block in range(max(first, wave - ORDER), min(stop, wave - ORDER + GROUP)):
                raise_peaks(series, block, peaks)
                for j in range(times.size):
                    write_block(series, block, times[j] - t, 0.0, at_times[j], spare)
                write_block(series, block, h, threshold, following, spare)

    @in_one_pass
    def solve(system, y, times, controls, work, record, stop) -> Outcome:
        rtol, atol = controls
        t, end = times[0], times[-1]
        state, new, outputs = y, work[0], work[1 : 1 + OUTPUTS]
        memory = work[1 + OUTPUTS :].reshape(-1)
        series, peaks = ring_in(memory[:-SPARE], y), memory[-SPARE:]
        if stays_at_rest:
            fill_with_zeros(work[: 1 + OUTPUTS].reshape(-1))
            first, after = window_of(y, 0, series.blocks, margin)
            series = at_wave(series, first, after, 0)
        shortest, threshold = SMALLEST_PART * (end - t), rest_level(y, OF_SERIES)
        i = np.int64(0)  # numba types a literal 0 separately and would compile `observe` twice
        observe(system, y, i, record)
        i += 1
        steps, repeated, trial = 0, 0, np.inf
        while i < times.size:
            if stop[0]:
                return Outcome(INTERRUPTED, t, steps, repeated, ORDER * (steps + repeated))
            last = min(times.size, i + OUTPUTS) - 1
            h = times[last] - t
            t_new = times[last]
            if trial * (1.0 + 1e-9) < h:  # avoids a last step of the size of a rounding error
                t_new = t + trial
                h = t_new - t if driven else trial
            passed = i
            while passed <= last and times[passed] <= t_new:
                passed += 1
            now = at_time(system, t)
            take_step(now, series, t, h, times[i:passed], threshold, state, new, outputs, peaks)
            allowed = allowed_step(peaks, rtol, atol)
            if not allowed > shortest:  # also where it is NaN
                status = STEP_TOO_SMALL if allowed <= shortest else NOT_FINITE
                return Outcome(status, t, steps, repeated, ORDER * (steps + repeated))
            if h > allowed * (1.0 + 1e-9):
                trial = allowed
                repeated += 1
                continue
            for j in range(passed - i):
                observe(system, outputs[j], i, record)
                i += 1
            state, new = new, state
            t, trial = t_new, SHARE * allowed
            steps += 1
            if stays_at_rest:
                first, after = window_of(state, series.first, series.stop, margin)
                series = at_wave(series, min(first, series.first), max(after, series.stop), 0)
        if steps % 2:  # `state` is a work array
            copy(state, y)
        return Outcome(DONE, t, steps, repeated, ORDER * (steps + repeated))

    return solve
