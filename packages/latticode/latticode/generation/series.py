"""What the power series of all models share: the ends of the chain, and the order of the work.

How a series lies in memory, in blocks of sites, says latticode.integrators.taylor; `m` is that
memory.

Bits. Each lane does what a site alone would, so it changes no bit where in its block a site stands;
neighbours are summed as in the right-hand sides, and so half of an even chain has the bits of the
whole.
"""

from collections.abc import Callable

from latticode.equations.ends import ANTIPERIODIC, PERIODIC
from latticode.integrators.taylor import (
    BLOCK_SIZE,
    LEFT,
    ORDER,
    ORDER_STRIDE,
    RIGHT,
    X,
    Y,
    block_start,
    ghosts_start,
)
from latticode.kernels.compiled import inlined_by_llvm, uncached
from latticode.kernels.simd import LANES, fill, keep_lanes, load, store

from .chain import seen_at, sign_at

# --- The ends of the chain: `close` of `chain`, one order at a time ------------------------
# The padding of a last block holds what its ghost holds, in every order: so it never exceeds what
# the sites hold, and what sums or compares whole blocks needs no mask.


@inlined_by_llvm
def place_of(chain, series, site) -> int:
    """Return where from the start of an order a site lies that stands for `site`; -1 if at rest."""
    at = seen_at(chain, site, (series.blocks - 1) * LANES + series.sites_in_last)
    return at // LANES * BLOCK_SIZE + at % LANES if at >= 0 else -1


def close_ends(reach) -> Callable:
    """Return what fills ghosts and padding of an order where equations look `reach` sites far."""

    @inlined_by_llvm
    def close(chain, series, k, at_left, at_right):
        m, sites_in_last, before = series.memory, series.sites_in_last, series.blocks - 1
        for i in range(reach):
            after_end = place_of(chain, series, before * LANES + sites_in_last + i)
            before_start = place_of(chain, series, -1 - i)
            sign = sign_at(chain, -1, 1)  # of what stands beyond both ends
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
                        if i == 0:  # at once: a vector is read sooner if it is written as one
                            store(m, ghosts + LEFT + re_im, fill(value))
                        else:
                            m[ghosts + LEFT + re_im + LANES - 1 - i] = value

    return close


# --- Neighbours ---------------------------------------------------------------------------------


@inlined_by_llvm
def sides_of(series, k, component, block) -> tuple[int, int, int]:
    """Return where a block begins at order `k`, and where the blocks, or ghosts, beside it do."""
    u = block_start(series, component, block) + k * ORDER_STRIDE
    ghosts = ghosts_start(series, component)
    left = u - BLOCK_SIZE if block > 0 else ghosts + LEFT
    right = u + BLOCK_SIZE if block < series.blocks - 1 else ghosts + RIGHT
    return left, u, right


# --- The order of the work ----------------------------------------------------------------------

SHORT = 32
"""A chain of more blocks gains by waves."""
GROUP = 8
"""Blocks that take an order together: with those that lag behind them they fit into the cache."""


def in_waves(write_next_order, reach, everywhere=False) -> Callable:
    """Return the function that continues a series, given the rule for one order of some blocks.

    write_next_order(chain, series, k, first, last) writes the coefficients of order k + 1 of the
    blocks `first` to `last` - 1 of each component from what lies up to `reach` sites beyond them.
    Where it is `everywhere`, because a matrix couples all sites, each order is written at once.
    """
    close_order = close_ends(reach)

    @uncached
    def continue_series(chain, series):
        """Write the coefficients of all orders from those of order 0.

        A short chain goes order by order. A long one goes in waves from left to right, so that the
        blocks at work fit into the cache (wavefront or skewed tiling): each order lags behind the
        one before by a block, since a coefficient needs that of the blocks next to its own. Both
        ways do the same operations on each block, and so give the same bits.
        """
        blocks = series.blocks
        # a ring has no side to start from
        at_once = everywhere or blocks <= SHORT or chain.left in (PERIODIC, ANTIPERIODIC)
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
