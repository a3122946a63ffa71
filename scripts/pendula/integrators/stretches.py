"""A long state in stretches, each of which goes through all stages of a step inside the cache.

A stage of an explicit method looks one site further than the one before. So a stretch is taken
with a margin of sites that its neighbours own: what is wrong at its cut ends moves in by a site a
stage and never reaches the sites that it owns, which get the bits that they would get in one piece.
"""

import numpy as np

from pendula.compiled import kernel

MARGIN = 15
"""Sites on each side that are computed again: the stages after the first."""
LONGEST = 512
"""Sites that a stretch owns at most: its work arrays then fit into half a megabyte of cache."""


@kernel
def count_stretches(sites):
    """Return the number of stretches of about equal length."""
    return max(1, (sites + LONGEST - 1) // LONGEST)


@kernel
def length_of(sites, count):
    """Return how many sites a stretch holds with its margins: as many in each."""
    return min(sites, (sites + count - 1) // count + 2 * MARGIN)


@kernel
def place_of(stretch, count, sites):
    """Return the first site that a stretch holds, the first that it owns, and the next one's."""
    first, stop = stretch * sites // count, (stretch + 1) * sites // count
    left = max(0, min(first - MARGIN, sites - length_of(sites, count)))
    return left, first, stop


@kernel
def copy_columns(source, at, target, to, count):
    """Copy columns; unsigned numbers need no look whether they count from the end."""
    at, to = np.uint64(at), np.uint64(to)
    for row in range(source.shape[0]):
        for j in range(np.uint64(count)):
            target[row, to + j] = source[row, at + j]


@kernel
def take(whole, left, part):
    """Copy the sites that a stretch holds, from `left` on, out of the whole state."""
    copy_columns(whole, 1 + left, part, 1, part.shape[1] - 2)


@kernel
def give(part, left, first, stop, whole):
    """Copy the sites first..stop - 1, which a stretch owns, into the whole state."""
    copy_columns(part, 1 + first - left, whole, 1 + first, stop - first)
