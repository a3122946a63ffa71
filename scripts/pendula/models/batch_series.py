"""Power series of many chains of equal length at once: each lane belongs to a run of its own.

A block then holds one site of four runs, and its neighbours are the blocks beside it. Every lane
has its own epsilon, gamma and omega; the ends are of one kind.
"""

from typing import NamedTuple

import numpy as np

from pendula.compiled import kernel, merged
from pendula.vectors import LANES, fill, load, store

from .amplitudes import FREE, PERIODIC, Chain
from .amplitudes_series import build
from .blocks import BLOCK, LEFT, ORDER, RIGHT, STEP, X, Y, ghosts_of, start_of


class Chains(NamedTuple):
    """The parameters of all runs, and of those that are in the lanes now."""

    constants: np.ndarray  # (run, 3): epsilon, gamma, omega
    end: int  # the kind of both ends
    seated: np.ndarray  # flat: constant, lane


@kernel
def chain_of(chains, run):
    """Return the chain of one run."""
    c = chains.constants
    return Chain(c[run, 0], c[run, 1], c[run, 2], chains.end, chains.end)


@kernel
def seat(chains, run, lane):
    """Let a lane have the parameters of a run."""
    for i in range(3):
        chains.seated[i * LANES + lane] = chains.constants[run, i]


@merged
def close(chains, series, k):
    """Fill the ghosts of order k with what the ends see."""
    m, to_last = series.memory, (series.blocks - 1) * BLOCK
    for component in range(series.components):
        for part in range(X, Y + 1, Y - X):
            first = start_of(series, component, 0) + k * STEP + part
            ghosts = ghosts_of(series, component) + part
            left = right = fill(0.0)
            if chains.end == FREE:
                left, right = load(m, first), load(m, first + to_last)
            elif chains.end == PERIODIC:
                left, right = load(m, first + to_last), load(m, first)
            store(m, ghosts + LEFT, left)
            store(m, ghosts + RIGHT, right)


@merged
def left_block(left, here):
    return left


@merged
def right_block(here, right):
    return right


next_order = build(left_block, right_block)


@kernel
def continue_batch(chains, series):
    """Write the coefficients of all orders from those of order 0."""
    c = chains.seated
    epsilon, gamma, omega = load(c, 0), load(c, LANES), load(c, 2 * LANES)
    chain = Chain(epsilon, gamma, omega, chains.end, chains.end)
    close(chains, series, 0)
    for k in range(ORDER):
        next_order(chain, series, k, 0, series.blocks)
        close(chains, series, k + 1)
