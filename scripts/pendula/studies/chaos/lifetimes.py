"""Two times of the transition to the chaotic state at Omega = 0, against the initial amplitude.

Zero is unstable, so the chain around the centre is always set in motion. The *transition* of the
chain is over when P first reaches half of its final value, its mean over a time window. The *life*
of the centre ends when the central pair first has at most a multiple of P / N, the mean power of
a pair. From a large amplitude the centre outlives the transition, and stays excited inside a
chaotic chain. Lives longer than the run are censored.
"""

from collections.abc import Mapping, Sequence
from functools import partial
from typing import Any

import numpy as np
import xarray as xr
from latticode.datasets.netcdf import Variable, as_xarray
from latticode.datasets.trajectories import Contents
from latticode.equations.ensembles import draw_members
from latticode.measures.confidence import ConfidenceInterval
from latticode.simulation.runs import ManyRuns
from latticode.simulation.simulate import Trajectory, simulate
from replication.variables import CHAOTIC

from pendula.many_cases import describe_cases
from pendula.problem import PaperProblem
from pendula.varied import NamedNumber, as_dataset, vary_several

from .clocks import NUMBERS, TIMES, limits_of

SPAN = 10.0
"""After the window the run goes on in intervals of this length in tau. The centre is checked after
each interval, and the run stops once its life has ended."""


def follow(
    problem: PaperProblem, window: Sequence[float], level: float, multiple: float = 1.0
) -> dict[str, float]:
    """Return NUMBERS of a run until its centre has at most `multiple` P / N, or to its end.

    The transition is over when P reaches `level` times its final value. `window` must end before
    the run.
    """
    first = simulate(problem.changed(end_time=window[1], snapshot_every=1), conserved=False)
    numbers = in_window(first, window, level)
    ended = np.flatnonzero(centre_is_average(first.modulus, multiple))
    if ended.size:
        return numbers | {"life": float(first.tau[ended[0]])}
    life = measure_later_life(problem, first, window[1], multiple)
    return numbers | {"life": life}


def in_window(run: Trajectory, window: Sequence[float], level: float) -> dict[str, float]:
    """Return the time of the transition, and the means over the window."""
    power, inside = (run.modulus**2).sum(axis=0), run.tau >= window[0]
    total = power.sum(axis=0)
    final = total[inside].mean()
    return {
        "transition": float(run.tau[np.argmax(total >= level * final)]),
        "centre_share": float((power[len(power) // 2] / total)[inside].mean()),
        "l2": float(np.sqrt(total[inside]).mean()),
        "linf": float(run.linf.max(axis=0)[inside].mean()),
    }


def measure_later_life(
    problem: PaperProblem, run: Trajectory, start: float, multiple: float
) -> float:
    """Return the end of the centre's life after `start`, the end of `run`.

    It is infinite if the centre outlives the end time of the problem.
    """
    remaining = problem.end_time - start
    if remaining <= 0.0:
        return np.inf
    spans = max(1, round(remaining / SPAN))
    span = problem.changed(end_time=remaining / spans, snapshot_every=1)
    for done in range(spans):
        run = simulate(span.changed(initial=run.final), conserved=False)
        ended = np.flatnonzero(centre_is_average(run.modulus, multiple))
        if ended.size:
            return float(start + done * span.end_time + run.tau[ended[0]])
    return np.inf


def centre_is_average(modulus: np.ndarray, multiple: float = 1.0) -> np.ndarray:
    """Return whether the central pair has at most `multiple` P / N, (time,).

    `modulus` is (component, site, time), with an odd number N of sites.
    """
    power = (modulus**2).sum(axis=0)
    return power[len(power) // 2] <= multiple * power.mean(axis=0)


def measure_lifetimes(
    problem: PaperProblem,
    amplitudes: list[float],
    ratio: float,
    size: float,
    members: int,
    seed: int,
    window: Sequence[float],
    level: float,
    multiple: float,
) -> ManyRuns:
    """Return the runs of all members from each A_0, with B_0 = `ratio` A_0.

    `size` is the relative perturbation. `window`, `level` and `multiple` are as in `follow`.
    """
    starts = [problem.changed(initial=[[a0], [ratio * a0]]) for a0 in amplitudes]
    drawn = [member for start in starts for member in draw_members(start, size, members, seed)]
    attributes_of_study = {
        "initial": f"A_0 and B_0 = {ratio:g} A_0 on the central pair",
        "ratio": ratio,
    }
    attributes_of_study |= {"perturbation": size, "members": members, "seed": seed}
    attributes_of_study |= {"window_start": window[0], "window_end": window[1], "level": level}
    attributes_of_study |= {"multiple": multiple}

    def conclude(numbers: Mapping[str, np.ndarray]) -> Contents:
        variables, attributes = _lifetimes_of(problem, amplitudes, members, numbers)
        return variables, attributes | attributes_of_study

    return ManyRuns(drawn, partial(follow, window=window, level=level, multiple=multiple), conclude)


def _lifetimes_of(
    problem: PaperProblem, amplitudes: list[float], members: int, numbers: Mapping[str, np.ndarray]
) -> Contents:
    """Return the dataset of NUMBERS, each given as (run,)."""
    over = ("start_amplitude",)
    variables = {
        "start_amplitude": Variable(over, np.array(amplitudes), "initial amplitude A_0"),
        **{
            name: Variable((*over, "member"), numbers[name].reshape(-1, members), long_name)
            for name, long_name in NUMBERS.items()
        },
    }
    _, shared = describe_cases({"centre": problem})
    title = "The transition at Omega = 0 and the life of the centre, against the initial amplitude"
    return variables, {**shared, "title": title, **CHAOTIC}


def vary_lifetimes(
    problem: PaperProblem,
    amplitudes: list[float],
    ratio: float,
    members: int,
    chosen: Mapping[str, float],
    variations: Mapping[str, Sequence],
) -> xr.Dataset:
    """Return the medians and means of `limits_of`, measured again with each choice changed."""

    def measure(
        tolerance: float, output_step: float, size: float, seed: float, **clocks: Any
    ) -> dict[str, ConfidenceInterval]:
        solver = problem.solver | {"rtol": tolerance, "atol": tolerance}
        start = problem.changed(solver=solver, output_step=output_step)
        runs = measure_lifetimes(start, amplitudes, ratio, size, members, int(seed), **clocks)
        return limits_of(as_xarray(*runs.make()))

    choices = {name: [value, *variations.get(name, ())] for name, value in chosen.items()}
    over, attributes = ("start_amplitude",), {"long_name": "initial amplitude A_0"}
    printed = {
        name: NamedNumber(over, number, f"{'median' if name in TIMES else 'mean'} of the {name}")
        for name, number in vary_several(measure, choices).items()
    }
    data = as_dataset(printed, {"start_amplitude": (over, np.array(amplitudes, float), attributes)})
    ends = {"members": members, "end_time": problem.end_time}
    return data.assign_attrs(title="The transition at Omega = 0, with other choices", **ends)
