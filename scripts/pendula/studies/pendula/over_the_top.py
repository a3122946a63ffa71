"""When pendula go over the top, with what chance, and what becomes of the chain then.

A pendulum is over the top once |x| > pi. The amplitudes cannot tell: their potential rises ever on,
while a pendulum turns round and round, and the strings wind up. The first passage of a member is
seen at its outputs, some of them in each period: who is beyond the top falls to the other side, and
that takes longer than a part of a period.

Before the sea has filled the chain no passage comes; later, chaos leaves no memory, and passages
come at a rate. So the rate counts time from `settled` on, and only the members that had no passage
by then.
"""

from collections.abc import Sequence
from math import ceil
from typing import NamedTuple

import numpy as np

from pendula.datasets.netcdf import Variable
from pendula.datasets.trajectories import Contents, describe_cases
from pendula.measures.confidence import Limits, event_rate, median_limits, share_limits
from pendula.problem import Problem
from pendula.simulation.ensembles import draw_members
from pendula.simulation.simulate import simulate

from .envelope import at_mu
from .followed import NOT_KNOWN, period_of, until_lost

TOP = np.pi


class Passage(NamedTuple):
    """What one run of the pendula is reduced to."""

    time: float  # when the first pendulum goes over the top; infinite if none does
    angle: np.ndarray  # (time,): the largest so far at each whole unit of tau, rad; NaN if unknown
    power: float  # largest known sum of (x / 2 mu)^2 over all pendula: at most P of the envelopes


def with_outputs(problem: Problem, per_period: int) -> Problem:
    """Return the problem with so many outputs in a period, the last not before its end."""
    step = period_of(problem) / per_period
    return problem.changed(output_step=step, end_time=ceil(problem.end_time / step) * step)


def passage(problem: Problem, per_period: int) -> Passage:
    """Follow one run to its end, or until a pendulum is lost."""
    run = simulate(until_lost(with_outputs(problem, per_period)))
    largest = run.linf.max(axis=0)
    beyond = np.flatnonzero(largest > TOP)
    whole = np.arange(1, int(problem.end_time) + 1)
    so_far = np.maximum.accumulate(largest)[np.searchsorted(run.tau, whole) - 1]
    so_far = np.where(whole <= run.tau[-1], so_far, np.nan)
    angles = (run.l2 * run.l2).sum(axis=0).max()
    power = float(angles) / (4.0 * problem.mu * problem.mu)
    return Passage(float(run.tau[beyond[0]]) if beyond.size else np.inf, so_far, power)


def passed_by(times: np.ndarray, tau: np.ndarray) -> Limits:
    """Return the share of members that have gone over the top by each tau, with exact limits.

    All are watched equally long, so that this is one minus the estimate of Kaplan and Meier.
    """
    counts = (times[:, None] <= tau).sum(axis=0)
    known = {int(count): share_limits(int(count), len(times)) for count in np.unique(counts)}
    return Limits(*np.array([known[int(count)] for count in counts]).T)


def measure_over_the_top(
    problem: Problem, mus: Sequence[float], per_period: int, size: float, members: int, seed: int,
    settled: float,
) -> Contents:  # fmt: skip
    """Return first passages of members of the case at each mu, chances by tau, and rates."""
    drawn = draw_members(problem, size, members, seed)
    runs = [[passage(at_mu(one, mu), per_period) for one in drawn] for mu in mus]
    times = np.array([[one.time for one in row] for row in runs])
    tau = np.arange(1.0, int(problem.end_time) + 1.0)
    _, shared = describe_cases({"sea": problem})
    angles = np.array([[one.angle for one in row] for row in runs])
    over, title = ("mu",), "When pendula go over the top, and how far they turn then"
    about = {"perturbation": size, "members": members, "seed": seed, "settled": settled}
    about |= {"comment": NOT_KNOWN} if np.isnan(angles).any() else {}
    return {
        "mu": Variable(over, list(mus)),
        "tau": Variable(("tau",), tau),
        "passage_time": Variable((*over, "member"), times,
                                 "time of the first passage over the top, infinite if later"),
        "angle_so_far": Variable((*over, "member", "tau"), angles,
                                  "largest angle of any pendulum so far", "rad"),
        "angle_power": Variable((*over, "member"),
                                  [[one.power for one in row] for row in runs],
                                  "largest sum of (x / 2 mu)^2 over all pendula"),
        **_limits("passed", (*over, "tau"), [passed_by(row, tau) for row in times],
                  "share of members that have gone over the top"),
        **_limits("passage_median", over, [median_limits(row) for row in times],
                  "median time of the first passage, from order statistics"),
        **_limits("passage_rate", over,
                  [event_rate(row, settled, problem.end_time) for row in times],
                  "rate of first passages after the settled time, per unit of tau"),
    }, {**shared, **about, "omega": problem.constants.omega, "title": title}  # fmt: skip


ENDS = {"value": "", "low": ", lower confidence limit", "high": ", upper confidence limit"}


def _limits(name: str, over, limits: Sequence[Limits], words: str) -> dict[str, Variable]:
    """Return an estimate and its two limits as three variables."""
    return {
        name if end == "value" else f"{name}_{end}": Variable(
            over, np.array([getattr(one, end) for one in limits]), words + said
        )
        for end, said in ENDS.items()
    }
