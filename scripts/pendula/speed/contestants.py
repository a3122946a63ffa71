"""Who is compared: every solver of this project, and those of other people that are installed.

A contestant is prepared for a task once (it compiles what it compiles) and then solves it at a
given accuracy (a tolerance, or a step), again and again.
"""

from collections.abc import Callable
from functools import partial
from time import perf_counter
from typing import NamedTuple

import numpy as np

from pendula.peers import PEERS, Problem

from .runs import follow
from .tasks import Task

Solve = Callable[[float], tuple[np.ndarray, float]]
"""From an accuracy to the amplitudes (component, site) at the end and the seconds it took."""

TOLERANCES = 10.0 ** -np.arange(4.0, 15.5)
STEPS = {"splitting": 0.2 / 2.0 ** np.arange(7), "crank_nicolson": 0.04 / 2.0 ** np.arange(6)}


class Contestant(NamedTuple):
    """Its name in tables, what it can be asked for, and how it is made ready for a task."""

    title: str
    accuracies: np.ndarray
    prepare: Callable[[Task], Solve]


def _prepare_own(name: str, task: Task) -> Solve:
    ends = np.array([0.0, task.end_time])

    def solve(accuracy: float) -> tuple[np.ndarray, float]:
        start = perf_counter()
        final = follow(task, ends, name, accuracy).final
        return final, perf_counter() - start

    return solve


def _prepare_peer(peer, task: Task) -> Solve:
    return peer.prepare(Problem(task.constants, task.boundary, task.amplitudes, task.end_time))


OURS = {
    name: Contestant(name, STEPS.get(name, TOLERANCES), partial(_prepare_own, name))
    for name in ("ode45", "crank_nicolson", "dop853", "taylor", "splitting")
}


def find_peers() -> tuple[dict[str, Contestant], dict[str, str]]:
    """Return the peers that are installed, and for the others the reason why they are missing."""
    present, absent = {}, {}
    for name, peer in PEERS.items():
        reason = peer.why_absent()
        if reason:
            absent[name] = reason
        else:
            present[name] = Contestant(peer.title, TOLERANCES, partial(_prepare_peer, peer))
    return present, absent
