"""The interface of peers, which are integrators by others, and functions that peers share."""

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
"""A function from a tolerance (or a step) to the final state of the chain and the time in s."""


class Peer(NamedTuple):
    """An integrator by others; `why_absent` returns why it cannot run here, or None."""

    title: str
    why_absent: Callable[[], str | None]
    prepare: Callable[[PaperProblem], Solve]


def needs(module: str, package: str) -> Callable[[], str | None]:
    """Return a function `why_absent` for a peer that imports this Python module."""
    missing = f"the Python package {package} is not installed"
    return lambda: None if find_spec(module) else missing


def begin(
    problem: PaperProblem, reduction: Reduction = FULL_CHAIN
) -> tuple[Any, np.ndarray, float]:
    """Return the system, the initial state with ghosts and the end time, for the library's kernels.

    Raises ValueError for problems that peers do not support.
    """
    if problem.boundary != "dirichlet":
        raise ValueError(f"peers support only the boundary dirichlet, not {problem.boundary}")
    if reduction == HALF and not find_reduction(problem.amplitudes).even:
        raise ValueError("integrating half of a chain requires initial data that are even in n")
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
    """Return the state of four rows with the sites `inner`, and with ghosts at rest."""
    return np.pad(inner.reshape(4, -1), ((0, 0), (1, 1)))


@kernel
def hold_ghosts(dy: np.ndarray) -> None:
    """Set the rates of the ghosts to zero."""
    for row in range(4):
        dy[row, 0] = dy[row, dy.shape[1] - 1] = 0.0


@kernel
def flat_rates(chain: Any, t: float, flat: np.ndarray, slope: np.ndarray) -> None:
    """Write the rates of a flat state with ghosts to `slope`."""
    y, dy = flat.reshape(4, -1), slope.reshape(4, -1)
    rates(chain, y, dy)
    hold_ghosts(dy)


@kernel
def flat_rates_of_pendula(pendula: Any, t: float, flat: np.ndarray, slope: np.ndarray) -> None:
    y, dy = flat.reshape(4, -1), slope.reshape(4, -1)
    pendula_rates(at_time(pendula, t), y, dy)
    hold_ghosts(dy)


FLAT_RATES = {AMPLITUDES: flat_rates, PENDULA: flat_rates_of_pendula}
