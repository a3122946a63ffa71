"""The dataset of speed against error, by case, contestant and accuracy."""

from collections.abc import Callable, Mapping
from itertools import product

import numpy as np
from latticode.datasets.netcdf import Variable
from pendula.many_cases import describe_cases
from pendula.problem import PaperProblem

from .contestants import OURS, Contestant, Point, cheapest, compete
from .problems import REGIME_OF, REGIMES

POINT_FIELDS = {
    "accuracy": ("tolerance or step that was asked for", "1"),
    "seconds": ("median time of a run without outputs", "s"),
    "error": ("error of an amplitude at the horizon, the largest", "1"),
}
PAIR_FIELDS = {
    "ratio": "time of the peer over that of our best solver, median of pairs",
    "ratio_least": "least ratio of a pair",
    "ratio_most": "largest ratio of a pair",
}


def measure(
    problems: Mapping[str, PaperProblem],
    references: Mapping[str, np.ndarray],
    peers: Mapping[str, Contestant],
    report: Callable[[str], None],
) -> dict[str, Variable]:
    """Return the variables of the dataset.

    `problems` are the cases by name, which end at the time of the errors and have no outputs.
    `references` are their multiprecision solutions at this time, (component, site). `report` is
    called with the name of each measurement before it starts. The dataset also has the shortest
    times and mean ratios that are published.
    """
    points, pairs, best = {}, {}, []
    for case, problem in problems.items():
        target = REGIMES[REGIME_OF[case]].target
        announce = lambda title, case=case: report(f"{case}: {title}")  # noqa: E731
        exact = references[case]
        points[case], pairs[case] = compete(problem, exact, target, OURS, peers, announce)
        reached = [cheapest(points[case][name], target) for name in OURS]
        best.append([point.seconds if point else np.nan for point in reached])
    regimes = [REGIME_OF[case] for case in problems]
    horizons, targets = (
        [getattr(REGIMES[name], field) for name in regimes] for field in ("horizon", "target")
    )
    named, _ = describe_cases(problems)
    return {
        "case": Variable(("case",), np.array(list(problems))),
        "regime": Variable(("case",), np.array(regimes), "kind of motion"),
        "horizon": Variable(("case",), np.array(horizons), "slow time of the errors"),
        "target": Variable(("case",), np.array(targets), "error of the comparison"),
        "solver": Variable(("solver",), np.array(list(OURS))),
        **name_contestants({**OURS, **peers}),
        **by_point(POINT_FIELDS, points),
        "best_seconds": Variable(
            ("case", "solver"),
            np.array(best),
            "least time within the error of the comparison, not a number where not reached",
            "s",
        ),
        **(by_pair(pairs, list(peers)) if peers else {}),
        **named,
    }


def name_contestants(contestants: Mapping[str, Contestant]) -> dict[str, Variable]:
    """Return the coordinate `contestant`, and the titles in tables."""
    titles = np.array([contestant.title for contestant in contestants.values()])
    return {
        "contestant": Variable(("contestant",), np.array(list(contestants)), "solver or peer"),
        "title": Variable(("contestant",), titles, "its name in tables"),
    }


def by_point(
    fields: Mapping[str, tuple], points: Mapping[str, Mapping[str, list[Point]]]
) -> dict[str, Variable]:
    """Return a variable for each field, (case, contestant, point), NaN beyond the last point.

    `points` are by case and by name, each with its numbers in the order of `fields`.
    """
    rows = [list(rows.values()) for rows in points.values()]
    longest = max(len(points) for rows in rows for points in rows)
    table = np.full((len(rows), len(rows[0]), longest, len(fields)), np.nan)
    for i, j in np.ndindex(table.shape[:2]):
        if rows[i][j]:
            table[i, j, : len(rows[i][j])] = rows[i][j]
    return {
        name: Variable(("case", "contestant", "point"), table[..., k], *fields[name])
        for k, name in enumerate(fields)
    }


def by_pair(
    pairs: Mapping[str, Mapping[str, np.ndarray | None]], peers: list[str]
) -> dict[str, Variable]:
    """Return the variables that compare peers with our best solver; `pairs` are time ratios."""
    table = np.full((len(PAIR_FIELDS), len(pairs), len(peers)), np.nan)
    for (i, case), (j, name) in product(enumerate(pairs), enumerate(peers)):
        if (ratios := pairs[case][name]) is not None:
            table[:, i, j] = np.median(ratios), ratios.min(), ratios.max()
    count = np.isfinite(table[0]).sum(axis=0)
    logarithms = np.nansum(np.log(table[0]), axis=0)
    mean = np.where(count > 0, np.exp(logarithms / np.maximum(count, 1)), np.nan)
    return {
        "peer": Variable(("peer",), np.array(peers), "peer"),
        "mean_ratio": Variable(("peer",), mean, "geometric mean of the ratios over the cases"),
        "reached_cases": Variable(("peer",), count, "cases in which the error was reached"),
        **{
            name: Variable(("case", "peer"), values, PAIR_FIELDS[name])
            for name, values in zip(PAIR_FIELDS, table, strict=True)
        },
    }
