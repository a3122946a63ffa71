"""Overlapped tiling of a long chain: all stages of a tile's step stay in the cache.

The sixteen stages of a long chain do not fit into the cache, and memory would limit the speed. Each
stage of an explicit method depends on one more neighbour to each side. A tile is therefore copied
with a margin of its neighbours' sites. Errors at the ends of the margin move inwards by one site
per stage and never reach the sites of the tile itself. These get the same bits as without tiles.

If state and slope of a tile are zero and the equations do not depend on time, all its stages are
zero too, and are not computed.
"""

import numpy as np

from latticode.kernels.compiled import kernel

MARGIN = 15
"""Number of sites in the margin on each side, one for each stage after the first."""
LONGEST = 512
"""Largest number of sites of a tile without margins; its work arrays fit into 512 kB of cache."""


@kernel
def count_tiles(sites: int) -> int:
    """Return the number of tiles, of about equal length, into which a chain is divided."""
    return max(1, (sites + LONGEST - 1) // LONGEST)


@kernel
def tile_length(sites: int, count: int) -> int:
    """Return the number of sites in each of `count` tiles, margins included."""
    return min(sites, (sites + count - 1) // count + 2 * MARGIN)


@kernel
def tile_place(tile: int, count: int, sites: int) -> tuple[int, int, int]:
    """Return the first site of a tile's margin, and the first and last + 1 of the tile itself."""
    first, stop = tile * sites // count, (tile + 1) * sites // count
    left = max(0, min(first - MARGIN, sites - tile_length(sites, count)))
    return left, first, stop


@kernel
def copy_columns(source: np.ndarray, at: int, target: np.ndarray, to: int, count: int) -> None:
    """Copy columns; unsigned indices need no test for negative ones, which count from the end."""
    at, to = np.uint64(at), np.uint64(to)
    for row in range(source.shape[0]):
        for j in range(np.uint64(count)):
            target[row, to + j] = source[row, at + j]


@kernel
def read_tile(state: np.ndarray, left: int, tile: np.ndarray) -> None:
    """Copy the sites from `left` on, margins included, from the whole state into a tile."""
    copy_columns(state, 1 + left, tile, 1, tile.shape[1] - 2)


@kernel
def is_zero(tile: np.ndarray) -> bool:
    """Return whether all numbers of a tile, margins included, are zero."""
    for row in range(tile.shape[0]):
        for j in range(1, tile.shape[1] - 1):
            if tile[row, j] != 0.0:
                return False
    return True


@kernel
def write_tile(tile: np.ndarray, left: int, first: int, stop: int, state: np.ndarray) -> None:
    """Copy the sites first..stop - 1 of a tile, without its margins, into the whole state."""
    copy_columns(tile, 1 + first - left, state, 1 + first, stop - first)
