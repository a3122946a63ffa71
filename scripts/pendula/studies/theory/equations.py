"""Short runs of (4) for the checks, and their initial data."""

from collections.abc import Mapping, Sequence

import numpy as np
from latticode.measures.norms import power_of
from latticode.numerics.draws import complex_normal
from latticode.simulation.lattice import FULL_CHAIN
from latticode.simulation.simulate import Trajectory, simulate

from pendula.models.amplitudes import energies
from pendula.models.integrations import make_chain
from pendula.problem import Constants, PaperProblem

ENDS, PAIR = "dirichlet", (1.0, 0.1)
"""The ends of the paper's chains, and (A_0, B_0) in its small cases."""


def constants_at(omega: float, gamma: float = 1.0) -> Constants:
    """Return the paper's constants at this detuning, with another drive if `gamma` is given."""
    return Constants(epsilon=1.0, gamma=float(gamma), omega=float(omega))


def run(
    constants: Constants,
    boundary: str,
    amplitudes: np.ndarray,
    end_time: float,
    outputs: int = 1,
    *,
    solver: Mapping,
) -> Trajectory:
    """Return the trajectory from amplitudes (2, N), integrated on the full chain, not on its half.

    It has the initial state and `outputs` later ones, in equal steps up to `end_time`.
    """
    problem = PaperProblem(
        parameters=vars(constants),
        half_width=amplitudes.shape[1] // 2,
        boundary=boundary,
        initial=amplitudes,
        end_time=end_time,
        output_step=end_time / outputs,
        solver=solver,
    )
    return simulate(problem, FULL_CHAIN)


def controls_of(solver: dict) -> dict:
    """Return a solver and its controls as attributes of a dataset."""
    return {"solver" if key == "name" else f"solver_{key}": value for key, value in solver.items()}


def total_energy(constants: Constants, boundary: str, amplitudes: np.ndarray) -> np.ndarray:
    """Return H of (8) for `amplitudes` (..., 2, N), computed by the solvers' kernel."""
    chains = amplitudes.reshape(-1, *amplitudes.shape[-2:])
    states = np.zeros((len(chains), 4, chains.shape[2] + 2))
    states[:, 0::2, 1:-1], states[:, 1::2, 1:-1] = chains.real, chains.imag
    totals, scratch = np.empty(len(states)), np.empty((2, states.shape[2]))
    energies(make_chain(constants, boundary, FULL_CHAIN), states, scratch, totals)
    return totals.reshape(amplitudes.shape[:-2])[()]


def squared_norm(l2: np.ndarray) -> np.ndarray:
    """Return P = |A|^2 + |B|^2 in l2 from the norms of A and B along the first axis."""
    return l2[0] ** 2 + l2[1] ** 2


def random_amplitudes(seed: int, sites: int) -> np.ndarray:
    """Return complex Gaussian amplitudes (2, N) with P = 1."""
    drawn = complex_normal(np.random.default_rng(seed), (2, sites))
    return 1.0 / np.sqrt(power_of(drawn)) * drawn


def one_pair(sites: int, pair: Sequence[complex]) -> np.ndarray:
    """Return amplitudes (2, N) with one excited pair in the middle and all others at rest."""
    amplitudes = np.zeros((2, sites), complex)
    amplitudes[:, sites // 2] = pair
    return amplitudes


def alternating(sites: int, x: float) -> np.ndarray:
    """Return amplitudes (2, N) with A_n = -B_n = (-1)^n x, counting n from the left end."""
    wave = x * (1.0 - 2.0 * (np.arange(sites) % 2))
    return np.stack([wave, -wave]).astype(complex)
