"""Four runs in the lanes of vectors: where their series begin, how far they go, and their sums."""

from typing import NamedTuple

import numpy as np

from pendula.compiled import kernel
from pendula.models.blocks import BLOCK, GHOSTS, ORDER, Series, X, Y, ghosts_of, start_of
from pendula.vectors import LANES, load, store

from .seats import SEAT, choose_step
from .taylor import advance, sum_at
from .taylor_step import largest, modulus


class Workspace(NamedTuple):
    """What a batch works on besides its runs."""

    series: Series  # a block holds one site of the runs in the lanes
    states: np.ndarray  # (lane, row, column), at an output
    seats: np.ndarray  # (lane,), structured as SEAT


def make_workspace(rows: int, columns: int) -> Workspace:
    """Return the workspace for states of a shape."""
    components, sites = rows // 2, columns - 2
    memory = np.zeros(components * (sites * BLOCK + GHOSTS))
    series = Series(memory, components, sites, LANES)
    return Workspace(series, np.zeros((LANES, rows, columns)), np.zeros(LANES, SEAT))


@kernel
def write_lane(y, series, lane):
    """Let a lane of the series begin with the state `y`."""
    for row in range(y.shape[0]):
        for site in range(series.blocks):
            i = start_of(series, row // 2, site) + row % 2 * LANES
            series.memory[i + lane] = y[row, 1 + site]


@kernel
def empty_lane(series, lane):
    """Let a lane of the series begin with a state at rest."""
    for block in range(series.components * series.blocks):
        for part in range(X, Y + 1, Y - X):
            series.memory[block * BLOCK + part + lane] = 0.0


@kernel
def evaluate(series, seats, states):
    """Write the sums of the series, each lane at its own offset, into `states` (lane, ...)."""
    m, spare = series.memory, ghosts_of(series, 0)  # ghosts are written anew before they are read
    for lane in range(LANES):
        m[spare + lane] = seats[lane].offset
    h = load(m, spare)
    for row in range(states.shape[1]):
        for site in range(series.blocks):
            i = start_of(series, row // 2, site) + row % 2 * LANES
            store(m, spare, sum_at(m, i, h))
            for lane in range(LANES):
                states[lane, row, 1 + site] = m[spare + lane]


@kernel
def choose_steps(series, seats, end, shortest, controls, ended):
    """Write the step of each lane from the sizes of its coefficients."""
    m, spare = series.memory, ghosts_of(series, 0)
    for i, k in enumerate((0, ORDER - 1, ORDER)):
        square, part = largest(series, k)
        store(m, spare + 2 * i * LANES, square)
        store(m, spare + (2 * i + 1) * LANES, part)
    for lane in range(LANES):
        i = spare + lane
        here = modulus(m[i], m[i + LANES])
        before = modulus(m[i + 2 * LANES], m[i + 3 * LANES])
        last = modulus(m[i + 4 * LANES], m[i + 5 * LANES])
        choose_step(seats[lane], (here, before, last), end, shortest, controls, ended)


@kernel
def step_on(series, seats):
    """Replace order 0 by the sums of the series, each lane at its own step."""
    m, spare = series.memory, ghosts_of(series, 0)
    for lane in range(LANES):
        m[spare + lane] = seats[lane].step
    advance(series, load(m, spare))
