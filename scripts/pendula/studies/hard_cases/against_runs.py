"""Errors against other runs: another solver, a symmetry, a shorter chain; and runs without end."""

import numpy as np

from pendula.measures.difference import state_error
from pendula.problem import on_sites, place

from .against_exact import random_data, run

FINE = {
    "taylor": {"name": "taylor", "rtol": 1e-15, "atol": 1e-15},
    "dop853": {"name": "dop853", "rtol": 1e-14, "atol": 1e-14},
}


def other_of(solver: dict) -> dict:
    """Return the finest solver of another kind: taylor, or for taylor itself dop853."""
    return FINE["dop853" if solver["name"] == "taylor" else "taylor"]


def miss_of_other(solver, sites, omega=-4.0, tau=5.0, size=0.3) -> float:
    """Compare with another solver at tighter tolerances."""
    constants, data = (1.0, 1.0, omega), random_data(sites, size)
    exact = run(constants, data, tau, other_of(solver)).final
    return state_error(run(constants, data, tau, solver).final, exact)


def miss_of_scaled(solver, power, tau=2.0, sites=5) -> float:
    """Compare s A(s^2 tau) with A, s = 2^power, where all constants are s^2 times as large."""
    s, constants, data = 2.0**power, np.array([1.0, 1.0, -4.0]), random_data(sites, 1.0)
    exact = run(constants, data, tau, other_of(solver)).final
    found = run(tuple(s * s * constants), s * data, tau / (s * s), solver).final
    return state_error(found / s, exact)


def miss_of_single_pairs(solver, sites=5, tau=5.0) -> float:
    """Compare a chain without coupling with its pairs, each a chain of its own."""
    constants, data = (0.0, 1.0, -1.0), random_data(sites, 1.0)
    pairs = [run(constants, data[:, [n]], tau, other_of(solver)).final for n in range(sites)]
    return state_error(run(constants, data, tau, solver).final, np.concatenate(pairs, axis=1))


def miss_of_short_chain(solver, half_width, tau=1.0, short=30) -> float:
    """Compare the middle of a long chain with a chain whose ends the front has not reached."""
    start, constants = on_sites({0: (1.0, 0.1)}), (1.0, 1.0, 0.0)
    exact = run(constants, place(start, short), tau, other_of(solver), outputs=1).final
    found = run(constants, place(start, half_width), tau, solver, outputs=1).final
    return state_error(found[:, half_width - short : half_width + short + 1], exact)


def run_anyway(solver, amplitude=1.0, tau=1.0, omega=-4.0) -> float:
    """Start a run that has to be refused; zero would mean that it ended."""
    data = random_data(5, 1.0)
    data[1, 2] = amplitude
    run((1.0, 1.0, omega), data, tau, solver)
    return 0.0
