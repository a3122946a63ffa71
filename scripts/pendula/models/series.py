"""What the power series of all models share: the ends of the chain, and the order of the work.

How a series lies in memory, in blocks of sites, says pendula.integrators.taylor; `m` is that
memory.

Bits. Each lane does what a site alone would, so it changes no bit where in its block a site stands;
neighbours are summed as in the right-hand sides, and so half of an even chain has the bits of the
whole.
"""

from pendula.compiled import inlined_by_llvm, uncached
from pendula.ends import FREE, PERIODIC
from pendula.integrators.taylor import (
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
from pendula.simd import LANES, fill, keep_lanes, load, store

from .chain import MIRROR, seen_at

# --- The ends of the chain: `close` of `amplitudes`, one order at a time ------------------------
# The padding of a last block holds what its ghost holds, in every order: so it never exceeds what
# the sites hold, and what sums or compares whole blocks needs no mask.


@inlined_by_llvm
def close_right_end(chain, m, first, last, sites_in_last, ghost):
    """Write padding and right ghost of Re or Im, which lies in the blocks at `first` and `last`."""
    seen = 0.0
    if chain.right == FREE:
        seen = m[last + sites_in_last - 1]
    elif chain.right == PERIODIC:
        seen = m[first]
    store(m, last, keep_lanes(load(m, last), sites_in_last, seen))
    store(m, ghost, fill(seen))


@inlined_by_llvm
def close_left_end(chain, m, first, last, sites_in_last, ghost):
    """Write the left ghost of Re or Im, which lies in the blocks at `first` and `last`."""
    seen = 0.0
    if chain.left == FREE:
        seen = m[first]
    elif chain.left == PERIODIC:
        seen = m[last + sites_in_last - 1]
    elif chain.left == MIRROR:
        seen = m[first + 1]
    store(m, ghost, fill(seen))


@inlined_by_llvm
def close_order(chain, series, k, at_left, at_right):
    """Fill ghosts and padding of order `k`, at the left end, the right end, or both."""
    m, sites = series.memory, series.sites_in_last
    for component in range(series.components):
        ghosts = ghosts_start(series, component)
        for part in range(X, Y + 1, Y - X):
            first = block_start(series, component, 0) + k * ORDER_STRIDE + part
            last = block_start(series, component, series.blocks - 1) + k * ORDER_STRIDE + part
            if at_right:
                close_right_end(chain, m, first, last, sites, ghosts + RIGHT + part)
            if at_left:
                close_left_end(chain, m, first, last, sites, ghosts + LEFT + part)


def close_widely(reach):
    """Return what fills ghosts and padding of an order where equations look `reach` sites far."""

    @inlined_by_llvm
    def value_at(chain, series, start, site):
        sites = (series.blocks - 1) * LANES + series.sites_in_last
        at = seen_at(chain, site, sites)
        return series.memory[start + at // LANES * BLOCK_SIZE + at % LANES] if at >= 0 else 0.0

    @inlined_by_llvm
    def close(chain, series, k, at_left, at_right):
        m, kept = series.memory, series.sites_in_last
        sites = (series.blocks - 1) * LANES + kept
        for component in range(series.components):
            ghosts = ghosts_start(series, component)
            for part in range(X, Y + 1, Y - X):
                start = block_start(series, component, 0) + k * ORDER_STRIDE + part
                last = start + (series.blocks - 1) * BLOCK_SIZE
                if at_right:
                    end = value_at(chain, series, start, sites)
                    store(m, last, keep_lanes(load(m, last), kept, end))
                    for i in range(reach):
                        lane, value = kept + i, value_at(chain, series, start, sites + i)
                        if lane < LANES:
                            m[last + lane] = value
                        else:
                            m[ghosts + RIGHT + part + lane - LANES] = value
                if at_left:
                    for i in range(1, reach + 1):
                        value = value_at(chain, series, start, -i)
                        m[ghosts + LEFT + part + LANES - i] = value

    return close


# --- Neighbours ---------------------------------------------------------------------------------


@inlined_by_llvm
def sides_of(series, k, component, block):
    """Return where a block begins at order `k`, and where the blocks, or ghosts, beside it do."""
    u = block_start(series, component, block) + k * ORDER_STRIDE
    ghosts = ghosts_start(series, component)
    left = u - BLOCK_SIZE if block > 0 else ghosts + LEFT
    right = u + BLOCK_SIZE if block < series.blocks - 1 else ghosts + RIGHT
    return left, u, right


# --- The order of the work ----------------------------------------------------------------------

CACHED_BLOCKS = 64
"""A chain of more blocks outgrows a cache of half a megabyte."""
GROUP = 4
"""Blocks that take an order together in a wave: 17 groups of them fit into the cache."""


def in_waves(write_next_order, close_order=close_order):
    """Return the function that continues a series, given the rule for one order of some blocks.

    write_next_order(chain, series, k, first, last) writes the coefficients of order k + 1 of the
    blocks `first` to `last` - 1 of each component, and `close_order` fills what lies beyond ends.
    """

    @uncached
    def continue_series(chain, series):
        """Write the coefficients of all orders from those of order 0.

        A short chain goes order by order. A long one goes in waves, so that the blocks at work fit
        into the cache (wavefront or skewed tiling): in wave w the group g of blocks takes the order
        w - g, for a coefficient needs no more than the order before of the groups beside it. Both
        ways do the same operations on each block, and so give the same bits.
        """
        blocks = series.blocks
        # a ring has no side to start from
        at_once = blocks <= CACHED_BLOCKS or chain.left == PERIODIC
        group = blocks if at_once else GROUP
        groups = (blocks + group - 1) // group
        for wave in range(groups + ORDER):
            # from the rightmost group to the left: each finds the order before to both of its sides
            for k in range(max(0, wave - groups + 1), min(wave, ORDER) + 1):
                first = (wave - k) * group
                last = min(first + group, blocks)
                if k > 0:
                    write_next_order(chain, series, k - 1, first, last)
                close_order(chain, series, k, first == 0, last == blocks)

    return continue_series
