"""For all models: power series beyond the ends of the chain, and the loop over blocks.

A series is stored in blocks of sites, in the memory `m`: see latticode.integrators.taylor.

Bits. The bits of a site do not depend on its position in a block, because all lanes execute the
same operations. Neighbours are summed in the order of the right-hand sides, so half of an even
chain has the bits of the whole chain.
"""

from collections.abc import Callable
from typing import Any

from latticode.integrators.taylor import (
    BLOCK_SIZE,
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
def place_of(chain: Any, series: PowerSeries, site: int) -> int:
    """Return the offset, within an order, of the site `seen_at`; -1 if `site` is at rest."""
    at = seen_at(chain, site, (series.blocks - 1) * LANES + series.sites_in_last)
    return at // LANES * BLOCK_SIZE + at % LANES if at >= 0 else -1


def close_ends(reach: int) -> Callable:
    """Return the function that fills ghosts and padding of order k, for rates of this reach."""

    @in_one_pass
    def close(chain: Any, series: PowerSeries, k: int, at_left: bool, at_right: bool) -> None:
        m, sites_in_last, before = series.memory, series.sites_in_last, series.blocks - 1
        for i in range(reach):
            after_end = place_of(chain, series, before * LANES + sites_in_last + i)
            before_start = place_of(chain, series, -1 - i)
            sign = sign_at(chain, -1, 1)  # factor of the values beyond both ends
            for component in range(series.components):
                ghosts = ghosts_start(series, component)
                for re_im in range(X, Y + 1, Y - X):
                    start = block_start(series, component, 0) + k * ORDER_STRIDE + re_im
                    last = start + before * BLOCK_SIZE
                    if at_right:
                        value = sign * m[start + after_end] if after_end >= 0 else 0.0
                        if i == 0:
                            store(m, last, keep_lanes(load(m, last), sites_in_last, value))
                            store(m, ghosts + RIGHT + re_im, fill(value))
                        elif sites_in_last + i < LANES:
                            m[last + sites_in_last + i] = value
                        else:
                            m[ghosts + RIGHT + re_im + sites_in_last + i - LANES] = value
                    if at_left:
                        value = sign * m[start + before_start] if before_start >= 0 else 0.0
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
    u = block_start(series, component, block) + k * ORDER_STRIDE
    ghosts = ghosts_start(series, component)
    left = u - BLOCK_SIZE if block > 0 else ghosts + LEFT
    right = u + BLOCK_SIZE if block < series.blocks - 1 else ghosts + RIGHT
    return left, u, right


# --- The loop over orders and blocks ------------------------------------------------------------

SHORT = 32
"""Largest number of blocks that are computed order by order; for more blocks waves are faster."""
GROUP = 8
"""Number of blocks computed together. They and the blocks one order behind fit into the cache."""


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
        execute the same operations on each block, so the bits are the same.
        """
        blocks = series.blocks
        # the first block of a ring needs the last one
        at_once = everywhere or blocks <= SHORT or not can_be_tiled(chain)
        group, lag = (blocks, 0) if at_once else (GROUP, 1)
        for start in range(0, blocks + lag * ORDER, group):
            for k in range(ORDER + 1):
                first = max(start - lag * k, 0)
                last = min(start - lag * k + group, blocks)
                if first < last:
                    if k > 0:
                        write_next_order(chain, series, k - 1, first, last)
                    close_order(chain, series, k, first == 0, last == blocks)

    return continue_series
