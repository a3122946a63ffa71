"""The one timer of all benchmarks: repetitions after a warm-up, and two runs that take turns.

`timeit` measures a callable from outside. Here a run tells its own seconds, because other
integrators must be reset between runs, which is not part of what they are measured at.
"""

import signal
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from time import perf_counter
from typing import Any

import numpy as np

Run = Callable[[], float]
"""A run that returns the seconds that it took."""


class TooLongError(Exception):
    """A run that was broken off."""


def timed(action: Callable[[], Any]) -> tuple[Any, float]:
    """Return what `action()` returns, and the seconds that it took."""
    start = perf_counter()
    result = action()
    return result, perf_counter() - start


def repeat(run: Run, count: int) -> float:
    """Return the median of the seconds of `count` runs."""
    return float(np.median([run() for _ in range(count)]))


def in_turns(first: Run, second: Run, turns: int, block: float) -> np.ndarray:
    """Return `turns` ratios of the time of `first` to that of `second`, measured alternately.

    What slows the machine down slows both of a pair, so that ratios scatter less than times. Short
    runs are repeated until one side of a pair takes about `block` seconds. Each run is first made
    once to warm up.
    """
    counts = []
    for run in (first, second):
        run()  # what is not compiled yet is compiled before the first turn
        seconds = run()
        counts.append(max(1, round(block / seconds)) if seconds > 0.0 else 1)

    def mean(run: Run, count: int) -> float:
        return sum(run() for _ in range(count)) / count

    return np.array([mean(first, counts[0]) / mean(second, counts[1]) for _ in range(turns)])


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
