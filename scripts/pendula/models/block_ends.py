"""The ends of the chain for power series in blocks: `close` of `chain`, one order at a time.

The padding of a last block holds what its ghost holds, in every order: so it never exceeds what the
sites hold, and what sums or compares whole blocks need not know of it.
"""

from pendula.compiled import merged
from pendula.simd import fill, keep_lanes, load, store

from .amplitudes import FREE, MIRROR, PERIODIC
from .blocks import LEFT, RIGHT, STEP, X, Y, ghosts_of, start_of


@merged
def close_right(chain, m, first, last, inside, ghosts):
    """Write padding and right ghost of one part, whose first and last block are given."""
    seen = 0.0
    if chain.right == FREE:
        seen = m[last + inside - 1]
    elif chain.right == PERIODIC:
        seen = m[first]
    store(m, last, keep_lanes(load(m, last), inside, seen))
    store(m, ghosts + RIGHT, fill(seen))


@merged
def close_left(chain, m, first, last, inside, ghosts):
    """Write the left ghost of one part, whose first and last block are given."""
    seen = 0.0
    if chain.left == FREE:
        seen = m[first]
    elif chain.left == PERIODIC:
        seen = m[last + inside - 1]
    elif chain.left == MIRROR:
        seen = m[first + 1]
    store(m, ghosts + LEFT, fill(seen))


@merged
def close(chain, series, k, at_left, at_right):
    """Fill ghosts and padding of order k with what the ends of the chain see."""
    m, inside = series.memory, series.inside
    for component in range(series.components):
        ghosts = ghosts_of(series, component)
        for part in range(X, Y + 1, Y - X):
            first = start_of(series, component, 0) + k * STEP + part
            last = start_of(series, component, series.blocks - 1) + k * STEP + part
            if at_right:
                close_right(chain, m, first, last, inside, ghosts + part)
            if at_left:
                close_left(chain, m, first, last, inside, ghosts + part)
