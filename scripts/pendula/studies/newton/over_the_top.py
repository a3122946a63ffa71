"""First passages of pendula over the top at Omega = 0, and their chaotic state before that.

A pendulum is over the top once |x| > pi. The amplitude equations cannot describe this: the
potential rises without bound, while a pendulum rotates and the strings wind up. The first passage
is detected at one of OUTPUTS_PER_PERIOD outputs per period: a pendulum beyond the top stays there
for longer than the time between two outputs. No passage occurs before the chaotic state has filled
the chain. After this, chaos leaves no memory, and passages occur at a constant rate. The rate is
measured from the time `settled` on, in the members without an earlier passage.

By (3) the angle x swings with the amplitude 2 mu |A|. If no pendulum goes over the top, the mean of
(x / mu)^2 / 2 over time is the mean of |A|^2. It is compared with the mean of |A|^2 by the
amplitude equations, for the same members, chain and time.
"""

from collections.abc import Mapping, Sequence
from math import ceil

import numpy as np
import xarray as xr
from latticode.datasets.netcdf import Variable, as_xarray
from latticode.datasets.trajectories import Contents
from latticode.equations.ensembles import draw_members
from latticode.measures.confidence import (
    ConfidenceInterval,
    difference_limits,
    event_rate,
    share_limits,
)
from latticode.simulation.runs import ManyRuns, reshape_runs, run_all
from latticode.simulation.simulate import Trajectory, simulate
from replication.variables import CHAOTIC, FEW_CHOICES, missing

from pendula.models.pendula import frequency
from pendula.problem import PENDULA, PaperProblem
from pendula.varied import NamedNumber, as_dataset, vary_several

TOP = np.pi
OUTPUTS_PER_PERIOD = 8
"""Outputs in each period of the swings."""


def measure_passage(problem: PaperProblem) -> dict[str, float]:
    """Return the time of the first passage over the top, and P per site.

    The time is infinite if there is no passage. P is the mean over the late half of the run.
    """
    mu = problem.mu
    period = np.pi * mu * mu / frequency(problem.constants.omega, mu)  # in tau
    step = period / OUTPUTS_PER_PERIOD
    run = simulate(problem.changed(output_step=step, end_time=ceil(problem.end_time / step) * step))
    beyond = np.flatnonzero(run.linf.max(axis=0) > TOP)
    return {
        "time": float(run.tau[beyond[0]]) if beyond.size else np.inf,
        "site_power": late_mean_square(run, problem) / (2.0 * mu * mu),
    }


def measure_amplitude_power(problem: PaperProblem) -> dict[str, float]:
    """Return P per site by the amplitude equations, the mean over the late half of the run."""
    return {"site_power": late_mean_square(simulate(problem, conserved=False), problem)}


def late_mean_square(run: Trajectory, problem: PaperProblem) -> float:
    """Return the mean square per site, both components added, over the late half of a run."""
    squares = (run.l2 * run.l2).sum(axis=0)[run.tau >= 0.5 * problem.end_time]
    return float(squares.mean()) / problem.sites


def measure_over_the_top(
    problem: PaperProblem,
    mus: Sequence[float],
    size: float,
    members: int,
    seed: int,
    settled: float,
) -> ManyRuns:
    """Return the runs of all members at each mu, for the dataset of first passages.

    `size` is the relative perturbation of the initial data; rates are measured from tau = `settled`
    on.
    """
    amplitude_problems = draw_members(problem, size, members, seed)
    each = [
        member.changed(model=PENDULA, mu=float(mu)) for mu in mus for member in amplitude_problems
    ]

    def conclude(retained: dict[str, np.ndarray]) -> Contents:
        return _passage_contents(
            amplitude_problems, mus, settled, reshape_runs(retained, (len(mus), members))
        )

    return ManyRuns(each, measure_passage, conclude)


def _passage_contents(
    amplitude_problems: list[PaperProblem],
    mus: Sequence[float],
    settled: float,
    retained: Mapping[str, np.ndarray],
) -> Contents:
    """Return the dataset of the results of `measure_passage`, each (mu, member).

    All runs end at the same time, so a share is one minus the Kaplan-Meier estimate.
    """
    times, powers = retained.values()
    members, end_time = len(amplitude_problems), amplitude_problems[0].end_time
    amplitude_powers = run_all(amplitude_problems, measure_amplitude_power)["site_power"]
    tau = np.arange(1.0, int(end_time) + 1.0)
    counts = (times[..., None] <= tau).sum(axis=1)
    passed = [[share_limits(int(count), members) for count in row] for row in counts]
    rates = [event_rate(row, settled, end_time) for row in times]
    over = ("mu", "member")
    variables = {
        "mu": Variable(("mu",), list(mus), attributes=FEW_CHOICES),
        "tau": Variable(("tau",), tau),
        "passage_time": Variable(
            over, times, "time of the first passage over the top, infinite if later"
        ),
        "site_power": Variable(
            over, powers, "mean of (x^2 + y^2) / (2 mu^2) over sites and the late half of the run"
        ),
        "amplitude_power": Variable(
            ("member",), amplitude_powers, "mean of |A|^2 + |B|^2 over the same, by equations (4)"
        ),
    }
    shares = "share of members that have gone over the top"
    per_time = "rate of first passages after the settled time, per unit of tau"
    variables |= with_limits("passed", ("mu", "tau"), passed, shares)
    variables |= with_limits(
        "passage_rate", ("mu",), rates, per_time, missing("no member was left to pass")
    )
    return variables, {"title": "When pendula go over the top", **CHAOTIC}


def with_limits(
    name: str,
    dimensions: tuple[str, ...],
    limits: Sequence,
    long_name: str,
    attributes: Mapping[str, str] = {},
) -> dict[str, Variable]:
    """Return variables of a number and its confidence limits; `limits` has the shape (..., 3)."""
    ends = {"": "", "_low": ", lower confidence limit", "_high": ", upper confidence limit"}
    return {
        f"{name}{end}": Variable(dimensions, values, f"{long_name}{words}", attributes=attributes)
        for (end, words), values in zip(
            ends.items(), np.moveaxis(np.array(limits), -1, 0), strict=True
        )
    }


# --- The numbers of the article under other choices -----------------------------------------------

MEANINGS = {
    "passed": "share of members that have gone over the top by the end",
    "passage_rate": "rate of first passages after the settled time, per unit of tau",
    "power_excess": "relative excess of P of a site over that of the amplitudes on the same chain, "
    "unknown where a pendulum went over the top",
}


def vary_over_the_top(
    problem: PaperProblem,
    mus: Sequence[float],
    members: int,
    end_time: float,
    chosen: Mapping[str, float],
    variations: Mapping[str, Sequence[float]],
) -> xr.Dataset:
    """Return the numbers of MEANINGS (mu,), measured again with each choice changed.

    `chosen` are the tolerance, the perturbation (`size`), the seed and the time `settled`;
    `variations` are their other values. Runs of twice the duration are also a variation.
    """

    def measure(
        tolerance: float, size: float, seed: float, settled: float, run_time: float
    ) -> dict[str, ConfidenceInterval]:
        solver = problem.solver | {"rtol": tolerance, "atol": tolerance}
        runs = problem.changed(solver=solver, end_time=run_time)
        study = measure_over_the_top(runs, mus, size, members, int(seed), settled)
        return printed_numbers(as_xarray(*study.make()), end_time)

    choices = {name: [value, *variations.get(name, ())] for name, value in chosen.items()}
    numbers = vary_several(measure, choices | {"run_time": [end_time, 2.0 * end_time]})
    printed = {
        name: NamedNumber(("mu",), number, MEANINGS[name]) for name, number in numbers.items()
    }
    data = as_dataset(printed, {"mu": ("mu", list(mus), {"long_name": "mu"})})
    attributes = {"members": members, "end_time": end_time, "settled": chosen["settled"]}
    return data.assign_attrs(title="Pendula over the top, with other choices", **attributes)


def printed_numbers(study: xr.Dataset, by_tau: float) -> dict[str, ConfidenceInterval]:
    """Return the numbers of MEANINGS (mu,) with limits; the share is at tau = `by_tau`."""
    numbers = {}
    for name in ("passed", "passage_rate"):
        ends = (study[f"{name}{end}"] for end in ("", "_low", "_high"))
        numbers[name] = ConfidenceInterval(
            *(limit.sel(tau=by_tau) if "tau" in limit.dims else limit for limit in ends)
        )
    amplitudes = study["amplitude_power"]
    excess = [difference_limits(powers, amplitudes) for powers in study["site_power"]]
    below = np.isinf(study["passage_time"]).all("member")
    relative_excess = np.transpose(excess) / float(amplitudes.mean())
    return numbers | {"power_excess": ConfidenceInterval(*np.where(below, relative_excess, np.nan))}
