"""Points of a work-precision diagram, and two contestants in turns at the same error."""

from typing import NamedTuple

import numpy as np
from pendula.problem import Problem

from .contestants import Contestant
from .peer import Solve
from .problems import error_of
from .timing import Run, Times, TooLongError, in_turns, limit, repeat

PATIENCE = 1.0
"""Seconds: a contestant that took longer is not asked for more accuracy."""
LIMIT = 5.0
"""Seconds after which a run is broken off."""
ENOUGH = 0.1
"""Seconds of repetitions after which a median is taken."""
LEAST, MOST = 3, 15
"""Repetitions of a run, as its length allows."""

PAIRS, FEW_PAIRS = 7, 3
LONG = 0.3
"""Seconds: a run that takes longer is not repeated by itself, and few pairs are enough."""
BLOCK = 0.02
"""Seconds that one side of a pair takes at least: short runs are repeated."""


class Point(NamedTuple):
    """What one accuracy costs (median, least and most of the repetitions, s) and brings."""

    accuracy: float
    seconds: float
    least: float
    most: float
    error: float


class Comparison(NamedTuple):
    """How many times as long a peer takes as our best solver, each at an error below the target."""

    ours: str
    our_point: Point
    peer_point: Point
    ratios: np.ndarray


def measure_points(
    contestant: Contestant, problem: Problem, exact: np.ndarray, goal: float = 0.0
) -> list[Point]:
    """Return one point for each accuracy, from the loosest to the tightest.

    `exact` is the state (component, site) at the end of the problem. The first accuracy that takes
    too long, or errs by less than `goal`, is the last one. An accuracy at which the contestant
    gives up, or returns what is not finite, has no point.
    """
    solve, points = contestant.prepare(problem), []
    for accuracy in contestant.accuracies:
        try:
            with limit(LIMIT):
                final, seconds = solve(accuracy)
                if not points and seconds > LONG:  # the very first may have compiled
                    final, seconds = solve(accuracy)
        except TooLongError:
            break
        except RuntimeError:  # of a peer that gives up; IntegrationError is one too
            continue
        if not np.all(np.isfinite(final)):
            continue
        times = _times(solve, accuracy, seconds)
        points.append(Point(accuracy, *times, error_of(final, exact)))
        if times.median > PATIENCE or points[-1].error < goal:
            break
    return points


def _times(solve: Solve, accuracy: float, first: float) -> Times:
    """Return the times of repeated runs; a long first run is not repeated."""
    if first > LONG:
        return Times(first, first, first)
    return repeat(_run(solve, accuracy), LEAST, MOST, ENOUGH, warm=True)


def _run(solve: Solve, accuracy: float) -> Run:
    return lambda: solve(accuracy)[1]


def cheapest(points: list[Point], target: float) -> Point | None:
    """Return the point of the least time whose error is not above the target, if there is one."""
    reached = [point for point in points if point.error <= target]
    return min(reached, key=lambda point: point.seconds, default=None)


def best_of(points: dict[str, list[Point]], target: float) -> str | None:
    """Return the name of the contestant that reaches the target in the least time."""
    reached = {name: cheapest(own, target) for name, own in points.items()}
    times = {name: point.seconds for name, point in reached.items() if point}
    return min(times, key=times.get, default=None)


def compare(
    problem: Problem,
    target: float,
    peer: tuple[Contestant, list[Point]],
    ours: dict[str, tuple[Contestant, list[Point]]],
) -> Comparison | None:
    """Let the peer and our best solver take turns; None where one of them misses the target."""
    best = best_of({name: points for name, (_, points) in ours.items()}, target)
    theirs = cheapest(peer[1], target)
    if best is None or theirs is None:
        return None
    mine = cheapest(ours[best][1], target)
    run_peer = _run(peer[0].prepare(problem), theirs.accuracy)
    run_ours = _run(ours[best][0].prepare(problem), mine.accuracy)
    turns = FEW_PAIRS if theirs.seconds > LONG else PAIRS
    return Comparison(best, mine, theirs, in_turns(run_peer, run_ours, turns, BLOCK))
