"""Runs of the pendula, and their equations (1) in plain NumPy."""

import numpy as np
from latticode.simulation.simulate import simulate
from pendula.problem import PaperProblem

TIGHT = {
    "taylor": {"name": "taylor", "rtol": 1e-15, "atol": 1e-15},
    "dop853": {"name": "dop853", "rtol": 1e-14, "atol": 1e-14},
    "ode45": {"name": "ode45", "rtol": 1e-12, "atol": 1e-12},
}


def pendula(**changes) -> PaperProblem:
    """Return a problem of five pairs; `changes` are plain values."""
    settings = {
        "epsilon": 1.0,
        "gamma": 1.0,
        "omega": -4.0,
        "half_width": 2,
        "boundary": "dirichlet",
        "initial": {0: (1.0 + 0.5j, 0.1), 1: (0.3, -0.2j)},
        "end_time": 1.0,
        "output_step": 0.125,
        "model": "pendula",
        "mu": 0.1,
        "solver": TIGHT["taylor"],
    }
    return PaperProblem.of(settings | changes)


def final(problem: PaperProblem, solver="taylor", **changes):
    """Return angles and velocities (part, component, site) at the end.

    The solver is one of TIGHT, or None for the solver of the problem.
    """
    changes |= {} if solver is None else {"solver": TIGHT[solver]}
    return simulate(problem.changed(**changes)).final


def coupling(problem: PaperProblem, angles):
    """Return C (x_{n+1} - 2 x_n + x_{n-1}) of angles (2, N)."""
    pad = {"dirichlet": "constant", "free": "edge", "periodic": "wrap"}[problem.boundary]
    wide = np.pad(angles, ((0, 0), (1, 1)), mode=pad)
    square = problem.mu * problem.mu
    return problem.constants.epsilon * square * (wide[:, 2:] - 2 * angles + wide[:, :-2])


def slope(problem: PaperProblem):
    """Return f in y' = f(t, y), where y is a flat state (2, 2, N) of angles and velocities."""
    numbers, square = problem.constants, problem.mu * problem.mu
    omega = np.sqrt(1 + square * numbers.omega)

    def f(t, flat):
        x, v = flat.reshape(2, 2, -1)
        drive = 2 * numbers.gamma * square * np.cos(2 * omega * t)
        return np.array([v, coupling(problem, x) + drive * (x[::-1] - x) - np.sin(x)]).ravel()

    return f


def start(problem: PaperProblem):
    """Return the angles and velocities (2, 2, N) at t = 0."""
    omega = np.sqrt(1 + problem.mu**2 * problem.constants.omega)
    z = 2 * problem.mu * problem.amplitudes
    return np.array([z.real, -omega * z.imag])


def undriven_energy(problem: PaperProblem, angles, velocities) -> float:
    """Return the energy that (1) conserves if x = y or gamma = 0; both states are (2, N)."""
    of_single_pendula = 0.5 * velocities**2 + 2.0 * np.sin(0.5 * angles) ** 2
    return float((of_single_pendula - 0.5 * angles * coupling(problem, angles)).sum())
