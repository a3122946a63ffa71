"""When pendula at Omega = 0 go over the top, and their chaotic state before that.

A pendulum is over the top once |x| > pi. The amplitudes cannot tell: their potential rises ever on,
while a pendulum turns round and round, and the strings wind up. The first passage of a member is
seen at its outputs, several in each period: a pendulum beyond the top falls to the other side, and
that takes longer than the time between two outputs. Before the chaotic state has filled the chain
no passage comes; later, chaos leaves no memory, and passages come at a rate. So the rate counts
time from `settled` on, and only the members that had no passage by then.

By (3) the angle x swings with the amplitude 2 mu |A|, so that the mean of (x / mu)^2 / 2 over time
is that of |A|^2 where no pendulum is over the top.
"""

from collections.abc import Sequence
from math import ceil

import numpy as np
from latticode.datasets.netcdf import Variable
from latticode.datasets.trajectories import Contents
from latticode.measures.confidence import event_rate, share_limits
from latticode.simulation.ensembles import draw_members
from latticode.simulation.runs import Run, run_all, shaped
from latticode.simulation.simulate import simulate

from pendula.models.pendula import frequency
from pendula.problem import PENDULA, Problem

TOP = np.pi
PER_PERIOD = 8
"""Looks at the angles in a period."""


def passage(problem: Problem) -> dict[str, float]:
    """Return when the first pendulum of a run goes over the top, infinite if none does, and P.

    P is that of a site, mean over the late half of the run.
    """
    mu = problem.mu
    period = np.pi * mu * mu / frequency(problem.constants.omega, mu)  # in tau
    step = period / PER_PERIOD
    run = simulate(problem.changed(output_step=step, end_time=ceil(problem.end_time / step) * step))
    beyond = np.flatnonzero(run.linf.max(axis=0) > TOP)
    squares = (run.l2 * run.l2).sum(axis=0)[run.tau >= 0.5 * problem.end_time]
    return {
        "time": float(run.tau[beyond[0]]) if beyond.size else np.inf,
        "site_power": float(squares.mean()) / (2.0 * mu * mu * problem.sites),
    }


def measure_over_the_top(
    problem: Problem, mus: Sequence[float], size: float, members: int, seed: int, settled: float,
    run: Run = run_all,
) -> Contents:  # fmt: skip
    """Return first passages of members of the case at each mu, shares by tau, and rates.

    All are watched equally long, so that a share is one minus the estimate of Kaplan and Meier.
    """
    drawn = draw_members(problem, size, members, seed)
    each = [one.changed(model=PENDULA, mu=float(mu)) for mu in mus for one in drawn]
    times, powers = shaped(run(each, passage), (len(mus), members)).values()
    tau = np.arange(1.0, int(problem.end_time) + 1.0)
    counts = (times[..., None] <= tau).sum(axis=1)
    passed = [[share_limits(int(one), members) for one in row] for row in counts]
    rates = [event_rate(row, settled, problem.end_time) for row in times]
    over = ("mu", "member")
    variables = {
        "mu": Variable(("mu",), list(mus)),
        "tau": Variable(("tau",), tau),
        "passage_time": Variable(
            over, times, "time of the first passage over the top, infinite if later"),
        "site_power": Variable(
            over, powers, "mean of (x^2 + y^2) / (2 mu^2) over sites and the late half of the run"),
    }  # fmt: skip
    for name, dims, found, words in (
        ("passed", ("mu", "tau"), passed, "share of members that have gone over the top"),
        ("passage_rate", ("mu",), rates,
         "rate of first passages after the settled time, per unit of tau; NaN: none was left"),
    ):  # fmt: skip
        value, low, high = np.moveaxis(np.array(found), -1, 0)
        variables[name] = Variable(dims, value, words)
        variables[f"{name}_low"] = Variable(dims, low, f"{words}, lower confidence limit")
        variables[f"{name}_high"] = Variable(dims, high, f"{words}, upper confidence limit")
    return variables, {"title": "When pendula go over the top"}
