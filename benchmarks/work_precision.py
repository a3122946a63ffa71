"""The dataset of speed against error: each solver and peer, each case, each accuracy."""

from collections.abc import Callable, Mapping

import numpy as np
from pendula.datasets.netcdf import Variable
from pendula.datasets.trajectories import describe_cases
from pendula.problem import Problem
from pendula.simulation.simulate import Trajectory, simulate

from .contestants import OURS, Contestant, controls
from .points import Comparison, Point, cheapest, compare, measure_points
from .problems import OUTPUT_STEP, REGIME_OF, REGIMES, Reference

POINT_FIELDS = {
    "accuracy": ("tolerance or step that was asked for", "1"),
    "seconds": ("median time of a run without outputs", "s"),
    "least": ("least time of a run", "s"),
    "most": ("largest time of a run", "s"),
    "error": ("error of an amplitude at the horizon, the largest", "1"),
}
OWN_FIELDS = {
    "steps": ("accepted and rejected steps", "1"),
    "evaluations": ("right-hand sides, or coefficients of the series", "1"),
    "norm_error": ("largest error of a norm up to the horizon, relative to its largest value", "1"),
    "energy_drift": ("largest change of the energy up to the horizon", "1"),
}
PAIR_FIELDS = {
    "ratio": ("time of the peer over that of our best solver, median of pairs", "1"),
    "ratio_least": ("least ratio of a pair", "1"),
    "ratio_most": ("largest ratio of a pair", "1"),
    "peer_error": ("error of the peer in the pairs", "1"),
    "our_error": ("error of our best solver in the pairs", "1"),
}


def measure(
    problems: Mapping[str, Problem],
    references: Mapping[str, Reference],
    peers: Mapping[str, Contestant],
    say: Callable[[str], None],
) -> dict[str, Variable]:
    """Return the variables of the dataset.

    `problems` are the cases by name, each up to the time of the errors and without outputs;
    `references` are what is true of them. `say` is told what is measured next.
    """
    contestants = {**OURS, **peers}
    found, watched, pairs = {}, {}, {}
    for case, problem in problems.items():
        target, exact = target_of(case), references[case]
        for name, contestant in contestants.items():
            say(f"{case}: {contestant.title}")
            # peers need not err much less than what they are compared at
            goal = 0.0 if name in OURS else 0.3 * target
            found[case, name] = measure_points(contestant, problem, exact.final, goal)
        own = {name: (contestant, found[case, name]) for name, contestant in OURS.items()}
        for name, (_, points) in own.items():
            watched[case, name] = [watch(problem, exact, name, point) for point in points]
        for name, peer in peers.items():
            pairs[case, name] = compare(problem, target, (peer, found[case, name]), own)
    named, _ = describe_cases(problems)
    return {**assemble(list(problems), contestants, found, watched, pairs), **named}


def assemble(
    cases: list[str],
    contestants: Mapping[str, Contestant],
    found: Mapping[tuple[str, str], list[Point]],
    watched: Mapping[tuple[str, str], list[tuple]],
    pairs: Mapping[tuple[str, str], Comparison | None],
) -> dict[str, Variable]:
    """Return the dataset's variables; measurements are given by (case, contestant).

    Among `contestants` are the solvers of this project, in OURS, and peers. What is published, the
    least times and the mean ratios, is stored beside what it follows from.
    """
    peers = [name for name in contestants if name not in OURS]
    return {
        **_coordinates(cases, contestants, peers),
        **_by_point(POINT_FIELDS, found, cases, list(contestants), "contestant"),
        **_by_point(OWN_FIELDS, watched, cases, list(OURS), "solver"),
        "best_seconds": Variable(
            ("case", "solver"),
            np.array([[_best(found[case, name], case) for name in OURS] for case in cases]),
            "least time within the error of the comparison, not a number where not reached",
            "s",
        ),
        **(_by_pair(pairs, cases, peers) if peers else {}),
    }


def _best(points: list[Point], case: str) -> float:
    point = cheapest(points, target_of(case))
    return point.seconds if point else np.nan


def target_of(case: str) -> float:
    """Return the error at which contestants are compared on a case."""
    return REGIMES[REGIME_OF[case]].target


def watch(problem: Problem, exact: Reference, name: str, point: Point) -> tuple:
    """Return what a run with outputs shows, in the order of OWN_FIELDS."""
    solver = controls(name, point.accuracy)
    run = simulate(problem.changed(output_step=OUTPUT_STEP, solver=solver))
    work = run.outcome
    return work.steps + work.rejected, work.evaluations, norm_error(run, exact), drift(run)


def norm_error(run: Trajectory, exact: Reference) -> float:
    """Return the largest error of the l-infinity and l2 norms, each relative to its largest."""
    count = len(run.tau)
    return max(
        float(np.max(np.abs(mine - true[:, :count])) / np.max(true[:, :count]))
        for mine, true in ((run.linf, exact.linf), (run.l2, exact.l2))
    )


def drift(run: Trajectory) -> float:
    """Return the largest change of the energy since the start."""
    return float(np.max(np.abs(run.energy - run.energy[0])))


def _coordinates(cases, contestants, peers) -> dict[str, Variable]:
    regimes = [REGIMES[REGIME_OF[case]] for case in cases]
    names = np.array([REGIME_OF[case] for case in cases])
    titles = np.array([contestant.title for contestant in contestants.values()])
    by_case, by_contestant = ("case",), ("contestant",)
    horizons = np.array([regime.horizon for regime in regimes])
    targets = np.array([regime.target for regime in regimes])
    return {
        "case": Variable(by_case, np.array(cases)),
        "regime": Variable(by_case, names, "kind of motion"),
        "horizon": Variable(by_case, horizons, "slow time of the errors"),
        "target": Variable(by_case, targets, "error of the comparison"),
        "contestant": Variable(by_contestant, np.array(list(contestants)), "solver or peer"),
        "title": Variable(by_contestant, titles, "its name in tables"),
        "solver": Variable(("solver",), np.array(list(OURS))),
        **({"peer": Variable(("peer",), np.array(list(peers)), "peer")} if peers else {}),
    }


def _by_point(fields, found, cases, names, dim) -> dict[str, Variable]:
    """Return one variable a field over (case, name, point), NaN beyond the last point."""
    longest = max(len(rows) for rows in found.values())
    table = np.full((len(fields), len(cases), len(names), longest), np.nan)
    for i, case in enumerate(cases):
        for j, name in enumerate(names):
            for k, row in enumerate(found[case, name]):
                table[:, i, j, k] = row
    return {
        name: Variable(("case", dim, "point"), values, *fields[name])
        for name, values in zip(fields, table, strict=True)
    }


def _by_pair(pairs: dict[tuple, Comparison | None], cases, names) -> dict[str, Variable]:
    table = np.full((len(PAIR_FIELDS), len(cases), len(names)), np.nan)
    best = np.full((len(cases), len(names)), "", dtype="U32")
    for i, case in enumerate(cases):
        for j, name in enumerate(names):
            found = pairs[case, name]
            if found:
                ratios, errors = found.ratios, (found.peer_point.error, found.our_point.error)
                table[:, i, j] = np.median(ratios), ratios.min(), ratios.max(), *errors
                best[i, j] = found.ours
    reached = np.isfinite(table[0])
    logarithms = np.log(np.where(reached, table[0], 1.0)).sum(axis=0)
    count = reached.sum(axis=0)
    mean = np.where(count > 0, np.exp(logarithms / np.maximum(count, 1)), np.nan)
    return {
        "our_best": Variable(("case", "peer"), best, "our solver in the pairs"),
        "mean_ratio": Variable(("peer",), mean, "geometric mean of the ratios over the cases"),
        "reached_cases": Variable(("peer",), count, "cases in which the error was reached"),
        **{
            name: Variable(("case", "peer"), values, *PAIR_FIELDS[name])
            for name, values in zip(PAIR_FIELDS, table, strict=True)
        },
    }
