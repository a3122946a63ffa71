"""The error of the expansion (3) against Newton's equations, at several mu.

The pendula start from x = 2 mu Re A and dx/dt = -2 mu omega Im A with the amplitudes A of the case.
The error is the largest |x - x of (3)| over both pendula, all sites and all outputs. The output
step is no multiple of the period.

# ASSUME: the paper does not give the initial velocities of its expansion. Ours omit the slow rate
# of the amplitudes, which changes the constant of the error but not its order.
"""

from collections.abc import Mapping, Sequence

import numpy as np
from latticode.datasets.netcdf import Variable
from latticode.datasets.trajectories import Contents
from latticode.simulation.simulate import Trajectory, simulate
from replication.variables import FEW_CHOICES, REGULAR, SCATTERED

from pendula.models.pendula import leading_angles
from pendula.problem import PENDULA, PaperProblem

SLOW_TIMES = {"mu^2 t / 2": 1, "mu^2 t": 2}
"""Outputs of the amplitudes per output of the pendula. The slow time mu^2 t is a wrong control."""


def integrate_amplitudes(problem: PaperProblem) -> np.ndarray:
    """Return the solution of (4) at the outputs of a problem, complex (time, component, site).

    A run stores only moduli, so each output interval is a run from the last state.
    """
    amplitudes, output_interval = (
        [problem.amplitudes],
        problem.changed(end_time=problem.output_step),
    )
    for _ in problem.times[1:]:
        amplitudes.append(simulate(output_interval.changed(initial=amplitudes[-1])).final)
    return np.array(amplitudes)


def largest_error(pendula: Trajectory, problem: PaperProblem, amplitudes: np.ndarray) -> float:
    """Return the largest error of the angles 2 mu Re(A e^{i omega t}) at the outputs of A."""
    angles = np.moveaxis(pendula.state[0], -1, 0)
    omega, mu = problem.constants.omega, problem.mu
    return max(
        np.abs(angles[i] - leading_angles(amplitude, omega, mu, pendula.tau[i])).max()
        for i, amplitude in enumerate(amplitudes)
    )


def measure_errors(problem: PaperProblem, mus: Sequence[float]) -> np.ndarray:
    """Return the errors (slow time, mu) of a case up to its end time.

    The slow time mu^2 t reaches the end time at half of t, so it has half as many outputs.
    """
    amplitudes, errors = integrate_amplitudes(problem), []
    for mu in mus:
        pendula = problem.changed(model=PENDULA, mu=mu, snapshot_every=1)
        run = simulate(pendula)
        errors.append(
            [largest_error(run, pendula, amplitudes[::every]) for every in SLOW_TIMES.values()]
        )
    return np.array(errors).T


def measure_remainder(problems: Mapping[str, PaperProblem], mus: Sequence[float]) -> Contents:
    """Return the dataset of the errors (case, slow time, mu), in rad."""
    variables = {
        "slow_time": Variable(("slow_time",), list(SLOW_TIMES), "slow time of the amplitudes"),
        "case": Variable(("case",), list(problems)),
        "mu": Variable(("mu",), list(mus), attributes=FEW_CHOICES),
        "error": Variable(
            ("case", "slow_time", "mu"),
            np.array([measure_errors(problem, mus) for problem in problems.values()]),
            "error of an angle, the largest",
            "rad",
            SCATTERED,
        ),
    }
    return variables, {"title": "Errors of the expansion (3) against Newton's equations", **REGULAR}
