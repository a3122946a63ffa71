"""The datasets of ensembles of long runs on infinite chains."""

from collections.abc import Mapping, Sequence
from functools import partial
from typing import Any

import numpy as np
from latticode.datasets.netcdf import Variable
from latticode.datasets.registry import NAMES
from latticode.datasets.stated import describe_run, shared_by
from latticode.datasets.trajectories import Contents
from latticode.numerics.draws import normal
from latticode.simulation.runs import ManyRuns, reshape_runs
from replication.variables import CHAOTIC, REGULAR, missing

from pendula.problem import PaperProblem

from .active_sites import run_long
from .bulk import EDGE, KINDS, LEVEL, PREDICTED_SPEED, REGIONS
from .front import linear_front

SCANS = ("omegas", "starts")
"""Ensembles over Omega or initial conditions, which are not of one case of the paper."""


def member(problem: PaperProblem, perturbation: float, seed: int, number: int) -> PaperProblem:
    """Return the problem of an ensemble's member; number 0 has the unperturbed initial data.

    The other members have a relative change of these data, `perturbation` times normal draws. Chaos
    amplifies it to order one within some ten units of tau. All sites of a component have the same
    draw, so that even data stay even.
    """
    if number == 0:
        return problem
    draws = normal(np.random.default_rng([seed, number]), 2)
    return problem.changed(initial=problem.initial * (1.0 + perturbation * draws)[:, None])


def members_of(
    problems: list[PaperProblem], members: int, perturbation: float, seed: int
) -> list[PaperProblem]:
    """Return all members of each problem."""
    return [member(problem, perturbation, seed, n) for problem in problems for n in range(members)]


def attributes(
    title: str, name: str, problems: list[PaperProblem], rest_threshold: float, **ensemble: Any
) -> dict:
    """Return the attributes that all `problems` share, without parameters that differ."""
    described = [describe_run(name, problem, problem.solver) for problem in problems]
    shared = shared_by(described, "half_width", "snapshot_every")
    ends = {"boundary": "none: sites are added as the front moves", "rest": rest_threshold}
    chaos = CHAOTIC if name in SCANS else {}
    return {"title": title, **shared, **ends, **ensemble, **chaos}


def spread_case(
    name: str,
    problems: list[PaperProblem],
    rest_threshold: float,
    members: int,
    perturbation: float,
    seed: int,
    levels: Sequence[float] = (LEVEL,),
    edges: Sequence[int] = (EDGE,),
) -> ManyRuns:
    """Return the runs of all problems and members, for the dataset of the series of `run_long`."""
    ensemble = {"members": members, "perturbation": perturbation, "seed": seed}
    make = partial(run_long, rest_threshold=rest_threshold, levels=levels, edges=edges)
    title = f"Norms, fronts and the state behind them of {name} on infinite chains"

    def conclude(retained: dict[str, np.ndarray]) -> Contents:
        series = reshape_runs(retained, (len(problems), members))
        variables = run_variables(problems, series, levels, edges)
        return variables, attributes(title, name, problems, rest_threshold, **ensemble)

    return ManyRuns(members_of(problems, **ensemble), make, conclude)


def run_variables(
    problems: list[PaperProblem],
    series: Mapping[str, np.ndarray],
    levels: Sequence[float] = (LEVEL,),
    edges: Sequence[int] = (EDGE,),
) -> dict[str, Variable]:
    """Return the variables of `series` (variant, member, ...), with a variant for each problem."""
    predicted = [linear_front(problem.constants) for problem in problems]

    def of_variants(values: list[float], long_name: str = "") -> Variable:
        return Variable(("variant",), np.array(values, float), long_name, attributes=REGULAR)

    def of_runs(name: str, axes: tuple, long_name: str, attributes: Mapping = {}) -> Variable:
        dimensions = ("variant", "member", *axes)
        return Variable(dimensions, series[name], long_name, attributes=attributes)

    both = "of A and B together"
    level = ("level",) if len(levels) > 1 else ()
    edge = ("edge",) if len(edges) > 1 else ()
    axes = {
        "level": Variable(level, levels, "least |S|^2 of a pair that the second front has passed"),
        "edge": Variable(edge, edges, "sites behind the first front that are not between both"),
    }
    return {
        **{name: axis for name, axis in axes.items() if axis.dimensions},
        "tau": Variable(("tau",), series["tau"][0, 0]),
        "piece_tau": Variable(
            ("piece_tau",), series["piece_tau"][0, 0], "slow time at the end of each interval"
        ),
        "region": Variable(("region",), list(REGIONS), "region of the chain"),
        "kind": Variable(
            ("kind",), list(KINDS), "kind of power of a pair, with S = (A + B) / sqrt 2"
        ),
        "omega": of_variants([p.constants.omega for p in problems]),
        "l2": of_runs("l2", ("tau",), f"{NAMES['l2']}, {both}"),
        "linf": of_runs("linf", ("tau",), f"{NAMES['linf']}, {both}"),
        "front": of_runs("front", ("piece_tau",), "site of the first front"),
        "second_front": of_runs(
            "second_front", ("piece_tau", *level), "site of the second front, -1 if there is none"
        ),
        "region_mean": of_runs(
            "means",
            ("piece_tau", *edge, "region", "kind"),
            "mean over a region",
            missing("the region has no sites"),
        ),
        "predicted_speed": of_variants([front.speed for front in predicted], PREDICTED_SPEED),
        "predicted_delay": of_variants(
            [front.delay for front in predicted],
            "delay of a pulled front, in sites per unit of log tau",
        ),
    }
