"""Climb from loose to tight: the time and the error of one contestant on one task."""

import signal
from collections.abc import Iterator
from contextlib import contextmanager
from typing import NamedTuple

import numpy as np

from pendula.simulation.simulate import IntegrationError

from .contestants import Contestant
from .tasks import Task, error_of

PATIENCE = 3.0
"""Seconds: a contestant that took longer is not asked for more accuracy."""
LIMIT = 12.0
"""Seconds after which a run is broken off."""
ENOUGH = 0.2
"""Seconds of repetitions after which a median is taken."""


class Rung(NamedTuple):
    """What one accuracy costs (median, least and most of the repetitions, s) and brings."""

    accuracy: float
    seconds: float
    least: float
    most: float
    error: float


class TooLongError(Exception):
    """A run that was broken off."""


@contextmanager
def limit(seconds: float) -> Iterator[None]:
    """Break the block off with TooLongError; compiled code is left to its end first."""

    def stop(*_):
        raise TooLongError

    before = signal.signal(signal.SIGALRM, stop)
    signal.setitimer(signal.ITIMER_REAL, seconds)
    try:
        yield
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0.0)
        signal.signal(signal.SIGALRM, before)


def climb(contestant: Contestant, task: Task, goal: float = 0.0) -> list[Rung]:
    """Return one rung for each accuracy, up to one that takes too long or errs less than `goal`.

    An accuracy at which the contestant gives up, or returns no numbers, has no rung.
    """
    solve, rungs = contestant.prepare(task), []
    for accuracy in contestant.accuracies:
        try:
            with limit(LIMIT):
                final, seconds = solve(accuracy)  # warms the caches
                if not rungs and seconds > PATIENCE:  # the very first may have compiled
                    final, seconds = solve(accuracy)
        except TooLongError:
            break
        except (IntegrationError, RuntimeError):
            continue
        if not np.all(np.isfinite(final)):
            continue
        rungs.append(_repeat(solve, accuracy, seconds, error_of(task, final)))
        if rungs[-1].seconds > PATIENCE or rungs[-1].error < goal:
            break
    return rungs


def _repeat(solve, accuracy: float, first: float, error: float) -> Rung:
    """Repeat a run five to fifteen times as its length allows; a very long one stands as it is."""
    if first > PATIENCE:
        return Rung(accuracy, first, first, first, error)
    times = []
    while len(times) < 3 or (sum(times) < ENOUGH and len(times) < 15):
        times.append(solve(accuracy)[1])
    return Rung(accuracy, float(np.median(times)), min(times), max(times), error)


def loosest(rungs: list[Rung], target: float) -> Rung | None:
    """Return the cheapest rung whose error is not above the target, if there is one."""
    reached = [rung for rung in rungs if rung.error <= target]
    return min(reached, key=lambda rung: rung.seconds, default=None)
