"""Ensembles of long runs on infinite chains, and maxima over half-widths, as datasets."""

from collections.abc import Callable

import numpy as np

from pendula.datasets.netcdf import Variable
from pendula.datasets.registry import NAMES
from pendula.datasets.trajectories import Contents, describe_run, shared_by
from pendula.numerics.draws import normal
from pendula.numerics.elementary import modulus
from pendula.problem import Problem

from .active_sites import LEVELS, LongRun, run_chains, run_long
from .bulk import NEIGHBOURS, POWER, TERMS
from .front import (
    DELAY,
    PIECE_TAU,
    PREDICTED_SPEED,
    REST,
    SITE_OF_FRONT,
    is_unstable,
    linear_front,
)

PULLED = "one: a front is pulled at that speed; zero: no wave packet is faster"


def member(problem: Problem, perturbation: float, seed: int, number: int) -> Problem:
    """Return the problem of an ensemble's member; number 0 has the initial data as they are.

    The relative differences are `perturbation` times normal draws: chaos makes them of order one in
    some ten units of tau. All sites of a component share a factor, so that even data stay even.
    """
    if number == 0:
        return problem
    draws = normal(np.random.default_rng([seed, number]), 2)
    return problem.changed(initial=problem.initial * (1.0 + perturbation * draws)[:, None])


def attributes(title: str, name: str, problems: list[Problem], rest: float, **ensemble) -> dict:
    """Return what all of `problems` have in common: of varied parameters there is no one value."""
    described = [describe_run(name, problem, problem.solver) for problem in problems]
    shared = shared_by(described, "half_width", "snapshot_every")
    ends = {"boundary": "none: sites are added as the front moves", "rest": rest}
    return {"title": title, **shared, **ends, **ensemble}


# --- Series of each run ---------------------------------------------------------------------------


def spread_case(
    name: str, problems: list[Problem], rest: float, members: int, perturbation: float, seed: int,
    step: Callable[[str], None],
) -> Contents:  # fmt: skip
    """Return the series of each problem and member."""
    runs, ensemble = [], {"members": members, "perturbation": perturbation, "seed": seed}
    for variant, problem in enumerate(problems):
        runs.append([])
        for number in range(members):
            runs[-1].append(run_long(member(problem, perturbation, seed, number), rest))
            step(f"{name}: member {number + 1} of {members} of problem {variant + 1} done")
    title = f"Norms, front and final states of {name} on infinite chains"
    return run_variables(problems, runs), attributes(title, name, problems, rest, **ensemble)


def run_variables(problems: list[Problem], runs: list[list[LongRun]]) -> dict[str, Variable]:
    """Return the variables of `runs` [variant][member] of as many problems."""
    first, predicted = runs[0][0], [linear_front(problem.constants) for problem in problems]
    central = [modulus(one.initial[0, one.initial.shape[1] // 2]) for one in problems]
    both, behind = "of A and B together", "over the bulk behind the front"
    terms = f"terms of H per site, {behind}"
    widest = max(run.sites.shape[1] for members in runs for run in members)
    states = [
        [np.pad(run.sites, ((0, 0), (0, widest - run.sites.shape[1]))) for run in members]
        for members in runs
    ]

    def of_variants(values: list[float], long_name: str = "") -> Variable:
        return Variable(("variant",), np.array(values, float), long_name)

    def of_runs(values, axes: tuple, long_name: str = "") -> Variable:
        return Variable(("variant", "member", *axes), values, long_name)

    def series(name: str) -> np.ndarray:
        return np.array([[getattr(run, name) for run in members] for members in runs])

    bulk, at_fronts = series("bulk"), ("piece_tau", "front_power")
    return {
        "tau": Variable(("tau",), first.tau),
        "piece_tau": Variable(("piece_tau",), first.piece_tau, PIECE_TAU),
        "front_power": Variable(("front_power",), LEVELS, "power P at which the front is found"),
        "omega": of_variants([p.constants.omega for p in problems]),
        "central_modulus": of_variants(central, "initial |A_0|"),
        "tolerance": of_variants([p.solver["rtol"] for p in problems], "tolerance of the solver"),
        "l2": of_runs(series("l2"), ("tau",), f"{NAMES['l2']}, {both}"),
        "linf": of_runs(series("linf"), ("tau",), f"{NAMES['linf']}, {both}"),
        "energy": of_runs(series("energy"), ("tau",)),
        "front": of_runs(series("front"), at_fronts, SITE_OF_FRONT),
        "width": of_runs(series("width"), ("piece_tau",), "last site that is integrated, W"),
        "term": Variable(("term",), list(TERMS), "term of the energy (8)"),
        "bulk_power": of_runs(bulk[..., 0], at_fronts, f"{POWER}, {behind}"),
        "bulk_terms": of_runs(bulk[..., 1:], (*at_fronts, "term"), terms),
        "neighbours": Variable(("neighbours",), NEIGHBOURS, "neighbouring sites of a block"),
        "bulk_maximum": of_runs(
            series("maxima"),
            ("piece_tau", "neighbours"),
            "largest |A_n| or |B_n| of a block, mean over blocks of the old bulk; NaN: none",
        ),
        "state": of_runs(
            np.array(states), ("row", "site"), "Re A, Im A, Re B, Im B at the end, zero beyond W"
        ),
        "predicted_speed": of_variants([front.speed for front in predicted], PREDICTED_SPEED),
        "predicted_delay": of_variants([front.delay for front in predicted], DELAY),
        "predicted_rest": of_variants([front.rest for front in predicted], REST),
    }


# --- Maxima over [10, T] on chains of half-width M ------------------------------------------------

START = 10.0
"""Where the paper's windows begin."""


def map_windows(
    name: str, problem: Problem, rest: float, half_widths: list[int], members: int,
    perturbation: float, seed: int, step: Callable[[str], None],
) -> Contents:  # fmt: skip
    """Return the maxima of an ensemble for every T between 10 and the end of the runs."""
    ends = np.arange(START + 2.0, problem.end_time + 1.0, 2.0)
    maps, ensemble = [], {"members": members, "perturbation": perturbation, "seed": seed}
    for number in range(members):
        started = member(problem, perturbation, seed, number)
        maps.append(window_map(started, rest, half_widths, ends))
        step(f"{name}: member {number + 1} of {members} done")
    l2, linf = np.swapaxes(maps, 0, 1)
    axes = ("member", "half_width", "end")
    found = f"of A and B together, maximum over [{START:g}, end]"
    variables = {
        "half_width": Variable(("half_width",), np.asarray(half_widths)),
        "end": Variable(("end",), ends, "end of the time window"),
        "l2": Variable(axes, l2, f"{NAMES['l2']}, {found}"),
        "linf": Variable(axes, linf, f"{NAMES['linf']}, {found}"),
        "predicted_speed": Variable((), linear_front(problem.constants).speed, PREDICTED_SPEED),
        "pulled": Variable((), int(is_unstable(problem.constants)), PULLED),
    }
    title = f"Maxima of the norms over half-widths and time windows, case of {name}"
    return variables, attributes(title, name, [problem], rest, **ensemble)


def window_map(
    problem: Problem, rest: float, half_widths: list[int], ends: np.ndarray
) -> np.ndarray:
    """Return the maxima of l2 and l-infinity of the pair over [START, end], (2, half_width, end).

    See `active_sites` for `rest`; `half_widths` rise.
    """
    runs = run_chains(problem, rest, half_widths)
    return np.stack([maxima(tau, np.array(norms), ends) for tau, *norms in runs], axis=1)


def maxima(tau: np.ndarray, series: np.ndarray, ends: np.ndarray) -> np.ndarray:
    """Return the largest value of (..., time) over [START, end] for each of `ends`, (..., end)."""
    first = np.searchsorted(tau, START - 1e-9)
    running = np.maximum.accumulate(series[..., first:], axis=-1)
    return running[..., np.searchsorted(tau[first:], np.asarray(ends) + 1e-9) - 1]
