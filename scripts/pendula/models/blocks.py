"""A power series in memory: blocks of four sites, whose coefficients all lie side by side.

A block holds Re, Im and half the squared modulus of one component, order after order, so that each
coefficient is at a fixed distance from the block's start and a small chain fits into the fastest
cache. After the last site a block is padded; behind all blocks lie the ghosts, what each component
sees beyond its two ends. (In a batch of short chains a block holds one site of four of them.)
"""

from typing import NamedTuple

import numpy as np

from pendula.compiled import kernel, merged
from pendula.simd import LANES

ORDER = 16
X, Y, DENSITY = 0, LANES, 2 * LANES  # where the parts of a coefficient are; density is |A|^2 / 2
STEP = 3 * LANES  # from one order to the next
BLOCK = (ORDER + 1) * STEP  # from one block to the next
LEFT, RIGHT = 0, STEP  # where the ghosts of a component are
GHOSTS = 2 * STEP
SMALLEST = 6  # numbers in a component of one site with its ghost columns
WORK = -(-(BLOCK + GHOSTS) // SMALLEST)  # arrays of the size of a state


class Series(NamedTuple):
    """Coefficients of a state of (row, column), whose rows are Re and Im of each component."""

    memory: np.ndarray  # flat: component, block, order, part, lane; then the ghosts
    components: int
    blocks: int  # of one component
    inside: int  # lanes of a component's last block that are sites


@merged
def lay_out(work, y):
    """Return a series of states like `y` in the memory of `work`."""
    sites = y.shape[1] - 2
    blocks = (sites + LANES - 1) // LANES
    return Series(work.reshape(-1), y.shape[0] // 2, blocks, sites - (blocks - 1) * LANES)


@merged
def start_of(series, component, block):
    """Return where in memory a block begins."""
    return (component * series.blocks + block) * BLOCK


@merged
def ghosts_of(series, component):
    """Return where in memory the ghosts of a component begin."""
    return series.components * series.blocks * BLOCK + component * GHOSTS


@kernel
def write_state(y, series):
    """Let the series begin with the state `y`."""
    for row in range(y.shape[0]):
        for b in range(series.blocks):
            place = start_of(series, row // 2, b) + row % 2 * LANES
            for j in range(LANES):
                column = 1 + b * LANES + j
                series.memory[place + j] = y[row, column] if column < y.shape[1] - 1 else 0.0
