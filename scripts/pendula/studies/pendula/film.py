"""The pendula themselves, to look at: the angle of each, several times in each period."""

from collections.abc import Mapping

import numpy as np

from pendula.datasets.netcdf import Variable
from pendula.datasets.trajectories import Contents, describe_cases
from pendula.models.pendula import frequency
from pendula.problem import Problem
from pendula.simulation.simulate import simulate

from .followed import period_of

HALF_TURN = 127
"""Half a turn in steps of the film: no picture shows smaller ones, and a step fits into a byte."""


def filmed(problem: Problem, reach: int, periods: int, per_period: int) -> np.ndarray:
    """Return the angles on the sites -reach..reach in steps, (picture, component, site).

    Whole turns are left out, since no picture shows them.
    """
    period = period_of(problem)
    length = {"end_time": periods * period, "output_step": period / per_period}
    angles = simulate(problem.changed(snapshot_every=1, **length)).snapshots[0]
    centre = angles.shape[1] // 2
    angles = angles[:, centre - reach : centre + reach + 1]
    angles = angles - 2.0 * np.pi * np.rint(angles / (2.0 * np.pi))
    return np.rint(angles * (HALF_TURN / np.pi)).astype(np.int8).transpose(2, 0, 1)


def film_pendula(
    problems: Mapping[str, Problem], reach: int, periods: int, per_period: int
) -> Contents:
    """Return films of the middle of chains of pendula, each over as many of its own periods."""
    reach = min(reach, *(one.half_width for one in problems.values()))
    angles = np.array([filmed(one, reach, periods, per_period) for one in problems.values()])
    described, shared = describe_cases(problems)
    lengths = [period_of(one) for one in problems.values()]
    own = [frequency(one.constants.omega, one.mu) for one in problems.values()]
    mu = next(iter(problems.values())).mu
    about = {"title": "A film of the pendula", "mu": mu}
    about |= {"per_period": per_period, "half_turn": HALF_TURN}
    return {
        **described,
        "site": Variable(("site",), np.arange(-reach, reach + 1)),
        "component": Variable(("component",), ["x", "y"]),
        "period": Variable(("picture",), np.arange(angles.shape[1]) / per_period,
                           "number of periods 2 pi / omega since the start"),
        "tau_of_period": Variable(("case",), lengths, "slow time in a period 2 pi / omega"),
        "pendulum_frequency": Variable(("case",), own, "angular frequency omega of equation (2)"),
        "angle_step": Variable(("case", "picture", "component", "site"), angles,
                               f"angle in steps; half a turn has {HALF_TURN} steps"),
    }, {**shared, **about}  # fmt: skip
