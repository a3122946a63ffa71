"""A bar for work of more than two seconds, in a terminal or a notebook and never in a file.

A thread looks twice a second how far the work is. What is at work pays nothing for it: a run fills
its array of norms anyway, and a survey its table of runs.
"""

import os
import sys
import threading
from collections.abc import Callable, Iterator, Sized
from contextlib import contextmanager
from time import monotonic, sleep
from typing import Any

import numpy as np

from .interrupts import Interrupted

DELAY, LOOK = 2.0, 0.5
"""Seconds of work before a bar is shown, and between two looks at the work."""
OF_RUNS = "{desc}: {n_fmt} of {total_fmt} runs |{bar}| {elapsed}<{remaining}"
OF_TIME = "{desc}: {percentage:3.0f}% |{bar}| {elapsed}<{remaining}"
COMPILING = "{desc} {elapsed}"


class _Work:
    """What is at work: how much of it is done, of how much, and its bar if there is one."""

    def __init__(self, name: str, runs: Sized | None, total: int):
        self.name, self.runs = name, runs
        self.lock, self.bar, self.is_over = threading.Lock(), None, False
        self.begun = monotonic()
        self.restart(name, (lambda: len(runs)) if runs is not None else None, total)

    def restart(self, label: str, done: Callable[[], int] | None, total: int) -> None:
        """Begin to count anew, such as the outputs of the next run of several."""
        self.label, self.done, self.total = label, done, total
        self.since, self.first = monotonic(), done() if done else 0
        self.close()

    def look(self) -> None:
        """Draw how far the work is, if it has lasted long enough."""
        with self.lock:
            if self.is_over or monotonic() - self.begun < DELAY:
                return
            if compilations.running:
                self._draw(f"{self.name}: compiling the equations", 0, None, COMPILING)
                self.since = monotonic()
            elif self.done is not None:
                bar_format = OF_TIME if self.runs is None else OF_RUNS
                self._draw(self.label, self.done(), self.total, bar_format)

    def _draw(self, label: str, done: int, total: int | None, bar_format: str) -> None:
        if self.bar is not None and self.bar.desc != label:
            self.close()
        if self.bar is None:
            from tqdm.auto import tqdm  # here: most work is over before it needs a bar

            self.bar = tqdm(
                desc=label,
                total=total,
                bar_format=bar_format,
                leave=False,
                smoothing=0,
                initial=self.first if total else 0,
            )
            self.bar.desc = label  # tqdm adds a colon
            self.bar.start_t -= monotonic() - self.since
        self.bar.n = done
        self.bar.refresh()

    def close(self) -> None:
        """Take the bar away."""
        if self.bar is not None:
            self.bar.close()
            self.bar = None

    def end(self) -> None:
        """Take the bar away, and let no other thread draw it again."""
        with self.lock:
            self.is_over = True
            self.close()


class _Compilations:
    """Counts the compilations of numba that are under way."""

    def __init__(self):
        self.running, self.is_listening = 0, False

    def listen(self) -> None:
        """Begin to count, if that is not done yet."""
        if not self.is_listening:
            from numba.core import event

            self.is_listening = True
            counter = self

            class Listener(event.Listener):
                def on_start(self, event: Any) -> None:
                    counter.running += 1

                def on_end(self, event: Any) -> None:
                    counter.running -= 1

            event.register("numba:compile", Listener())


compilations = _Compilations()
_at_work: list[_Work] = []
"""The work whose progress is shown, if there is any."""
_threads: list[threading.Thread] = []
"""The thread that looks at the work, once there was any."""

if hasattr(os, "register_at_fork"):  # Windows has no forks
    os.register_at_fork(after_in_child=lambda: (_at_work.clear(), _threads.clear()))


@contextmanager
def show_progress(name: str, runs: Sized | None = None, total: int = 1) -> Iterator[None]:
    """Show how far the work of the block is, after two seconds, and end it in a line on Ctrl-C.

    `runs` fills with the `total` runs of a survey; other work is a run, or some one after another,
    which call `follow`. Raises Interrupted on Ctrl-C.
    """
    work = None
    if not _at_work and is_visible():
        compilations.listen()
        work = _Work(name, runs, total)
        _at_work.append(work)
        if not _threads:
            _threads.append(threading.Thread(target=_look_at_work, daemon=True))
            _threads[0].start()
    try:
        yield
    except Interrupted:
        raise
    except KeyboardInterrupt:
        raise Interrupted(f"{name} was interrupted") from None
    finally:
        if work is not None:
            _at_work.remove(work)
            work.end()


def follow(outputs: np.ndarray, label: str) -> None:
    """Count as done what a run has written of its outputs, (time,), if its progress is shown."""
    for work in _at_work:
        if work.runs is None:
            outputs.fill(np.nan)
            with work.lock:
                label = f"{work.name}: {label}"
                work.restart(label, lambda: np.count_nonzero(outputs == outputs), outputs.size)


def is_visible() -> bool:
    """Return whether somebody would see a bar: in a terminal or a notebook, not in a file."""
    shell = sys.modules["IPython"].get_ipython() if "IPython" in sys.modules else None
    if shell is not None and "IPKernelApp" in shell.config:
        return True
    return sys.stderr is not None and sys.stderr.isatty()


def _look_at_work() -> None:
    while True:
        sleep(LOOK)
        for work in [*_at_work]:
            work.look()
