"""Errors of a solver where it is most likely to fail; each function takes a solver and returns one.

Errors are against exact solutions and conserved quantities first, then against other runs: another
solver, another scale, a shorter chain. Errors of amplitudes are those of the largest component,
relative to the largest.
"""

import numpy as np
from latticode.measures.difference import state_error
from latticode.numerics.draws import complex_normal
from latticode.simulation.problem import on_sites, place
from latticode.simulation.simulate import Trajectory, simulate

from pendula.models.linear_chain import flow
from pendula.problem import Problem

FINE = {
    "taylor": {"name": "taylor", "rtol": 1e-15, "atol": 1e-15},
    "dop853": {"name": "dop853", "rtol": 1e-14, "atol": 1e-14},
}
FINER = "taylor at 1e-15 (for taylor: dop853 at 1e-14)"
AGAINST = {
    "miss_of_linear_flow": "exact flow of the linear terms",
    "drift_of_energy": "the energy at the start",
    "miss_of_other": FINER,
    "miss_of_scaled": f"unscaled, {FINER}",
    "miss_of_short_chain": f"the same data on 61 sites, {FINER}",
    "run_anyway": "-",
}
"""The functions below by name, with what their errors are against."""


def random_data(sites: int, size: float) -> np.ndarray:
    """Return complex Gaussian amplitudes (2, N), each of order `size`, the same every time."""
    return size * complex_normal(np.random.default_rng(sites), (2, sites))


def run(
    solver: dict, data: np.ndarray, tau: float, outputs=5, epsilon=1.0, gamma=1.0, omega=-4.0
) -> Trajectory:
    """Integrate `data` (2, N) to `tau`, ends at rest, with the constants of Fig 3 unless given."""
    problem = Problem(
        parameters={"epsilon": epsilon, "gamma": gamma, "omega": omega},
        half_width=data.shape[1] // 2,
        boundary="dirichlet",
        initial=data,
        end_time=tau,
        output_step=tau / outputs,
        solver=solver,
    )
    return simulate(problem)


def fine(solver: dict) -> dict:
    """Return the finest solver of another kind: taylor, or for taylor itself dop853."""
    return FINE["dop853" if solver["name"] == "taylor" else "taylor"]


def miss_of_linear_flow(solver, omega, gamma, size, tau=10.0) -> float:
    """Compare tiny data on 21 sites with the exact flow of the linear terms."""
    data = random_data(21, size)
    exact = flow(data, tau, 1.0, gamma, omega, "dirichlet")
    return state_error(run(solver, data, tau, gamma=gamma, omega=omega).final, exact)


def drift_of_energy(solver, tau) -> float:
    """Return the largest change of the energy of small data on three sites, relative to it."""
    energy = run(solver, place(on_sites({0: (1.0, 0.1)}), 1), tau, outputs=1000).energy
    return float(np.abs(energy / energy[0] - 1.0).max())


def miss_of_other(solver, sites) -> float:
    """Compare with another solver at tighter tolerances."""
    data = random_data(sites, 0.3)
    found, exact = (run(one, data, 5.0).final for one in (solver, fine(solver)))
    return state_error(found, exact)


def miss_of_scaled(solver, power) -> float:
    """Compare s A(s^2 tau) with A, s = 2^power, where all constants are s^2 times as large."""
    s, data, tau = 2.0**power, random_data(5, 1.0), 2.0
    square = s * s
    exact = run(fine(solver), data, tau).final
    scaled = {"epsilon": square, "gamma": square, "omega": -4.0 * square}
    return state_error(run(solver, s * data, tau / square, **scaled).final / s, exact)


def miss_of_short_chain(solver, half_width) -> float:
    """Compare the middle of a long chain with a chain whose ends the front has not reached."""
    start, short = on_sites({0: (1.0, 0.1)}), 30
    exact = run(fine(solver), place(start, short), 1.0, outputs=1).final
    found = run(solver, place(start, half_width), 1.0, outputs=1).final
    return state_error(found[:, half_width - short : half_width + short + 1], exact)


def run_anyway(solver, amplitude=1.0, tau=1.0, omega=-4.0) -> float:
    """Start a run that has to be refused; zero would mean that it ended."""
    data = random_data(5, 1.0)
    data[1, 2] = amplitude
    run(solver, data, tau, omega=omega)
    return 0.0
