"""The contestants: all solvers of this project, and the installed integrators by others.

A contestant is prepared once for each problem, which may compile code. It then solves the problem
at several accuracies (tolerances or steps), from loose to tight. These are the points of a
work-precision diagram. Peers and our best solver also run in turns at the same error.
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
"""Time of a run in s above which no tighter accuracy is tried."""
LIMIT = 5.0
"""Seconds after which a run is stopped."""
REPEAT, PAIRS, FEW_PAIRS = 7, 7, 3
LONG = 0.3
"""Time of a run in s above which it is timed only once, and in FEW_PAIRS pairs."""
BLOCK = 0.02
"""Shortest time in s of one side of a pair; shorter runs are repeated."""


class Contestant(NamedTuple):
    """A title for tables, accuracies from loose to tight, and a function that prepares a solver."""

    title: str
    accuracies: np.ndarray
    prepare: Callable[[PaperProblem], Solve]


class Point(NamedTuple):
    """An accuracy, the median time of its runs in s, and their error."""

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
    """Return the installed peers, and the reasons why others are missing; print the reasons."""
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
    """Return the largest difference between the numbers of two final states."""
    return float(np.abs(final - exact).max())


def measure_points(
    contestant: Contestant, problem: PaperProblem, exact: np.ndarray, goal: float = 0.0
) -> list[Point]:
    """Return one point for each accuracy, from the loosest to the tightest.

    `exact` is the state at the end of the problem. No accuracy is tried after one that takes too
    long, or has an error below `goal`. An accuracy has no point if the contestant fails or returns
    numbers that are not finite.
    """
    solve, points = contestant.prepare(problem), []
    for accuracy in contestant.accuracies:
        try:
            with limit(LIMIT):
                final, seconds = solve(accuracy)
                if not points and seconds > LONG:  # the first run may have compiled
                    final, seconds = solve(accuracy)
        except TooLongError:
            break
        except RuntimeError:  # raised by peers that fail; IntegrationError is a subclass
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
    """Return the fastest point with an error of at most `target`, None if there is none."""
    reached = [point for point in points if point.error <= target]
    return min(reached, key=lambda point: point.seconds, default=None)


def compare(
    problem: PaperProblem, target: float, peer: Measured, ours: dict[str, Measured]
) -> np.ndarray | None:
    """Return ratios of the peer's time to our best solver's time.

    Both run in turns with errors of at most `target`; None if one of them cannot reach it.
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
    report: Callable[[str], None],
) -> tuple[dict[str, list[Point]], dict[str, np.ndarray | None]]:
    """Return the points of all contestants by name, and the ratios of each peer by `compare`.

    `report` is called with the title of each contestant before it is measured.
    """
    points = {}
    for name, contestant in {**ours, **peers}.items():
        report(contestant.title)
        # peers are compared at the target only, and need no error far below it
        goal = 0.0 if name in ours else 0.3 * target
        points[name] = measure_points(contestant, problem, exact, goal)
    measured = {name: (contestant, points[name]) for name, contestant in ours.items()}
    pairs = {
        name: compare(problem, target, (peer, points[name]), measured)
        for name, peer in peers.items()
    }
    return points, pairs
