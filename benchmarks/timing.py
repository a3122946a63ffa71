"""The one timer of all benchmarks: repetitions after a warm-up, and two runs that take turns.

`timeit` measures a callable from outside. Here a run tells its own seconds, because Octave reports
its time from another process, and because other integrators must be reset between runs, which is
not part of what they are measured at.
"""

import signal
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from time import perf_counter
from typing import Any, NamedTuple

import numpy as np

Run = Callable[[], float]
"""A run that returns the seconds that it took."""


class Times(NamedTuple):
    """The median, the least and the largest of repeated runs, in seconds."""

    median: float
    least: float
    most: float


class TooLongError(Exception):
    """A run that was broken off."""


def timed(action: Callable[[], Any]) -> tuple[Any, float]:
    """Return what `action()` returns, and the seconds that it took."""
    start = perf_counter()
    result = action()
    return result, perf_counter() - start


def clocked(action: Callable[[], Any]) -> Run:
    """Return `action` as a run that tells its seconds instead of its result."""
    return lambda: timed(action)[1]


def repeat(
    run: Run, least: int, most: int | None = None, enough: float = 0.0, warm: bool = False
) -> Times:
    """Repeat a run, after one that warms up unless it is `warm` already, and return the times.

    There are at least `least` repetitions; more follow, up to `most`, until all of them together
    took `enough` seconds.
    """
    if not warm:
        run()
    times = []
    while len(times) < least or (sum(times) < enough and len(times) < (most or least)):
        times.append(run())
    return Times(float(np.median(times)), min(times), max(times))


def in_turns(one: Run, other: Run, turns: int, block: float) -> np.ndarray:
    """Return `turns` ratios of the time of `one` to that of `other`, measured alternately.

    What slows the machine down slows both of a pair, so that ratios scatter less than times. Short
    runs are repeated until one side of a pair takes about `block` seconds. Each run is first made
    once to warm up.
    """
    counts = []
    for run in (one, other):
        run()  # what is not compiled yet is compiled before the first turn
        seconds = run()
        counts.append(max(1, round(block / seconds)) if seconds > 0.0 else 1)

    def mean(run: Run, count: int) -> float:
        return sum(run() for _ in range(count)) / count

    return np.array([mean(one, counts[0]) / mean(other, counts[1]) for _ in range(turns)])


@contextmanager
def limit(seconds: float) -> Iterator[None]:
    """Break the block off with TooLongError; a compiled run ends at its next step."""

    def stop(*_):
        raise TooLongError

    before = signal.signal(signal.SIGALRM, stop)
    signal.setitimer(signal.ITIMER_REAL, seconds)
    try:
        yield
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0.0)
        signal.signal(signal.SIGALRM, before)
