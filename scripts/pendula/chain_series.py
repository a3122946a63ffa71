"""The equations (4) for power series in time: each coefficient of a solution from those before.

With A = sum_k a_k (tau - t)^k, i (k + 1) a_{k+1} is the linear part at a_k and half the coefficient
of |A|^2 A, which two Cauchy products give: first |A|^2 / 2, whose coefficients are kept, then that
times A. Sites go four at a time and orders in pairs: one pass sums the products of an even order k
in registers, and those of order k + 1 but for the terms that hold its own coefficients, so that
each number that is loaded serves twice.
"""

from .block_ends import close
from .blocks import BLOCK, DENSITY, LEFT, ORDER, RIGHT, STEP, X, Y, ghosts_of, start_of
from .chain import PERIODIC, Chain, linear_field
from .compiled import kernel, merged
from .lanes import seen_left, seen_right
from .vectors import fill, load, store

LONG = 64
"""Blocks of a chain that outgrows the cache."""
GROUP = 4
"""Blocks that take an order together: 17 groups of them fit into the cache."""

# not cached on its own: its cache would not notice a change in `vectors`
linear_vector = merged(getattr(linear_field, "py_func", linear_field))


@merged
def linear_part(scaled, m, left, here, right, partner):
    """Return the linear terms at one part of four sites."""
    u = load(m, here)
    before, after = seen_left(load(m, left), u), seen_right(u, load(m, right))
    return linear_vector(scaled, scaled.gamma, before, u, after, load(m, partner))


@merged
def extend(chain, series, k, component, block, half_cubic_x, half_cubic_y):
    """Write coefficient k + 1 of a block."""
    m, share = series.memory, 1.0 / (k + 1)
    u, ghosts = start_of(series, component, block) + k * STEP, ghosts_of(series, component)
    left = u - BLOCK if block > 0 else ghosts + LEFT
    right = u + BLOCK if block < series.blocks - 1 else ghosts + RIGHT
    # the block itself when A = B: the drive then vanishes exactly
    partner = u + (series.components - 1 - 2 * component) * series.blocks * BLOCK
    epsilon, gamma, omega = share * chain.epsilon, share * chain.gamma, share * chain.omega
    of_y = Chain(epsilon, -gamma, omega, chain.left, chain.right)
    of_x = Chain(-epsilon, -gamma, -omega, chain.left, chain.right)
    x = linear_part(of_y, m, left + Y, u + Y, right + Y, partner + Y) + share * half_cubic_y
    y = linear_part(of_x, m, left + X, u + X, right + X, partner + X) - share * half_cubic_x
    store(m, u + STEP + X, x)
    store(m, u + STEP + Y, y)


@merged
def square(m, k, i):
    """Return coefficient k, even, of the density; write it, and k + 1 as far as known."""
    u = i + k // 2 * STEP
    x, y = load(m, u + X), load(m, u + Y)
    sum_x, sum_y = 0.5 * x * x, 0.5 * y * y
    later_x, later_y = fill(0.0), fill(0.0)
    low_x, low_y = load(m, i + X), load(m, i + Y)
    for j in range(1, k // 2 + 1):
        high, low = i + (k + 1 - j) * STEP, i + j * STEP
        high_x, high_y = load(m, high + X), load(m, high + Y)
        sum_x, sum_y = sum_x + low_x * high_x, sum_y + low_y * high_y
        low_x, low_y = load(m, low + X), load(m, low + Y)
        later_x, later_y = later_x + low_x * high_x, later_y + low_y * high_y
    total = sum_x + sum_y
    store(m, i + k * STEP + DENSITY, total)
    store(m, i + (k + 1) * STEP + DENSITY, later_x + later_y)
    return total


@merged
def even_order(chain, series, k, component, block):
    """Extend a block from order k; the known cubic terms of k + 1 wait in coefficient k + 2."""
    m, i = series.memory, start_of(series, component, block)
    last = square(m, k, i)
    now_x, now_y, next_x, next_y = fill(0.0), fill(0.0), fill(0.0), fill(0.0)
    here = load(m, i + DENSITY)
    for j in range(k):
        u = i + (k - j) * STEP
        x, y = load(m, u + X), load(m, u + Y)
        now_x, now_y = now_x + here * x, now_y + here * y
        here = load(m, i + (j + 1) * STEP + DENSITY)
        next_x, next_y = next_x + here * x, next_y + here * y
    store(m, i + (k + 2) * STEP + X, next_x)
    store(m, i + (k + 2) * STEP + Y, next_y)
    cubic_x, cubic_y = now_x + last * load(m, i + X), now_y + last * load(m, i + Y)
    extend(chain, series, k, component, block, cubic_x, cubic_y)


@merged
def odd_order(chain, series, k, component, block):
    """Extend a block from order k: add the terms that hold its own coefficients."""
    m, i = series.memory, start_of(series, component, block)
    u = i + k * STEP
    x0, y0, x, y = load(m, i + X), load(m, i + Y), load(m, u + X), load(m, u + Y)
    last, first = load(m, u + DENSITY) + (x0 * x + y0 * y), load(m, i + DENSITY)
    store(m, u + DENSITY, last)
    cubic_x = load(m, u + STEP + X) + (last * x0 + first * x)
    cubic_y = load(m, u + STEP + Y) + (last * y0 + first * y)
    extend(chain, series, k, component, block, cubic_x, cubic_y)


@merged
def next_order(chain, series, k, first, last):
    """Write the coefficients of order k + 1 of some blocks of each component."""
    for component in range(series.components):
        if k % 2 == 0:
            for block in range(first, last):
                even_order(chain, series, k, component, block)
        else:
            for block in range(first, last):
                odd_order(chain, series, k, component, block)


@kernel
def continue_series(chain, series):
    """Write the coefficients of all orders from those of order 0.

    Order by order, or on a long chain in waves: each group of blocks is one order behind the group
    to its left, so that the groups at work fit into the cache.
    """
    blocks = series.blocks
    whole = blocks <= LONG or chain.left == PERIODIC  # a ring has no side to start a wave from
    group = blocks if whole else GROUP
    groups = (blocks + group - 1) // group
    for wave in range(groups + ORDER):
        for k in range(max(0, wave - groups + 1), min(wave, ORDER) + 1):
            first = (wave - k) * group
            last = min(first + group, blocks)
            if k > 0:
                next_order(chain, series, k - 1, first, last)
            close(chain, series, k, first == 0, last == blocks)
