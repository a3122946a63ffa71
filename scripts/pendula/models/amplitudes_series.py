"""The equations (4) for power series in time: each coefficient of a solution from those before.

With A = sum_k a_k (tau - t)^k, i (k + 1) a_{k+1} is the linear part at a_k and coefficient k of the
cubic term, which `cauchy` sums. Sites go four at a time.
"""

from pendula.compiled import kernel, merged
from pendula.simd import left_neighbours, load, right_neighbours, store

from .amplitudes import PERIODIC, Chain, linear_field
from .block_ends import close
from .blocks import BLOCK, LEFT, ORDER, RIGHT, STEP, X, Y, ghosts_of, start_of
from .cauchy import even_cubic, odd_cubic

LONG = 64
"""Blocks of a chain that outgrows the cache."""
GROUP = 4
"""Blocks that take an order together: 17 groups of them fit into the cache."""


def build(left_of, right_of):
    """Return what writes the next coefficients of some blocks of each component.

    `left_of` takes the block to the left and a block, `right_of` a block and the one to the right;
    they return the neighbours of what the block holds.
    """

    @merged
    def linear_part(scaled, m, left, here, right, partner):
        """Return the linear terms at one part of a block."""
        u = load(m, here)
        before, after = left_of(load(m, left), u), right_of(u, load(m, right))
        return linear_field(scaled, scaled.gamma, before, u, after, load(m, partner))

    @merged
    def extend(chain, series, k, component, block, half_cubic):
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
        x = linear_part(of_y, m, left + Y, u + Y, right + Y, partner + Y) + share * half_cubic[1]
        y = linear_part(of_x, m, left + X, u + X, right + X, partner + X) - share * half_cubic[0]
        store(m, u + STEP + X, x)
        store(m, u + STEP + Y, y)

    @merged
    def next_order(chain, series, k, first, last):
        """Write the coefficients of order k + 1 of the blocks `first` to `last` - 1."""
        m = series.memory
        for component in range(series.components):
            if k % 2 == 0:
                for block in range(first, last):
                    cubic = even_cubic(m, k, start_of(series, component, block))
                    extend(chain, series, k, component, block, cubic)
            else:
                for block in range(first, last):
                    cubic = odd_cubic(m, k, start_of(series, component, block))
                    extend(chain, series, k, component, block, cubic)

    return next_order


next_order = build(left_neighbours, right_neighbours)


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
