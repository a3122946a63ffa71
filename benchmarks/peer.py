"""What a peer (an integrator by other people) is given, and the pieces that several share."""

from collections.abc import Callable
from typing import NamedTuple

import numpy as np
from pendula.compiled import kernel
from pendula.models.amplitudes import Chain, rates
from pendula.problem import Problem
from pendula.simulation.lattice import Reduction, find_reduction, pack, unpack
from pendula.simulation.models import make_chain

HALF = Reduction(even=True, synchronised=False)

Solve = Callable[[float], tuple[np.ndarray, float]]
"""From a tolerance (or a step) to the final amplitudes (2, N) and the seconds of the run."""


class Peer(NamedTuple):
    """Someone else's integrator: `why_absent` says in words what it lacks, None when nothing."""

    title: str
    why_absent: Callable[[], str | None]
    prepare: Callable[[Problem], Solve]


def check(problem: Problem, reduction: Reduction | None = None) -> None:
    """Raise ValueError at what peers do not cover; some integrate half of a chain."""
    if problem.boundary != "dirichlet":
        raise ValueError(f"peers know only the boundary dirichlet, not {problem.boundary}")
    if reduction == HALF and not find_reduction(problem.amplitudes).even:
        raise ValueError("half a chain needs data that are even in n")


def chain_of(problem: Problem, reduction: Reduction) -> Chain:
    """Return the problem's constants and ends for the library's kernels."""
    return make_chain(problem.constants, problem.boundary, reduction)


def flat_state(problem: Problem, reduction: Reduction) -> np.ndarray:
    """Return the initial state of the library's kernels, ghosts and all, as a vector."""
    return pack(problem.amplitudes, reduction).ravel()


def amplitudes_of(flat: np.ndarray, reduction: Reduction) -> np.ndarray:
    """Return the amplitudes (2, N) of such a vector."""
    return unpack(flat.reshape(4, -1), reduction)


@kernel
def flat_rates(chain, flat, slope):
    """Write the right-hand side of a vector with ghosts, which stand still."""
    y, dy = flat.reshape(4, -1), slope.reshape(4, -1)
    rates(chain, y, dy)
    for row in range(4):
        dy[row, 0] = dy[row, dy.shape[1] - 1] = 0.0
