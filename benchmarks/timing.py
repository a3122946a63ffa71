"""The timer of all benchmarks: repetitions after a warm-up, and two runs in turns.

`timeit` measures a whole callable. Here a run returns its own time, because some integrators must
be reset between runs, and this reset must not count.
"""

import signal
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from time import perf_counter
from typing import Any

import numpy as np

Run = Callable[[], float]
"""A function that makes a run and returns its time in seconds."""


class TooLongError(Exception):
    """Raised in a run that exceeds its limit of time."""


def timed(action: Callable[[], Any]) -> tuple[Any, float]:
    """Return the result of `action()`, and its time in seconds."""
    start = perf_counter()
    result = action()
    return result, perf_counter() - start


def repeat(run: Run, count: int) -> float:
    """Return the median time of `count` runs in seconds."""
    return float(np.median([run() for _ in range(count)]))


def in_turns(first: Run, second: Run, turns: int, block: float) -> np.ndarray:
    """Return `turns` ratios of the time of `first` to that of `second`, measured alternately.

    A load on the machine slows down both runs of a pair, so ratios scatter less than times. Short
    runs are repeated until one side of a pair takes about `block` seconds.
    """
    counts = []
    for run in (first, second):
        run()  # warm-up: this may compile
        seconds = run()
        counts.append(max(1, round(block / seconds)) if seconds > 0.0 else 1)

    def mean(run: Run, count: int) -> float:
        return sum(run() for _ in range(count)) / count

    return np.array([mean(first, counts[0]) / mean(second, counts[1]) for _ in range(turns)])


@contextmanager
def limit(seconds: float) -> Iterator[None]:
    """Raise TooLongError in the block after `seconds`; compiled code stops at its next step."""

    def stop(*_: Any) -> None:
        raise TooLongError

    before = signal.signal(signal.SIGALRM, stop)
    signal.setitimer(signal.ITIMER_REAL, seconds)
    try:
        yield
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0.0)
        signal.signal(signal.SIGALRM, before)
