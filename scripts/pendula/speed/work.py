"""The work-precision dataset: each solver and peer, each case, each accuracy."""

from collections.abc import Callable

import numpy as np

from pendula.datasets.netcdf import Variable
from pendula.simulation.simulate import Trajectory, output_times

from .contestants import OURS, Contestant
from .ladder import Rung, climb
from .pairs import Comparison, compare, target_of
from .regimes import REGIME_OF, REGIMES
from .runs import follow
from .tasks import Task

OUTPUT_STEP = 0.025

RUNG_FIELDS = {
    "accuracy": ("tolerance or step that was asked for", "1"),
    "seconds": ("median time of a run without outputs", "s"),
    "least": ("least time of a run", "s"),
    "most": ("largest time of a run", "s"),
    "error": ("largest error of an amplitude at the horizon", "1"),
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
    tasks: list[Task],
    norms: dict[str, tuple[np.ndarray, np.ndarray]],
    peers: dict[str, Contestant],
    say: Callable[[str], None],
) -> dict[str, Variable]:
    """Return the variables of the dataset; `norms` are the exact (linf, l2) of each case."""
    cases, contestants = [task.name for task in tasks], {**OURS, **peers}
    climbed, watched, pairs = {}, {}, {}
    for task in tasks:
        for name, contestant in contestants.items():
            say(f"{task.name}: {contestant.title}")
            # peers need not err much less than what they are compared at
            goal = 0.0 if name in OURS else 0.3 * target_of(task)
            climbed[task.name, name] = climb(contestant, task, goal)
        own = {name: climbed[task.name, name] for name in OURS}
        for name, rungs in own.items():
            watched[task.name, name] = [watch(task, norms[task.name], name, r) for r in rungs]
        for name, peer in peers.items():
            pairs[task.name, name] = compare(task, peer, climbed[task.name, name], OURS, own)
    return {
        **_coordinates(cases, contestants, peers),
        **_tabulate(RUNG_FIELDS, climbed, cases, list(contestants), "contestant"),
        **_tabulate(OWN_FIELDS, watched, cases, list(OURS), "solver"),
        **_tabulate_pairs(pairs, cases, list(peers)),
    }


def watch(task: Task, norms, name: str, rung: Rung) -> tuple:
    """Return what a run with outputs shows, in the order of OWN_FIELDS."""
    times = output_times(task.end_time, OUTPUT_STEP)
    run = follow(task, times, name, rung.accuracy)
    work = run.outcome
    return work.steps + work.rejected, work.evaluations, norm_error(run, norms), drift(run)


def norm_error(run: Trajectory, norms) -> float:
    """Return the largest error of the l-infinity and l2 norms, each relative to its largest."""
    count = len(run.tau)
    return max(
        float(np.max(np.abs(mine - exact[:, :count])) / np.max(exact[:, :count]))
        for mine, exact in zip((run.linf, run.l2), norms, strict=True)
    )


def drift(run: Trajectory) -> float:
    return float(np.max(np.abs(run.energy - run.energy[0])))


def _coordinates(cases, contestants, peers) -> dict[str, Variable]:
    regimes = [REGIME_OF[case] for case in cases]
    titles = [contestant.title for contestant in contestants.values()]
    return {
        "case": Variable(("case",), np.array(cases), "case of the paper"),
        "regime": Variable(("case",), np.array(regimes), "kind of motion"),
        "horizon": Variable(
            ("case",), [REGIMES[name].horizon for name in regimes], "slow time of the errors"
        ),
        "target": Variable(
            ("case",), [REGIMES[name].target for name in regimes], "error of the comparison"
        ),
        "contestant": Variable(("contestant",), np.array(list(contestants)), "solver or peer"),
        "title": Variable(("contestant",), np.array(titles), "its name in tables"),
        "solver": Variable(("solver",), np.array(list(OURS)), "solver of this project"),
        **({"peer": Variable(("peer",), np.array(list(peers)), "peer")} if peers else {}),
    }


def _tabulate(fields, found, cases, names, dim) -> dict[str, Variable]:
    """Return one variable a field over (case, name, rung), NaN beyond the last rung."""
    longest = max(len(rows) for rows in found.values())
    table = np.full((len(fields), len(cases), len(names), longest), np.nan)
    for i, case in enumerate(cases):
        for j, name in enumerate(names):
            for k, row in enumerate(found[case, name]):
                table[:, i, j, k] = row
    return {
        name: Variable(("case", dim, "rung"), values, *fields[name])
        for name, values in zip(fields, table, strict=True)
    }


def _tabulate_pairs(pairs: dict[tuple, Comparison | None], cases, names) -> dict[str, Variable]:
    if not names:
        return {}
    table = np.full((len(PAIR_FIELDS), len(cases), len(names)), np.nan)
    best = np.full((len(cases), len(names)), "", dtype="U32")
    for i, case in enumerate(cases):
        for j, name in enumerate(names):
            found = pairs[case, name]
            if found:
                ratios, errors = found.ratios, (found.peer_rung.error, found.our_rung.error)
                table[:, i, j] = np.median(ratios), ratios.min(), ratios.max(), *errors
                best[i, j] = found.ours
    return {
        "our_best": Variable(("case", "peer"), best, "our solver in the pairs"),
        **{
            name: Variable(("case", "peer"), values, *PAIR_FIELDS[name])
            for name, values in zip(PAIR_FIELDS, table, strict=True)
        },
    }
