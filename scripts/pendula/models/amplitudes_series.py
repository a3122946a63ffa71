"""The equations (4) as a recurrence for power series in time, the rule of the Taylor method.

With A = sum_k a_k s^k and D = |A|^2 / 2 = sum_k d_k s^k, (4) gives

    i (k + 1) a_{k+1} = linear terms of (4) at a_k + c_k,
    c_k = sum_{j=0}^k d_j a_{k-j},      d_k = sum_{j=0}^k Re(conj(a_j) a_{k-j}) / 2,

so that two Cauchy products make the coefficient c_k of the cubic term. From top to bottom: the ends
of the chain, order by order; the Cauchy products; the recurrence; the order of the work on a chain
that outgrows the cache. How a series lies in memory, in blocks of sites, says
pendula.integrators.taylor; `m` is that memory, and `i` always the place at which a block begins.

Bits. Each lane does what a site alone would, so it changes no bit where in its block a site stands;
neighbours are summed as in `amplitudes`, and so half of an even chain has the bits of the whole.
"""

from pendula.compiled import inlined_by_llvm, kernel
from pendula.integrators.taylor import (
    BLOCK_SIZE,
    EXTRA,
    LEFT,
    ORDER,
    ORDER_STRIDE,
    RIGHT,
    X,
    Y,
    block_start,
    ghosts_start,
)
from pendula.simd import fill, keep_lanes, left_neighbours, load, right_neighbours, store

from .amplitudes import FREE, MIRROR, PERIODIC, Chain, linear_field

HALF_SQUARE = EXTRA
"""Where a coefficient keeps d_k, that of |A|^2 / 2."""


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


# --- The cubic term by Cauchy products ----------------------------------------------------------
# Orders go in pairs: the pass that sums the products of an even order k in registers also sums
# those of order k + 1, but for the terms that hold a_{k+1}, which is not known yet. Each number
# that is loaded thus serves twice, and loads are what limits the speed.


@inlined_by_llvm
def half_square_of_even_order(m, k, i):
    """Return d_k for an even `k`; write it, and d_{k+1} without its terms of a_{k+1}.

    Equal products of the sum, j and k - j, are taken once: d_k is half of the middle one and the
    sum of the others. Re and Im are summed apart, and added at the end.
    """
    middle = i + k // 2 * ORDER_STRIDE
    x, y = load(m, middle + X), load(m, middle + Y)
    sum_x, sum_y = 0.5 * x * x, 0.5 * y * y
    next_x, next_y = fill(0.0), fill(0.0)
    low_x, low_y = load(m, i + X), load(m, i + Y)
    for j in range(1, k // 2 + 1):
        high, low = i + (k + 1 - j) * ORDER_STRIDE, i + j * ORDER_STRIDE
        high_x, high_y = load(m, high + X), load(m, high + Y)
        sum_x, sum_y = sum_x + low_x * high_x, sum_y + low_y * high_y  # j - 1 and k + 1 - j
        low_x, low_y = load(m, low + X), load(m, low + Y)
        next_x, next_y = next_x + low_x * high_x, next_y + low_y * high_y  # j and k + 1 - j
    total = sum_x + sum_y
    store(m, i + k * ORDER_STRIDE + HALF_SQUARE, total)
    store(m, i + (k + 1) * ORDER_STRIDE + HALF_SQUARE, next_x + next_y)
    return total


@inlined_by_llvm
def cubic_of_even_order(m, k, i):
    """Return both parts of c_k for an even `k`; leave c_{k+1} but for two terms in order k + 2.

    The two are d_0 a_{k+1} and d_{k+1} a_0. The place of a_{k+2} is free until c_{k+1} is used.
    """
    last = half_square_of_even_order(m, k, i)
    now_x, now_y, next_x, next_y = fill(0.0), fill(0.0), fill(0.0), fill(0.0)
    d = load(m, i + HALF_SQUARE)
    for j in range(k):
        u = i + (k - j) * ORDER_STRIDE
        x, y = load(m, u + X), load(m, u + Y)
        now_x, now_y = now_x + d * x, now_y + d * y  # d_j a_{k-j}
        d = load(m, i + (j + 1) * ORDER_STRIDE + HALF_SQUARE)
        next_x, next_y = next_x + d * x, next_y + d * y  # d_{j+1} a_{k-j}
    store(m, i + (k + 2) * ORDER_STRIDE + X, next_x)
    store(m, i + (k + 2) * ORDER_STRIDE + Y, next_y)
    return now_x + last * load(m, i + X), now_y + last * load(m, i + Y)


@inlined_by_llvm
def cubic_of_odd_order(m, k, i):
    """Return both parts of c_k for an odd `k`: add the terms of a_k to what was left before."""
    u = i + k * ORDER_STRIDE
    x0, y0, x, y = load(m, i + X), load(m, i + Y), load(m, u + X), load(m, u + Y)
    last, first = load(m, u + HALF_SQUARE) + (x0 * x + y0 * y), load(m, i + HALF_SQUARE)
    store(m, u + HALF_SQUARE, last)
    cubic_x = load(m, u + ORDER_STRIDE + X) + (last * x0 + first * x)
    cubic_y = load(m, u + ORDER_STRIDE + Y) + (last * y0 + first * y)
    return cubic_x, cubic_y


# --- The recurrence -----------------------------------------------------------------------------


@inlined_by_llvm
def linear_part(scaled, m, left, here, right, partner):
    """Return the linear terms at Re or Im of a block, given where it and the others lie."""
    u = load(m, here)
    before, after = left_neighbours(load(m, left), u), right_neighbours(u, load(m, right))
    return linear_field(scaled, scaled.gamma, before, u, after, load(m, partner))


@inlined_by_llvm
def write_next_coefficient(chain, series, k, component, block, cubic):
    """Write a_{k+1} of a block: x_{k+1} = Im F_k / (k + 1) and y_{k+1} = -Re F_k / (k + 1).

    The factor and the signs go into the constants, three numbers instead of three vectors.
    """
    m, share = series.memory, 1.0 / (k + 1)
    u = block_start(series, component, block) + k * ORDER_STRIDE
    ghosts = ghosts_start(series, component)
    left = u - BLOCK_SIZE if block > 0 else ghosts + LEFT
    right = u + BLOCK_SIZE if block < series.blocks - 1 else ghosts + RIGHT
    # the same block of the other component; the block itself when A = B, where the drive vanishes
    # exactly since partner - u is then zero
    partner = u + (series.components - 1 - 2 * component) * series.blocks * BLOCK_SIZE
    epsilon, gamma, omega = share * chain.epsilon, share * chain.gamma, share * chain.omega
    of_y = Chain(epsilon, -gamma, omega, chain.left, chain.right)
    of_x = Chain(-epsilon, -gamma, -omega, chain.left, chain.right)
    x = linear_part(of_y, m, left + Y, u + Y, right + Y, partner + Y) + share * cubic[1]
    y = linear_part(of_x, m, left + X, u + X, right + X, partner + X) - share * cubic[0]
    store(m, u + ORDER_STRIDE + X, x)
    store(m, u + ORDER_STRIDE + Y, y)


@inlined_by_llvm
def write_next_order(chain, series, k, first, last):
    """Write a_{k+1} of the blocks `first` to `last` - 1 of each component."""
    m = series.memory
    for component in range(series.components):
        if k % 2 == 0:  # asked outside the loops over blocks, whose bodies are long
            for block in range(first, last):
                cubic = cubic_of_even_order(m, k, block_start(series, component, block))
                write_next_coefficient(chain, series, k, component, block, cubic)
        else:
            for block in range(first, last):
                cubic = cubic_of_odd_order(m, k, block_start(series, component, block))
                write_next_coefficient(chain, series, k, component, block, cubic)


# --- The order of the work ----------------------------------------------------------------------

CACHED_BLOCKS = 64
"""A chain of more blocks outgrows a cache of half a megabyte."""
GROUP = 4
"""Blocks that take an order together in a wave: 17 groups of them fit into the cache."""


@kernel
def continue_series(chain, series):
    """Write the coefficients of all orders from those of order 0.

    A short chain goes order by order. A long one goes in waves, so that the blocks at work fit into
    the cache (wavefront or skewed tiling): in wave w the group g of blocks takes the order w - g,
    for a coefficient needs no more than the order before of the groups beside it. Both ways do the
    same operations on each block, and so give the same bits.
    """
    blocks = series.blocks
    at_once = blocks <= CACHED_BLOCKS or chain.left == PERIODIC  # a ring has no side to start from
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
