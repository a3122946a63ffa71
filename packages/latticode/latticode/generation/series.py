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
from latticode.kernels.simd import LANES, fill, keep_lanes, load, store

from .chain import can_be_tiled, seen_at, sign_at

# --- The ends of the chain: `close` of `chain`, one order at a time ------------------------
# In every order, the padding of the last block repeats the right ghost. This value never exceeds
# the values of sites, so whole blocks can be summed or compared without a mask.


@inlined_by_llvm
def value_at(series: PowerSeries, component: int, site: int, offset: int) -> float:
    """Return the number at an offset within the block of a site; 0 if `site` is negative."""
    place = block_start(series, component, site // LANES) + site % LANES
    return series.memory[place + offset] if site >= 0 else 0.0


def close_ends(reach: int) -> Callable:
    """Return the function that fills ghosts and padding of order k, for rates of this reach."""

    @in_one_pass
    def close(chain: Any, series: PowerSeries, k: int, at_left: bool, at_right: bool) -> None:
        m, sites_in_last, before = series.memory, series.sites_in_last, series.blocks - 1
        sites = before * LANES + sites_in_last
        sign = sign_at(chain, -1, 1)  # factor of the values beyond both ends
        for i in range(reach):
            after_end = seen_at(chain, sites + i, sites)
            before_start = seen_at(chain, -1 - i, sites)
            for component in range(series.components):
                ghosts = ghosts_start(series, component)
                for re_im in range(X, Y + 1, Y - X):
                    offset = k * ORDER_STRIDE + re_im
                    last = block_start(series, component, before) + offset
                    if at_right:
                        value = sign * value_at(series, component, after_end, offset)
                        if i == 0:
                            store(m, last, keep_lanes(load(m, last), sites_in_last, value))
                            store(m, ghosts + RIGHT + re_im, fill(value))
                        elif sites_in_last + i < LANES:
                            m[last + sites_in_last + i] = value
                        else:
                            m[ghosts + RIGHT + re_im + sites_in_last + i - LANES] = value
                    if at_left:
                        value = sign * value_at(series, component, before_start, offset)
                        if i == 0:  # fill the whole vector, which is then faster to read
                            store(m, ghosts + LEFT + re_im, fill(value))
                        else:
                            m[ghosts + LEFT + re_im + LANES - 1 - i] = value

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
        begin = max(series.wave, 0)
        end = begin + 1 if in_one_wave else blocks + lag * ORDER
        for start in range(begin, end, group):
            for k in range(ORDER + 1):
                first = max(start - lag * k, series.first)
                last = min(start - lag * k + group, series.stop)
                if first < last:
                    if k > 0:
                        write_next_order(chain, series, k - 1, first, last)
                    close_order(chain, series, k, first == 0, last == blocks)

    return continue_series
