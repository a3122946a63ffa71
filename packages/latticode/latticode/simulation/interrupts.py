"""Compiled runs that Ctrl-C ends at once.

Python tells its main thread of an interrupt between two of its own instructions. A compiled run is
a single instruction that may take hours, and an interrupt that comes while LLVM compiles may be
lost altogether. So another thread does the run, and the caller waits for it in Python. Where the
wait is interrupted, the caller raises a flag, which the kernels read at every step. What the run
has written by then is dropped, so that nobody sees half of a result.

A thread that has done a run waits for the next one: to start one takes as long as a short run.
To hand over a run costs time too: who makes many runs hands over a function that makes them all.
"""

import os
import sys
import threading
from collections.abc import Callable
from contextlib import suppress
from queue import Empty, SimpleQueue
from typing import Any

import numpy as np

LOOK = 0.1
"""Seconds between two looks of a waiting caller at what happened meanwhile."""
PATIENCE = 0.5
"""Seconds that an interrupted caller waits for the end of a step; compilation may take longer."""


class _Worker:
    """A thread that does one run after another."""

    def __init__(self):
        self.runs, self.ends = SimpleQueue(), SimpleQueue()
        # A daemon thread, so that the interpreter can leave while that thread still compiles.
        threading.Thread(target=self._work, daemon=True).start()

    def _work(self) -> None:
        while task := self.runs.get():
            _here.stop = task[1][-1]
            end = _end_of(*task)
            del task  # arrays of a run that is over
            self.ends.put(end)
            del end


def _end_of(run: Callable, arguments: tuple) -> tuple[Any, BaseException | None]:
    try:
        return run(*arguments), None
    except BaseException as fault:
        return None, fault


_here = threading.local()
"""In a worker: the flag of the run that it does."""
_idle: list[_Worker] = []
"""Workers that wait for a run. A fork has none of the threads of its parent."""
if hasattr(os, "register_at_fork"):  # Windows has no forks
    os.register_at_fork(after_in_child=_idle.clear)


def interruptible(run: Callable, *arguments) -> Any:
    """Return run(*arguments, stop), a run that ends when the flag `stop` is raised.

    `stop` is an array of one boolean; `run` releases the GIL and reads the flag at every step, or
    calls this function for such runs, which share its thread and flag. Raises whatever the run
    raises, and KeyboardInterrupt if the caller is interrupted meanwhile, or if it is one of many
    threads and the main thread is interrupted.
    """
    stop = getattr(_here, "stop", None)
    if stop is not None:
        result = run(*arguments, stop)
        if stop[0]:
            raise KeyboardInterrupt
        return result
    stop, worker = np.zeros(1, np.bool_), None
    try:
        worker = _take()
        worker.runs.put((run, (*arguments, stop)))
        result, fault = _wait(worker.ends)
    except BaseException:
        stop[0] = True
        if worker is not None:
            worker.runs.put(None)  # it may be busy for long: others get another one
            with suppress(Empty):
                worker.ends.get(timeout=PATIENCE)
        raise
    _idle.append(worker)
    if fault is not None:
        raise fault
    return result


def _take() -> _Worker:
    try:
        return _idle.pop()
    except IndexError:
        return _Worker()


def _wait(ends: SimpleQueue) -> tuple[Any, BaseException | None]:
    while True:
        try:
            return ends.get(timeout=LOOK)
        except Empty:
            if _main_thread_is_interrupted():
                raise KeyboardInterrupt from None


def _main_thread_is_interrupted() -> bool:
    """Return whether the main thread is leaving some block because of Ctrl-C.

    Python tells nobody but the main thread. A pool of threads that it leaves waits for its runs,
    which would go on to their ends.
    """
    main = threading.main_thread()
    if main is threading.current_thread():
        return False
    handled = sys._current_exceptions().get(main.ident)
    handled = handled[1] if isinstance(handled, tuple) else handled  # as Python 3.11 gives it
    return isinstance(handled, KeyboardInterrupt)
