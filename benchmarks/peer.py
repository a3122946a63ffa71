"""What a peer (an integrator by other people) is given, and the pieces that several share."""

from collections.abc import Callable
from importlib.util import find_spec
from typing import Any, NamedTuple

import numpy as np
from latticode.kernels.compiled import kernel
from latticode.simulation.lattice import FULL_CHAIN, Reduction, find_reduction, unfold, unpack
from pendula.models.amplitudes import rates
from pendula.models.pendula import at_time
from pendula.models.pendula import rates as pendula_rates
from pendula.problem import AMPLITUDES, PENDULA, PaperProblem

HALF = Reduction(even=True, synchronised=False)

Solve = Callable[[float], tuple[np.ndarray, float]]
"""From a tolerance (or a step) to the final state of the chain and the seconds of the run."""


class Peer(NamedTuple):
    """Someone else's integrator: `why_absent` says in words what it lacks, None when nothing."""

    title: str
    why_absent: Callable[[], str | None]
    prepare: Callable[[PaperProblem], Solve]


def needs(module: str, package: str) -> Callable[[], str | None]:
    """Return a function that says what is missing where a Python module cannot be imported."""
    missing = f"the Python package {package} is not installed"
    return lambda: None if find_spec(module) else missing


def begin(
    problem: PaperProblem, reduction: Reduction = FULL_CHAIN
) -> tuple[Any, np.ndarray, float]:
    """Return system, initial state with ghosts and end time, as the library's kernels take them.

    Raises ValueError at what peers do not cover; some integrate half of a chain.
    """
    if problem.boundary != "dirichlet":
        raise ValueError(f"peers know only the boundary dirichlet, not {problem.boundary}")
    if reduction == HALF and not find_reduction(problem.amplitudes).even:
        raise ValueError("half a chain needs data that are even in n")
    equations = problem.equations
    end = float(equations.times[-1])
    return equations.system(reduction), equations.start(reduction), end


def final_of(
    problem: PaperProblem, state: np.ndarray, reduction: Reduction = FULL_CHAIN
) -> np.ndarray:
    """Return the amplitudes (2, N) of a state, or angles and velocities (part, component, site)."""
    y = state.reshape(4, -1)
    if problem.model.name == AMPLITUDES:
        return unpack(y, reduction)
    return np.array([unfold(y[re_im::2, 1:-1], reduction) for re_im in (0, 1)])


def with_ghosts(inner: np.ndarray) -> np.ndarray:
    """Return the state of four rows whose sites are `inner`, with ghosts that stand still."""
    return np.pad(inner.reshape(4, -1), ((0, 0), (1, 1)))


@kernel
def hold_ghosts(dy):
    """Let the ghosts of a state stand still."""
    for row in range(4):
        dy[row, 0] = dy[row, dy.shape[1] - 1] = 0.0


@kernel
def flat_rates(chain, t, flat, slope):
    """Write the right-hand side of a vector with ghosts."""
    y, dy = flat.reshape(4, -1), slope.reshape(4, -1)
    rates(chain, y, dy)
    hold_ghosts(dy)


@kernel
def flat_rates_of_pendula(pendula, t, flat, slope):
    y, dy = flat.reshape(4, -1), slope.reshape(4, -1)
    pendula_rates(at_time(pendula, t), y, dy)
    hold_ghosts(dy)


FLAT_RATES = {AMPLITUDES: flat_rates, PENDULA: flat_rates_of_pendula}
