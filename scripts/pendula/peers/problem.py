"""What every peer is given, and the pieces that several of them share."""

from collections.abc import Callable
from time import perf_counter
from typing import NamedTuple

import numpy as np

from pendula.compiled import kernel
from pendula.models.amplitudes import Chain, rates
from pendula.simulation.lattice import Reduction, choose_ends, pack, unpack

HALF = Reduction(even=True, synchronised=False)

Solve = Callable[[float], tuple[np.ndarray, float]]
"""From a relative tolerance to the final amplitudes (2, N) and the seconds of the integration."""


class Problem(NamedTuple):
    """One initial-value problem of equations (4), from tau = 0."""

    constants: tuple[float, float, float]  # epsilon, gamma, omega
    boundary: str
    amplitudes: np.ndarray  # (component, site), complex
    end_time: float


class Peer(NamedTuple):
    """Someone else's integrator: `why_absent` says in words what it lacks, None when nothing."""

    title: str
    why_absent: Callable[[], str | None]
    prepare: Callable[[Problem], Solve]


def check(problem: Problem, even: bool = False) -> None:
    """Raise ValueError at what peers do not cover; `even` ones integrate half a chain."""
    if problem.boundary != "dirichlet":
        raise ValueError(f"peers know only the boundary dirichlet, not {problem.boundary}")
    if even and not np.array_equal(problem.amplitudes, problem.amplitudes[:, ::-1]):
        raise ValueError("half a chain needs data that are even in n")


def timed(run: Callable) -> tuple[object, float]:
    """Return what `run()` returns, and the seconds that it took."""
    start = perf_counter()
    result = run()
    return result, perf_counter() - start


def chain_of(problem: Problem, reduction: Reduction) -> Chain:
    """Return the problem's parameters and ends for the library's kernels."""
    ends = choose_ends(problem.boundary, reduction)
    return Chain(*map(float, problem.constants), *ends)


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
