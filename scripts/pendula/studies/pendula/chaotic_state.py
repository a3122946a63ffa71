"""The chaotic state that fills the chain at Omega = 0, and when pendula leave it over the top.

The state of the pendula is compared with that of the amplitudes. Both are chaotic, so ensembles are
compared: each member is reduced to means over all sites of the same chain and over one window of
time. That these also are near the thermal state without energy of an infinite chain
(pendula.studies.unbounded) is another question, since the chain has ends.

A pendulum is over the top once |x| > pi. The amplitudes cannot tell: their potential rises ever on,
while a pendulum turns round and round, and the strings wind up. The first passage of a member is
seen at its outputs, several in each period: a pendulum beyond the top falls to the other side, and
that takes longer than the time between two outputs. Before the chaotic state has filled the chain
no passage comes; later, chaos leaves no memory, and passages come at a rate. So the rate counts
time from `settled` on, and only the members that had no passage by then.
"""

from collections.abc import Sequence
from functools import partial
from math import ceil
from typing import NamedTuple

import numpy as np
from latticode.datasets.netcdf import Variable
from latticode.datasets.trajectories import Contents
from latticode.measures.confidence import Limits, event_rate, share_limits
from latticode.numerics.elementary import square_modulus
from latticode.simulation.ensembles import draw_members
from latticode.simulation.problem import name_window
from latticode.simulation.runs import Run, run_all, shaped
from latticode.simulation.simulate import simulate

from pendula.models.bounds import theorem_3_bound
from pendula.problem import Problem

from .runs import LIMIT, NOT_KNOWN, at_mu, period_of, states, until_lost

EDGES = np.linspace(0.0, 8.0, 41)
"""Cells of the distribution of moduli, which reach up to seven."""
TOP = np.pi
REDUCED = {
    "site_power": ((), "mean of |A_n|^2 + |B_n|^2 over sites and time"),
    "linf_level": ((), "mean of the l-infinity norm over the time window"),
    "modulus_share": (("modulus",), "share of moduli in a cell"),
}
"""What each member is reduced to: dimensions after mu and member, and in words."""


def reduce_member(problem: Problem, window: tuple[float, float]) -> dict:
    """Return P a site, norms and distribution of one run, mean over the window."""
    tau, amplitudes = states(problem)
    amplitudes = amplitudes[..., (tau >= window[0]) & (tau <= window[1])]
    squares = square_modulus(amplitudes)
    return {
        "site_power": squares.sum(axis=0).mean(),
        "linf_level": np.sqrt(squares.max(axis=(0, 1))).mean(),
        "modulus_share": np.histogram(np.sqrt(squares), EDGES)[0] / squares.size,
    }


def measure_sea(
    problem: Problem, mus: Sequence[float], window: tuple[float, float], size: float,
    members: int, seed: int, run: Run = run_all,
) -> Contents:  # fmt: skip
    """Return what REDUCED names of members of the chain of amplitudes, mu = 0, and of pendula."""
    every = [LIMIT, *mus]
    drawn = draw_members(problem, size, members, seed)
    each = [at_mu(one, mu) for mu in every for one in drawn]
    found = shaped(run(each, partial(reduce_member, window=window)), (len(every), members))
    variables = {
        "mu": Variable(("mu",), every),
        "modulus": Variable(("modulus",), 0.5 * (EDGES[1:] + EDGES[:-1])),
    }
    for name, (rest, words) in REDUCED.items():
        variables[name] = Variable(("mu", "member", *rest), found[name], words)
    title = f"The chaotic state of pendula and of amplitudes, over {name_window(window)}"
    about = {"title": f"{title}; mu = 0 stands for (4)", "omega": problem.constants.omega}
    return variables, about


# --- Over the top --------------------------------------------------------------------------------


class Passage(NamedTuple):
    """What one run of the pendula is reduced to."""

    time: float  # when the first pendulum goes over the top; infinite if none does
    angle: np.ndarray  # (time,): the largest so far at each whole unit of tau, rad; NaN if unknown
    power: float  # largest known sum of (x / 2 mu)^2 over all pendula: at most P of the envelopes


def passage(problem: Problem, per_period: int) -> Passage:
    """Follow one run to its end, or until a pendulum is lost; `per_period` outputs in a period."""
    step = period_of(problem) / per_period
    problem = problem.changed(output_step=step, end_time=ceil(problem.end_time / step) * step)
    run = simulate(until_lost(problem))
    largest = run.linf.max(axis=0)
    beyond = np.flatnonzero(largest > TOP)
    whole = np.arange(1, int(problem.end_time) + 1)
    so_far = np.maximum.accumulate(largest)[np.searchsorted(run.tau, whole) - 1]
    so_far = np.where(whole <= run.tau[-1], so_far, np.nan)
    angles = (run.l2 * run.l2).sum(axis=0).max()
    power = float(angles) / (4.0 * problem.mu * problem.mu)
    return Passage(float(run.tau[beyond[0]]) if beyond.size else np.inf, so_far, power)


def allowed(problem: Problem) -> float:
    """Return the bound of P by Theorem 3 on the data of a problem of (4)."""
    energy = simulate(problem.changed(end_time=problem.output_step)).energy[0]
    return float(theorem_3_bound(energy, problem.sites, problem.constants))


def passed_by(times: np.ndarray, tau: np.ndarray) -> Limits:
    """Return the share of members that have gone over the top by each tau, with exact limits.

    All are watched equally long, so that this is one minus the estimate of Kaplan and Meier.
    """
    counts = (times[:, None] <= tau).sum(axis=0)
    return Limits(*np.array([share_limits(int(count), len(times)) for count in counts]).T)


def measure_over_the_top(
    problem: Problem, mus: Sequence[float], per_period: int, size: float, members: int, seed: int,
    settled: float, run: Run = run_all,
) -> Contents:  # fmt: skip
    """Return first passages of members of the case at each mu, chances by tau, and rates."""
    drawn = draw_members(problem, size, members, seed)
    each = [at_mu(one, mu) for mu in mus for one in drawn]
    found = run(each, lambda one: passage(one, per_period)._asdict())
    times, angles, powers = shaped(found, (len(mus), members)).values()
    tau = np.arange(1.0, int(problem.end_time) + 1.0)
    over = ("mu", "member")
    variables = {
        "mu": Variable(("mu",), list(mus)),
        "tau": Variable(("tau",), tau),
        "passage_time": Variable(
            over, times, "time of the first passage over the top, infinite if later"),
        "angle_so_far": Variable(
            (*over, "tau"), angles, "largest angle of any pendulum so far", "rad"),
        "angle_power": Variable(over, powers, "largest sum of (x / 2 mu)^2 over all pendula"),
        "theorem_3_power": Variable(
            ("member",), [allowed(one) for one in drawn], "bound C_N of P by Theorem 3"),
    }  # fmt: skip
    for name, rest, found, words in (
        ("passed", ("tau",), [passed_by(row, tau) for row in times],
         "share of members that have gone over the top"),
        ("passage_rate", (), [event_rate(row, settled, problem.end_time) for row in times],
         "rate of first passages after the settled time, per unit of tau; NaN: none was left"),
    ):  # fmt: skip
        value, low, high = (np.array(one) for one in zip(*found, strict=True))
        over = ("mu", *rest)
        variables[name] = Variable(over, value, words)
        variables[f"{name}_low"] = Variable(over, low, f"{words}, lower confidence limit")
        variables[f"{name}_high"] = Variable(over, high, f"{words}, upper confidence limit")
    about = {"comment": NOT_KNOWN} if np.isnan(angles).any() else {}
    return variables, {"title": "When pendula go over the top, and how far they turn", **about}
