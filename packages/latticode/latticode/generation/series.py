"""For all models: power series beyond the ends of the chain, and the loop over blocks.

A series is stored in blocks of sites, in the memory `m`: see latticode.integrators.taylor.

Bits. The bits of a site do not depend on its position in a block, because all lanes execute the
same operations. Neighbours are summed in the order of the right-hand sides, so half of an even
chain has the bits of the whole chain.
"""

from collections.abc import Callable
from typing import Any

from latticode.integrators.taylor import (
    ALL_WAVES,
    GROUP,
    LEFT,
    ORDER,
    ORDER_STRIDE,
    RIGHT,
    PowerSeries,
    X,
    Y,
    block_start,
    ghosts_start,
)
from latticode.kernels.compiled import in_one_pass, inlined_by_llvm
from latticode.kernels.simd import LANES, fill, fill_from, keep_lanes, load, store

from .chain import can_be_tiled, seen_at, sign_at

# --- The ends of the chain: `close` of `chain`, one order at a time ------------------------
# In every order, the padding of the last block repeats the right ghost. This value never exceeds
# the values of sites, so whole blocks can be summed or compared without a mask.


@inlined_by_llvm
def sites_beyond(chain: Any, sites: int) -> tuple[tuple, tuple, float]:
    """Return from which sites those beyond the right end and the left end get their values.

    Each end has the site that the first one sees, -1 if it is at rest, and the step to the site
    that the next one sees. The last number is the factor of the values.
    """
    right, left = seen_at(chain, sites, sites), seen_at(chain, -1, sites)
    right_step = seen_at(chain, sites + 1, sites) - right
    left_step = seen_at(chain, -2, sites) - left
    return (right, right_step), (left, left_step), sign_at(chain, -1, 1)


@inlined_by_llvm
def value_beyond(
    series: PowerSeries, component: int, offset: int, end: tuple[int, int], i: int, sign: float
) -> Any:
    """Return a vector of the value at the `i`-th site beyond an end, at an offset in its block."""
    site = end[0] + i * end[1]
    place = block_start(series, component, site // LANES) + site % LANES + offset
    return sign * fill_from(series.memory, place) if end[0] >= 0 else fill(0.0)


def close_ends(reach: int) -> Callable:
    """Return the function that fills ghosts and padding of order k, for rates of this reach."""

    @in_one_pass
    def close(beyond: tuple, series: PowerSeries, k: int, at_left: bool, at_right: bool) -> None:
        m, in_last, before = series.memory, series.sites_in_last, series.blocks - 1
        right_end, left_end, sign = beyond
        for component in range(series.components):
            for re_im in range(X, Y + 1, Y - X):
                ghosts = ghosts_start(series, component) + re_im
                offset = k * ORDER_STRIDE + re_im
                last = block_start(series, component, before) + offset
                padded, right, left = load(m, last), fill(0.0), fill(0.0)
                for i in range(reach):
                    value = value_beyond(series, component, offset, right_end, i, sign)
                    padded = keep_lanes(padded, in_last + i, value)
                    right = keep_lanes(right, in_last + i - LANES, value)
                    value = value_beyond(series, component, offset, left_end, i, sign)
                    left = keep_lanes(value, LANES - i, left)
                # Loads precede all stores. Otherwise, LLVM would store only the changed lanes, and
                # the next order would wait until that store has reached the cache.
                if at_left:
                    store(m, ghosts + LEFT, left)
                if at_right:
                    store(m, ghosts + RIGHT, right)
                    store(m, last, padded)

    return close


# --- Neighbours ---------------------------------------------------------------------------------


@inlined_by_llvm
def sides_of(series: PowerSeries, k: int, component: int, block: int) -> tuple[int, int, int]:
    """Return where order `k` begins in the previous block, in this block and in the next block.

    The first and last blocks have ghosts as neighbours.
    """
    order, ghosts = k * ORDER_STRIDE, ghosts_start(series, component)
    u = block_start(series, component, block) + order
    left = block_start(series, component, block - 1) + order if block > 0 else ghosts + LEFT
    right = ghosts + RIGHT
    if block < series.blocks - 1:
        right = block_start(series, component, block + 1) + order
    return left, u, right


# --- The loop over orders and blocks ------------------------------------------------------------

SHORT = 32
"""Largest number of blocks that are computed order by order; for more blocks waves are faster."""


def in_waves(write_next_order: Callable, reach: int, everywhere: bool = False) -> Callable:
    """Return the function that continues a series by a rule for one order of some blocks.

    write_next_order(chain, series, k, first, last) writes the coefficients of order k + 1 in the
    blocks `first` to `last` - 1 of each component, and reads up to `reach` sites beyond them. If a
    matrix couples all sites, `everywhere` is set: each order is written in all blocks at once.
    """
    close_order = close_ends(reach)

    @in_one_pass
    def continue_series(chain: Any, series: PowerSeries) -> None:
        """Write the coefficients of all orders from those of order 0.

        A short chain is computed order by order. A long chain is computed in waves from left to
        right (wavefront or skewed tiling). The blocks of a wave fit into the cache. Each order lags
        one block behind the previous order, which it needs in the neighbouring blocks. Both ways
        execute the same operations on each block, so the bits are the same. Blocks outside
        series.first..series.stop - 1 are skipped, and so are all waves but `series.wave`, unless it
        is ALL_WAVES.
        """
        blocks, in_one_wave = series.blocks, series.wave != ALL_WAVES
        # the first block of a ring needs the last one
        at_once = everywhere or blocks <= SHORT or not can_be_tiled(chain)
        group, lag = (blocks, 0) if at_once and not in_one_wave else (GROUP, 1)
        beyond = sites_beyond(chain, (blocks - 1) * LANES + series.sites_in_last)
        begin = max(series.wave, 0)
        end = begin + 1 if in_one_wave else blocks + lag * ORDER
        for start in range(begin, end, group):
            left, right = start, start + group
            for k in range(ORDER + 1):
                first, last = max(left, series.first), min(right, series.stop)
                if first < last:
                    if k > 0:
                        write_next_order(chain, series, k - 1, first, last)
                    if first == 0 or last == blocks:
                        close_order(beyond, series, k, first == 0, last == blocks)
                left, right = left - lag, right - lag

    return continue_series
