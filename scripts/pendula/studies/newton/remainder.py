"""How far the expansion (3) is from Newton's equations: its error at several mu.

The pendula start from the data that the case gives them, x = 2 mu Re A and dx/dt = -2 mu omega Im A
with the amplitudes A of the case. The error is the largest |x - x of (3)| over both pendula, all
sites and all outputs, which meet the swings at ever other phases.

# ASSUME: the paper does not say which velocities its expansion starts from. Those of the model
# leave out the slow rate of the amplitudes, which changes the constant of the error and no order.
"""

from collections.abc import Mapping, Sequence

import numpy as np
from latticode.datasets.netcdf import Variable
from latticode.datasets.trajectories import Contents
from latticode.simulation.simulate import Trajectory, simulate

from pendula.models.pendula import leading_angles
from pendula.problem import PENDULA, Problem

READINGS = {"mu^2 t / 2": 1, "mu^2 t": 2}
"""Slow times, with the outputs of the amplitudes for each of the pendula; the second is wrong."""


def amplitudes_of(problem: Problem) -> np.ndarray:
    """Return the solution of (4) at the outputs of a problem, complex (time, component, site).

    A run keeps moduli alone, so it is made in pieces: each starts from the state before.
    """
    found, piece = [problem.amplitudes], problem.changed(end_time=problem.output_step)
    for _ in problem.times[1:]:
        found.append(simulate(piece.changed(initial=found[-1])).final)
    return np.array(found)


def largest_error(pendula: Trajectory, problem: Problem, amplitudes: np.ndarray) -> float:
    """Return the largest error of the angles 2 mu Re(A e^{i omega t}), at as many outputs as A."""
    angles = np.moveaxis(pendula.state[0], -1, 0)
    omega, mu = problem.constants.omega, problem.mu
    return max(
        np.abs(angles[i] - leading_angles(one, omega, mu, pendula.tau[i])).max()
        for i, one in enumerate(amplitudes)
    )


def errors(problem: Problem, mus: Sequence[float]) -> np.ndarray:
    """Return the errors (reading, mu) of a case of the amplitudes up to its end time.

    Twice as fast a slow time needs amplitudes to twice the time, so that it is half as long.
    """
    amplitudes, found = amplitudes_of(problem), []
    for mu in mus:
        pendula = problem.changed(model=PENDULA, mu=mu, snapshot_every=1)
        run = simulate(pendula)
        found.append(
            [largest_error(run, pendula, amplitudes[::every]) for every in READINGS.values()]
        )
    return np.array(found).T


def remainder_contents(problems: Mapping[str, Problem], mus: Sequence[float]) -> Contents:
    """Return the errors of all cases at each mu, by both readings of the slow time."""
    variables = {
        "slow_time": Variable(("slow_time",), list(READINGS), "slow time of the amplitudes"),
        "case": Variable(("case",), list(problems)),
        "mu": Variable(("mu",), list(mus)),
        "error": Variable(
            ("case", "slow_time", "mu"),
            np.array([errors(problem, mus) for problem in problems.values()]),
            "error of an angle, the largest",
            "rad",
        ),
    }
    return variables, {"title": "The expansion (3) beside Newton's equations"}
