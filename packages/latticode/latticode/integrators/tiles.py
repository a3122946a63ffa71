"""A long state in tiles: each tile goes through all stages of a step inside the cache.

The sixteen stages of a long chain do not fit into the cache, and memory would set the pace. A
stage of an explicit method looks one site further than the one before. So a tile is taken with a
margin of sites that belong to its neighbours (overlapped tiling): what is wrong at its ends moves
in by a site a stage and never reaches the sites that the tile owns, which get the bits that they
would get in one piece.
"""

import numpy as np

from latticode.kernels.compiled import kernel

MARGIN = 15
"""Sites on each side that are computed again: one for each stage after the first."""
LONGEST = 512
"""Sites that a tile owns at most: its work arrays then fit into half a megabyte of cache."""


@kernel
def count_tiles(sites):
    """Return into how many tiles of about equal length a chain is divided."""
    return max(1, (sites + LONGEST - 1) // LONGEST)


@kernel
def tile_length(sites, count):
    """Return how many sites a tile holds with its margins: as many in each of `count` tiles."""
    return min(sites, (sites + count - 1) // count + 2 * MARGIN)


@kernel
def tile_place(tile, count, sites):
    """Return the first site that a tile holds, the first that it owns, and the one behind these."""
    first, stop = tile * sites // count, (tile + 1) * sites // count
    left = max(0, min(first - MARGIN, sites - tile_length(sites, count)))
    return left, first, stop


@kernel
def copy_columns(source, at, target, to, count):
    """Copy columns; the indices are unsigned, so that no code asks if they count from the end."""
    at, to = np.uint64(at), np.uint64(to)
    for row in range(source.shape[0]):
        for j in range(np.uint64(count)):
            target[row, to + j] = source[row, at + j]


@kernel
def take(state, left, tile):
    """Copy the sites that a tile holds, from `left` on, out of the whole state."""
    copy_columns(state, 1 + left, tile, 1, tile.shape[1] - 2)


@kernel
def give(tile, left, first, stop, state):
    """Copy the sites first..stop - 1, which the tile owns, into the whole state."""
    copy_columns(tile, 1 + first - left, state, 1 + first, stop - first)
