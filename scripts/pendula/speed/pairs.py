"""Two contestants in turns at the same error, so that what slows the machine slows both."""

from typing import NamedTuple

import numpy as np

from .contestants import Contestant
from .ladder import Rung, loosest
from .regimes import REGIME_OF, REGIMES
from .tasks import Task

PAIRS = 7
LONG = 1.0
"""Seconds: of a peer that takes longer, three pairs are enough."""
BLOCK = 0.02
"""Seconds that one side of a pair takes at least: short runs are repeated."""


class Comparison(NamedTuple):
    """How many times as long a peer takes as our best solver, each at an error below the target."""

    ours: str
    our_rung: Rung
    peer_rung: Rung
    ratios: np.ndarray


def target_of(task: Task) -> float:
    """Return the error at which contestants are compared on a task."""
    return REGIMES[REGIME_OF[task.name]].target


def best_of(rungs: dict[str, list[Rung]], target: float) -> str | None:
    """Return the name of the contestant that reaches the target first."""
    reached = {name: loosest(climbed, target) for name, climbed in rungs.items()}
    times = {name: rung.seconds for name, rung in reached.items() if rung}
    return min(times, key=times.get, default=None)


def compare(
    task: Task,
    peer: Contestant,
    peer_rungs: list[Rung],
    ours: dict[str, Contestant],
    our_rungs: dict[str, list[Rung]],
) -> Comparison | None:
    """Let the peer and our best solver take turns; None where the peer never gets that far."""
    target = target_of(task)
    best, theirs = best_of(our_rungs, target), loosest(peer_rungs, target)
    if best is None or theirs is None:
        return None
    mine = loosest(our_rungs[best], target)
    turns = 3 if theirs.seconds > LONG else PAIRS
    run_peer = _block(peer.prepare(task), theirs)
    run_ours = _block(ours[best].prepare(task), mine)
    ratios = np.array([run_peer() / run_ours() for _ in range(turns)])
    return Comparison(best, mine, theirs, ratios)


def _block(solve, rung: Rung):
    """Return a function that repeats the run for a while and returns its mean time in seconds."""
    count = max(1, round(BLOCK / rung.seconds))
    solve(rung.accuracy)  # what is not compiled yet is compiled before the first turn
    return lambda: sum(solve(rung.accuracy)[1] for _ in range(count)) / count
