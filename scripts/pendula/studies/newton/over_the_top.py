"""When pendula at Omega = 0 go over the top, and their chaotic state before that.

A pendulum is over the top once |x| > pi. The amplitudes cannot tell: their potential rises ever on,
while a pendulum turns round and round, and the strings wind up. The first passage of a member is
seen at its outputs, several in each period: a pendulum beyond the top falls to the other side, and
that takes longer than the time between two outputs. Before the chaotic state has filled the chain
no passage comes; later, chaos leaves no memory, and passages come at a rate. So the rate counts
time from `settled` on, and only the members that had no passage by then.

By (3) the angle x swings with the amplitude 2 mu |A|, so that the mean of (x / mu)^2 / 2 over time
is that of |A|^2 where no pendulum is over the top. It is compared with that of the same members by
the amplitude equations, on the same chain and over the same time.
"""

from collections.abc import Mapping, Sequence
from math import ceil

import numpy as np
import xarray as xr
from latticode.datasets.netcdf import Variable, as_xarray
from latticode.datasets.trajectories import Contents
from latticode.measures.confidence import Limits, difference_limits, event_rate, share_limits
from latticode.simulation.ensembles import draw_members
from latticode.simulation.runs import ManyRuns, run_all, shaped
from latticode.simulation.simulate import Trajectory, simulate

from pendula.models.pendula import frequency
from pendula.problem import PENDULA, Problem
from pendula.varied import Printed, as_dataset, vary_several

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
    return {
        "time": float(run.tau[beyond[0]]) if beyond.size else np.inf,
        "site_power": late_square(run, problem) / (2.0 * mu * mu),
    }


def amplitude_power(problem: Problem) -> dict[str, float]:
    """Return P of a site by the amplitude equations, mean over the late half of the run."""
    return {"site_power": late_square(simulate(problem, energy=False), problem)}


def late_square(run: Trajectory, problem: Problem) -> float:
    """Return the mean square of a site over the late half of a run, both components together."""
    squares = (run.l2 * run.l2).sum(axis=0)[run.tau >= 0.5 * problem.end_time]
    return float(squares.mean()) / problem.sites


def measure_over_the_top(
    problem: Problem,
    mus: Sequence[float],
    size: float,
    members: int,
    seed: int,
    settled: float,
) -> ManyRuns:
    """Return the runs that give first passages of members at each mu, shares by tau, and rates."""
    drawn = draw_members(problem, size, members, seed)
    each = [one.changed(model=PENDULA, mu=float(mu)) for mu in mus for one in drawn]

    def conclude(retained: dict[str, np.ndarray]) -> Contents:
        return _passages_of(drawn, mus, settled, shaped(retained, (len(mus), members)))

    return ManyRuns(each, passage, conclude)


def _passages_of(
    drawn: list[Problem], mus: Sequence[float], settled: float, retained: Mapping[str, np.ndarray]
) -> Contents:
    """Return the contents of the dataset of what `passage` returns, each (mu, member).

    All are watched equally long, so that a share is one minus the estimate of Kaplan and Meier.
    """
    times, powers = retained.values()
    members, end_time = len(drawn), drawn[0].end_time
    of_amplitudes = run_all(drawn, amplitude_power)["site_power"]
    tau = np.arange(1.0, int(end_time) + 1.0)
    counts = (times[..., None] <= tau).sum(axis=1)
    passed = [[share_limits(int(one), members) for one in row] for row in counts]
    rates = [event_rate(row, settled, end_time) for row in times]
    over = ("mu", "member")
    variables = {
        "mu": Variable(("mu",), list(mus)),
        "tau": Variable(("tau",), tau),
        "passage_time": Variable(
            over, times, "time of the first passage over the top, infinite if later"
        ),
        "site_power": Variable(
            over, powers, "mean of (x^2 + y^2) / (2 mu^2) over sites and the late half of the run"
        ),
        "amplitude_power": Variable(
            ("member",), of_amplitudes, "mean of |A|^2 + |B|^2 over the same, by equations (4)"
        ),
    }
    for name, dims, found, words in (
        ("passed", ("mu", "tau"), passed, "share of members that have gone over the top"),
        (
            "passage_rate",
            ("mu",),
            rates,
            "rate of first passages after the settled time, per unit of tau; NaN: none was left",
        ),
    ):
        value, low, high = np.moveaxis(np.array(found), -1, 0)
        variables[name] = Variable(dims, value, words)
        variables[f"{name}_low"] = Variable(dims, low, f"{words}, lower confidence limit")
        variables[f"{name}_high"] = Variable(dims, high, f"{words}, upper confidence limit")
    return variables, {"title": "When pendula go over the top"}


# --- The numbers that the article prints, and what moves them ------------------------------------

MEANINGS = {
    "passed": "share of members that have gone over the top by the end",
    "passage_rate": "rate of first passages after the settled time, per unit of tau",
    "power_excess": "relative excess of P of a site over that of the amplitudes on the same chain; "
    "NaN: a pendulum went over the top",
}


def vary_over_the_top(
    problem: Problem,
    mus: Sequence[float],
    members: int,
    end_time: float,
    chosen: Mapping[str, float],
    variations: Mapping[str, Sequence[float]],
) -> xr.Dataset:
    """Return the numbers of MEANINGS at each mu, measured again with each choice changed.

    `chosen` are the tolerance, the size of the perturbation, the seed and the settled time, and
    `variations` their other values. Longer runs are a variation too.
    """

    def measure(tolerance, size, seed, settled, run_time):
        solver = problem.solver | {"rtol": tolerance, "atol": tolerance}
        runs = problem.changed(solver=solver, end_time=run_time)
        study = measure_over_the_top(runs, mus, size, members, int(seed), settled)
        return printed_numbers(as_xarray(*study.make()), end_time)

    choices = {name: [value, *variations.get(name, ())] for name, value in chosen.items()}
    numbers = vary_several(measure, choices | {"run_time": [end_time, 2.0 * end_time]})
    printed = {name: Printed(("mu",), one, MEANINGS[name]) for name, one in numbers.items()}
    data = as_dataset(printed, {"mu": ("mu", list(mus), {"long_name": "mu"})})
    about = {"members": members, "end_time": end_time, "settled": chosen["settled"]}
    return data.assign_attrs(title="Pendula over the top, with other choices", **about)


def printed_numbers(study: xr.Dataset, by_tau: float) -> dict[str, Limits]:
    """Return the numbers of MEANINGS with their limits, (mu,); the share is that by a time."""
    found = {}
    for name in ("passed", "passage_rate"):
        ends = (study[f"{name}{end}"] for end in ("", "_low", "_high"))
        found[name] = Limits(*(one.sel(tau=by_tau) if "tau" in one.dims else one for one in ends))
    amplitudes = study["amplitude_power"]
    excess = [difference_limits(powers, amplitudes) for powers in study["site_power"]]
    below = np.isinf(study["passage_time"]).all("member")
    parts = np.transpose(excess) / float(amplitudes.mean())
    return found | {"power_excess": Limits(*np.where(below, parts, np.nan))}
