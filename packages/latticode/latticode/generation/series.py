"""Power series of a state: values beyond its ends, and the loop over blocks, common to all models.

A series is stored in blocks of sites, in the memory `m`: see latticode.integrators.taylor.

Bits. They do not depend on a site's position in its block, because all lanes execute the same
operations. Neighbours are summed as in right-hand sides, so half of an even chain has the bits of
the whole chain.
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
# The padding of a last block has the values of its ghost in every order. These never exceed the
# values of sites, so whole blocks can be summed or compared without a mask.


@inlined_by_llvm
def place_of(chain: Any, series: PowerSeries, site: int) -> int:
    """Return the offset in an order of the value of `site`, as `seen_at`; -1 if it is at rest."""
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
            sign = sign_at(chain, -1, 1)  # of the values beyond both ends
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
                        if i == 0:  # the whole vector, which is then faster to read
                            store(m, ghosts + LEFT + re_im, fill(value))
                        else:
                            m[ghosts + LEFT + re_im + LANES - 1 - i] = value

    return close


# --- Neighbours ---------------------------------------------------------------------------------


@inlined_by_llvm
def sides_of(series: PowerSeries, k: int, component: int, block: int) -> tuple[int, int, int]:
    """Return where order `k` begins in the previous block, in the block and in the next one.

    The first and last blocks have ghosts as neighbours.
    """
    u = block_start(series, component, block) + k * ORDER_STRIDE
    ghosts = ghosts_start(series, component)
    left = u - BLOCK_SIZE if block > 0 else ghosts + LEFT
    right = u + BLOCK_SIZE if block < series.blocks - 1 else ghosts + RIGHT
    return left, u, right


# --- The loop over orders and blocks ------------------------------------------------------------

SHORT = 32
"""Chains of more blocks are computed in waves, which is faster for them."""
GROUP = 8
"""Number of blocks computed together; they fit into the cache with the blocks one order behind."""


def in_waves(write_next_order: Callable, reach: int, everywhere: bool = False) -> Callable:
    """Return the function that continues a series, from a rule for one order of some blocks.

    write_next_order(chain, series, k, first, last) writes the coefficients of order k + 1 in the
    blocks `first` to `last` - 1 of each component. It reads up to `reach` sites beyond them. With
    `everywhere` each order is written in all blocks at once, because a matrix couples all sites.
    """
    close_order = close_ends(reach)

    @in_one_pass
    def continue_series(chain: Any, series: PowerSeries) -> None:
        """Write the coefficients of all orders from those of order 0.

        A short chain is computed order by order. A long one is computed in waves from left to
        right, whose blocks fit into the cache (wavefront or skewed tiling). Each order lags one
        block behind the previous one, because it needs that order in the neighbouring blocks. The
        operations on each block, and thus the bits, are the same.
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
