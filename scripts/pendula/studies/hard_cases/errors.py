"""Errors of a solver where it is most likely to fail; each function takes a solver and returns one.

Errors are against exact solutions and conserved quantities first, then against other runs: another
solver, a symmetry, a shorter chain. Errors of amplitudes are those of the largest component,
relative to the largest.
"""

import numpy as np
from latticode.measures.difference import state_error
from latticode.numerics.draws import complex_normal
from latticode.numerics.elementary import modulus, product, square_modulus, turn
from latticode.simulation.problem import on_sites, place
from latticode.simulation.simulate import Trajectory, simulate

from pendula.models.linear_chain import flow, gamma_0
from pendula.problem import Problem

FINE = {
    "taylor": {"name": "taylor", "rtol": 1e-15, "atol": 1e-15},
    "dop853": {"name": "dop853", "rtol": 1e-14, "atol": 1e-14},
}
OUTPUTS = 5


def random_data(sites: int, size: float) -> np.ndarray:
    """Return complex Gaussian amplitudes (2, N), each of order `size`, the same every time."""
    return size * complex_normal(np.random.default_rng(sites), (2, sites))


def run(
    solver: dict, data: np.ndarray, tau: float, outputs=OUTPUTS, epsilon=1.0, gamma=1.0, omega=0.0
) -> Trajectory:
    """Integrate `data` (2, N) to `tau`, ends at rest, with the constants of Fig 4 unless given."""
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


def miss_of_linear_flow(solver, omega, gamma, size, sites=21, tau=10.0) -> float:
    """Compare tiny data with the exact flow of the linear terms."""
    data = random_data(sites, size)
    exact = flow(data, tau, 1.0, gamma, omega, "dirichlet")
    return state_error(run(solver, data, tau, gamma=gamma, omega=omega).final, exact)


def miss_near_threshold(solver, omega, factor, size, sites=21, tau=40.0) -> float:
    """Do the same with gamma a little off the threshold (12)."""
    gamma = factor * float(gamma_0(omega, 1.0))
    return miss_of_linear_flow(solver, omega, gamma, size, sites, tau)


def miss_of_rotation(solver, size, omega=-4.0, sites=5, turns=1.0) -> float:
    """Compare uncoupled, undriven pairs with A exp(-i (Omega + |A|^2 / 2) tau).

    `turns` is the time in units in which the largest data turn by about a radian.
    """
    data, tau = random_data(sites, size), turns / (1.0 + size * size)
    exact = product(data, turn(-tau * (omega + 0.5 * square_modulus(data))))
    found = run(solver, data, tau, epsilon=0.0, gamma=0.0, omega=omega).final
    return state_error(found, exact)


def drift_of_norms(solver, size, omega=-4.0, sites=21, tau=5.0) -> float:
    """Return the largest change of an l2 norm at gamma = 0, relative to it."""
    l2 = run(solver, random_data(sites, size), tau, gamma=0.0, omega=omega).l2
    return float(np.abs(l2 / l2[:, :1] - 1.0).max())


def drift_of_energy(solver, tau, omega=-4.0, half_width=1, outputs=1000) -> float:
    """Return the largest change of the energy of the paper's small data, relative to it."""
    data = place(on_sites({0: (1.0, 0.1)}), half_width)
    energy = run(solver, data, tau, outputs, omega=omega).energy
    return float(np.abs(energy / energy[0] - 1.0).max())


def motion_of_rest(solver, tau) -> float:
    """Return the largest amplitude that grows out of none."""
    return float(modulus(run(solver, np.zeros((2, 5), complex), tau).final).max())


def miss_of_other(solver, sites, omega=-4.0, tau=5.0, size=0.3) -> float:
    """Compare with another solver at tighter tolerances."""
    data = random_data(sites, size)
    found, exact = (run(one, data, tau, omega=omega).final for one in (solver, fine(solver)))
    return state_error(found, exact)


def miss_of_scaled(solver, power, tau=2.0, sites=5) -> float:
    """Compare s A(s^2 tau) with A, s = 2^power, where all constants are s^2 times as large."""
    s, data = 2.0**power, random_data(sites, 1.0)
    square = s * s
    exact = run(fine(solver), data, tau, omega=-4.0).final
    scaled = {"epsilon": square, "gamma": square, "omega": -4.0 * square}
    return state_error(run(solver, s * data, tau / square, **scaled).final / s, exact)


def miss_of_single_pairs(solver, sites=5, tau=5.0) -> float:
    """Compare a chain without coupling with its pairs, each a chain of its own."""
    data, uncoupled = random_data(sites, 1.0), {"epsilon": 0.0, "omega": -1.0}
    pairs = [run(fine(solver), data[:, [n]], tau, **uncoupled).final for n in range(sites)]
    return state_error(run(solver, data, tau, **uncoupled).final, np.concatenate(pairs, axis=1))


def miss_of_short_chain(solver, half_width, tau=1.0, short=30) -> float:
    """Compare the middle of a long chain with a chain whose ends the front has not reached."""
    start = on_sites({0: (1.0, 0.1)})
    exact = run(fine(solver), place(start, short), tau, outputs=1).final
    found = run(solver, place(start, half_width), tau, outputs=1).final
    return state_error(found[:, half_width - short : half_width + short + 1], exact)


def run_anyway(solver, amplitude=1.0, tau=1.0, omega=-4.0) -> float:
    """Start a run that has to be refused; zero would mean that it ended."""
    data = random_data(5, 1.0)
    data[1, 2] = amplitude
    run(solver, data, tau, omega=omega)
    return 0.0
