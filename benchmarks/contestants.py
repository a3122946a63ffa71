"""Who is compared: every solver of this project, and those of other people that are installed.

A contestant is prepared for a problem once (it compiles what it compiles) and then solves it at a
given accuracy (a tolerance, or a step), again and again: from loose to tight, which gives the
points of a work-precision diagram, and in turns with another one at the same error.
"""

from collections.abc import Callable, Mapping
from functools import partial
from typing import NamedTuple

import numpy as np
from latticode.simulation.simulate import simulate
from pendula.problem import PaperProblem

from . import peer_in_cpp, peers_in_python
from .peer import Peer, Solve
from .timing import TooLongError, in_turns, limit, repeat, timed

TOLERANCES = 10.0 ** -np.arange(4.0, 15.5)
ITERATED = ("crank_nicolson", "delfour_fortin_payre")
STEPS = {
    **{name: 0.04 / 2.0 ** np.arange(6) for name in ITERATED},
    "kahan_li": 1.6 / 2.0 ** np.arange(6),  # of the pendula, in their time t
}
PEERS: dict[str, Peer] = peers_in_python.PEERS | peer_in_cpp.PEERS

PATIENCE = 1.0
"""Seconds: a contestant that took longer is not asked for more accuracy."""
LIMIT = 5.0
"""Seconds after which a run is broken off."""
REPEAT, PAIRS, FEW_PAIRS = 7, 7, 3
LONG = 0.3
"""Seconds: a run that takes longer is not repeated by itself, and few pairs are enough."""
BLOCK = 0.02
"""Seconds that one side of a pair takes at least: short runs are repeated."""


class Contestant(NamedTuple):
    """Its name in tables, what it can be asked for, and how it is made ready for a problem."""

    title: str
    accuracies: np.ndarray
    prepare: Callable[[PaperProblem], Solve]


class Point(NamedTuple):
    """What one accuracy costs (median of the repetitions, s) and brings."""

    accuracy: float
    seconds: float
    error: float


Measured = tuple[Contestant, list[Point]]


def controls(name: str, accuracy: float) -> dict:
    """Return the controls of one of our solvers for a tolerance or a step."""
    if name in ITERATED:
        return {"name": name, "step": accuracy, "tolerance": 1e-13, "iterations": 50}
    if name in STEPS:
        return {"name": name, "step": accuracy}
    atol = accuracy / 100 if name == "ode45" else accuracy  # the paper's ratio for ode45
    return {"name": name, "rtol": accuracy, "atol": atol}


def _prepare_own(problem: PaperProblem, name: str) -> Solve:
    def solve(accuracy: float) -> tuple[np.ndarray, float]:
        controlled = problem.changed(solver=controls(name, float(accuracy)))
        run, seconds = timed(lambda: simulate(controlled))
        return run.final, seconds

    return solve


SOLVERS = {
    name: Contestant(name, STEPS.get(name, TOLERANCES), partial(_prepare_own, name=name))
    for name in ("ode45", *ITERATED, "dop853", "taylor", "kahan_li")
}
OURS = {name: contestant for name, contestant in SOLVERS.items() if name != "kahan_li"}
"""The solvers of the amplitudes."""


def find_peers(peers: Mapping[str, Peer]) -> tuple[dict[str, Contestant], str]:
    """Return the peers that are installed, and why others are missing, which is also printed."""
    absent = {name: why for name, peer in peers.items() if (why := peer.why_absent())}
    present = {
        name: Contestant(peer.title, TOLERANCES, peer.prepare)
        for name, peer in peers.items()
        if name not in absent
    }
    for reason in absent.values():
        print(f"not measured: {reason}")
    return present, "; ".join(absent.values())


def error_of(final: np.ndarray, exact: np.ndarray) -> float:
    """Return the largest difference of two final states in any number of a site."""
    return float(np.abs(final - exact).max())


def measure_points(
    contestant: Contestant, problem: PaperProblem, exact: np.ndarray, goal: float = 0.0
) -> list[Point]:
    """Return one point for each accuracy, from the loosest to the tightest.

    `exact` is the state at the end of the problem. The first accuracy that takes too long, or errs
    by less than `goal`, is the last one. An accuracy at which the contestant gives up, or returns
    what is not finite, has no point.
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
        if seconds <= LONG:
            seconds = repeat(lambda a=accuracy: solve(a)[1], REPEAT)
        points.append(Point(accuracy, seconds, error_of(final, exact)))
        if seconds > PATIENCE or points[-1].error < goal:
            break
    return points


def cheapest(points: list[Point], target: float) -> Point | None:
    """Return the point of the least time whose error is not above the target, if there is one."""
    reached = [point for point in points if point.error <= target]
    return min(reached, key=lambda point: point.seconds, default=None)


def compare(
    problem: PaperProblem, target: float, peer: Measured, ours: dict[str, Measured]
) -> np.ndarray | None:
    """Let the peer and our best solver take turns, each at an error below the target.

    Return how many times as long the peer takes; None where one of them misses the target.
    """
    reached = {name: cheapest(points, target) for name, (_, points) in ours.items()}
    times = {name: point.seconds for name, point in reached.items() if point}
    theirs = cheapest(peer[1], target)
    if not times or theirs is None:
        return None
    best = min(times, key=times.get)
    mine = reached[best]
    solve_peer, solve_ours = peer[0].prepare(problem), ours[best][0].prepare(problem)
    turns = FEW_PAIRS if theirs.seconds > LONG else PAIRS
    return in_turns(
        lambda: solve_peer(theirs.accuracy)[1], lambda: solve_ours(mine.accuracy)[1], turns, BLOCK
    )


def compete(
    problem: PaperProblem,
    exact: np.ndarray,
    target: float,
    ours: Mapping[str, Contestant],
    peers: Mapping[str, Contestant],
    say: Callable[[str], None],
) -> tuple[dict[str, list[Point]], dict[str, np.ndarray | None]]:
    """Return the points of all contestants by name, and how each peer compares with our best.

    `say` is called with the title of each contestant before it is measured.
    """
    points = {}
    for name, contestant in {**ours, **peers}.items():
        say(contestant.title)
        # peers need not err much less than what they are compared at
        goal = 0.0 if name in ours else 0.3 * target
        points[name] = measure_points(contestant, problem, exact, goal)
    measured = {name: (contestant, points[name]) for name, contestant in ours.items()}
    pairs = {
        name: compare(problem, target, (peer, points[name]), measured)
        for name, peer in peers.items()
    }
    return points, pairs
