"""Errors of a solver in the runs where it is most likely to fail, one function each.

An error is measured against an exact solution or a conserved quantity if there is one, otherwise
against another solver, another scale or a shorter chain. The error of amplitudes is the largest
difference of a component, divided by the largest component.
"""

import numpy as np
from latticode.equations.initial_values import on_sites, place
from latticode.measures.difference import state_error
from latticode.numerics.draws import complex_normal
from latticode.simulation.simulate import Trajectory, simulate

from pendula.models.linear_chain import flow
from pendula.problem import PaperProblem

REFERENCE_SOLVERS = {
    "taylor": {"name": "taylor", "rtol": 1e-15, "atol": 1e-15},
    "dop853": {"name": "dop853", "rtol": 1e-14, "atol": 1e-14},
}
REFERENCE_RUN = "taylor at 1e-15 (for taylor: dop853 at 1e-14)"
REFERENCES = {
    "miss_of_linear_flow": "exact flow of the linear terms",
    "drift_of_energy": "the energy at the start",
    "miss_of_other": REFERENCE_RUN,
    "miss_of_scaled": f"unscaled, {REFERENCE_RUN}",
    "miss_of_short_chain": f"the same data on 61 sites, {REFERENCE_RUN}",
    "run_anyway": "-",
}
"""What the error of each function below is measured against."""


def random_data(sites: int, size: float) -> np.ndarray:
    """Return complex Gaussian amplitudes (2, N) of order `size`; N is also the seed."""
    return size * complex_normal(np.random.default_rng(sites), (2, sites))


def integrate(
    solver: dict,
    data: np.ndarray,
    tau: float,
    outputs: int = 5,
    epsilon: float = 1.0,
    gamma: float = 1.0,
    omega: float = -4.0,
) -> Trajectory:
    """Return the trajectory from `data` (2, N) to `tau`, by default with the constants of Fig 3."""
    problem = PaperProblem(
        parameters={"epsilon": epsilon, "gamma": gamma, "omega": omega},
        half_width=data.shape[1] // 2,
        boundary="dirichlet",
        initial=data,
        end_time=tau,
        output_step=tau / outputs,
        solver=solver,
    )
    return simulate(problem)


def reference_solver(solver: dict) -> dict:
    """Return the solver to compare with: taylor at 1e-15, or dop853 at 1e-14 for taylor."""
    return REFERENCE_SOLVERS["dop853" if solver["name"] == "taylor" else "taylor"]


def miss_of_linear_flow(
    solver: dict, omega: float, gamma: float, size: float, tau: float = 10.0
) -> float:
    """Return the error against the exact linear flow, from tiny random data on 21 sites."""
    data = random_data(21, size)
    exact = flow(data, tau, 1.0, gamma, omega, "dirichlet")
    return state_error(integrate(solver, data, tau, gamma=gamma, omega=omega).final, exact)


def drift_of_energy(solver: dict, tau: float) -> float:
    """Return max |H / H(0) - 1| from the data of the small cases on three sites."""
    energy = integrate(solver, place(on_sites({0: (1.0, 0.1)}), 1), tau, outputs=1000).conserved[
        "energy"
    ]
    return float(np.abs(energy / energy[0] - 1.0).max())


def miss_of_other(solver: dict, sites: int) -> float:
    """Return the error against `reference_solver`, from random data."""
    data = random_data(sites, 0.3)
    final, exact = (
        integrate(chosen, data, 5.0).final for chosen in (solver, reference_solver(solver))
    )
    return state_error(final, exact)


def miss_of_scaled(solver: dict, power: int) -> float:
    """Return the error of the run scaled by s = 2^power against the unscaled one.

    If A(tau) solves (4), then s A(s^2 tau) solves it with all constants times s^2.
    """
    s, data, tau = 2.0**power, random_data(5, 1.0), 2.0
    square = s * s
    exact = integrate(reference_solver(solver), data, tau).final
    scaled = {"epsilon": square, "gamma": square, "omega": -4.0 * square}
    return state_error(integrate(solver, s * data, tau / square, **scaled).final / s, exact)


def miss_of_short_chain(solver: dict, half_width: int) -> float:
    """Return the error on a long chain against 61 sites, before any motion reaches an end."""
    start, short = on_sites({0: (1.0, 0.1)}), 30
    exact = integrate(reference_solver(solver), place(start, short), 1.0, outputs=1).final
    final = integrate(solver, place(start, half_width), 1.0, outputs=1).final
    return state_error(final[:, half_width - short : half_width + short + 1], exact)


def run_anyway(
    solver: dict, amplitude: float = 1.0, tau: float = 1.0, omega: float = -4.0
) -> float:
    """Start a run that must be rejected. If it finishes instead, return 0.0."""
    data = random_data(5, 1.0)
    data[1, 2] = amplitude
    integrate(solver, data, tau, omega=omega)
    return 0.0
