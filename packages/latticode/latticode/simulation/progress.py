"""A progress bar for work of more than two seconds, in a terminal or a notebook.

A thread checks the progress twice a second. It counts what the work stores anyway: the norms of a
run, or the finished runs of a survey. The work itself does nothing for the bar.
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
"""Seconds of work before a bar appears, and between two checks of the progress."""
OF_RUNS = "{desc}: {n_fmt} of {total_fmt} runs |{bar}| {elapsed}<{remaining}"
OF_TIME = "{desc}: {percentage:3.0f}% |{bar}| {elapsed}<{remaining}"
COMPILING = "{desc} {elapsed}"


class _Work:
    """Work in progress: how much of it is done, its total, and its bar if it is shown."""

    def __init__(self, name: str, runs: Sized | None, total: int) -> None:
        self.name, self.runs = name, runs
        self.lock, self.bar, self.is_over = threading.Lock(), None, False
        self.begun = monotonic()
        self.restart(name, (lambda: len(runs)) if runs is not None else None, total)

    def restart(self, label: str, done: Callable[[], int] | None, total: int) -> None:
        """Start counting again, for example the outputs of the next run."""
        self.label, self.done, self.total = label, done, total
        self.since, self.first = monotonic(), done() if done else 0
        self.close()

    def look(self) -> None:
        """Draw the bar if the work has lasted longer than DELAY."""
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
            from tqdm.auto import tqdm  # imported here: most work ends before it needs a bar

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
        """Remove the bar."""
        if self.bar is not None:
            self.bar.close()
            self.bar = None

    def end(self) -> None:
        """Remove the bar, and prevent the other thread from drawing it again."""
        with self.lock:
            self.is_over = True
            self.close()


class _Compilations:
    """Counter of the numba compilations in progress."""

    def __init__(self) -> None:
        self.running, self.is_listening = 0, False

    def listen(self) -> None:
        """Register with numba, unless already registered."""
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
"""The work whose progress is shown, at most one entry."""
_threads: list[threading.Thread] = []
"""The thread that draws the bars, once it has started."""

if hasattr(os, "register_at_fork"):  # Windows has no forks
    os.register_at_fork(after_in_child=lambda: (_at_work.clear(), _threads.clear()))


@contextmanager
def show_progress(name: str, runs: Sized | None = None, total: int = 1) -> Iterator[None]:
    """Show the progress of the work in the block after two seconds.

    `runs` is a container to which a survey adds its `total` runs; without it, each run in the block
    calls `follow`. On Ctrl-C raises Interrupted, which prints a single line.
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
    """Show the progress of a run as the share of `outputs` (time,) that it has written."""
    for work in _at_work:
        if work.runs is None:
            outputs.fill(np.nan)
            with work.lock:
                label = f"{work.name}: {label}"
                work.restart(label, lambda: np.count_nonzero(outputs == outputs), outputs.size)


def is_visible() -> bool:
    """Return whether stderr is a terminal, or the program runs in a notebook."""
    shell = sys.modules["IPython"].get_ipython() if "IPython" in sys.modules else None
    if shell is not None and "IPKernelApp" in shell.config:
        return True
    return sys.stderr is not None and sys.stderr.isatty()


def _look_at_work() -> None:
    while True:
        sleep(LOOK)
        for work in [*_at_work]:
            work.look()
