"""Errors against exact solutions and conserved quantities; each takes a solver and returns one.

Errors of amplitudes are those of the largest component, relative to the largest.
"""

import numpy as np

from pendula.measures.difference import state_error
from pendula.models.linear_flow import flow
from pendula.problem import Constants, Problem, on_sites, place
from pendula.simulation.simulate import Trajectory, simulate
from pendula.studies.theory.linear_stability import gamma_0

OUTPUTS = 5


def random_data(sites: int, size: float) -> np.ndarray:
    """Return complex Gaussian amplitudes (2, N), each of order `size`, the same every time."""
    rng = np.random.default_rng(sites)
    return size * (rng.normal(size=(2, sites)) + 1j * rng.normal(size=(2, sites)))


def run(constants, data: np.ndarray, tau: float, solver: dict, outputs=OUTPUTS) -> Trajectory:
    """Integrate `data` (2, N) under (epsilon, gamma, omega) up to `tau`, between ends at rest."""
    problem = Problem(
        constants=Constants(**dict(zip(("epsilon", "gamma", "omega"), constants, strict=True))),
        half_width=data.shape[1] // 2,
        boundary="dirichlet",
        initial=data,
        end_time=tau,
        output_step=tau / outputs,
        solver=solver,
    )
    return simulate(problem)


def miss_of_linear_flow(solver, omega, gamma, size, sites=21, tau=10.0) -> float:
    """Compare tiny data with the exact flow of the linear terms."""
    data, constants = random_data(sites, size), (1.0, gamma, omega)
    exact = flow(data, tau, *constants, "dirichlet")
    return state_error(run(constants, data, tau, solver).final, exact)


def miss_near_threshold(solver, omega, factor, size, sites=21, tau=40.0) -> float:
    """Do the same with gamma a little off the threshold (12)."""
    gamma = factor * float(gamma_0(omega, 1.0))
    return miss_of_linear_flow(solver, omega, gamma, size, sites, tau)


def miss_of_rotation(solver, size, omega=-4.0, sites=5, turns=1.0) -> float:
    """Compare uncoupled, undriven pairs with A exp(-i (Omega + |A|^2 / 2) tau).

    `turns` is the time in units in which the largest data turn by about a radian.
    """
    data = random_data(sites, size)
    tau = turns / (1.0 + size**2)
    exact = data * np.exp(-1j * tau * (omega + 0.5 * np.abs(data) ** 2))
    return state_error(run((0.0, 0.0, omega), data, tau, solver).final, exact)


def drift_of_norms(solver, size, omega=-4.0, sites=21, tau=5.0) -> float:
    """Return the largest change of an l2 norm at gamma = 0, relative to it."""
    l2 = run((1.0, 0.0, omega), random_data(sites, size), tau, solver).l2
    return float(np.abs(l2 / l2[:, :1] - 1.0).max())


def drift_of_energy(solver, tau, omega=-4.0, half_width=1, outputs=1000) -> float:
    """Return the largest change of the energy of the paper's small data, relative to it."""
    data = place(on_sites({0: (1.0, 0.1)}), half_width)
    energy = run((1.0, 1.0, omega), data, tau, solver, outputs).energy
    return float(np.abs(energy / energy[0] - 1.0).max())


def motion_of_rest(solver, tau) -> float:
    """Return the largest amplitude that grows out of none."""
    return float(np.abs(run((1.0, 1.0, 0.0), np.zeros((2, 5), complex), tau, solver).final).max())
