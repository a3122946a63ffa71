"""Compiled runs that Ctrl-C ends at once.

Python tells its main thread of an interrupt between two of its own instructions. A compiled run is
a single instruction that may take hours, and an interrupt that comes while LLVM compiles may be
lost altogether. So another thread does the run, and the caller waits for it in Python. Where the
wait is interrupted, the caller raises a flag, which the kernels read at every step. What the run
has written by then is dropped, so that nobody sees half of a result.

A thread that has done a run waits for the next one: to start one takes as long as a short run.
To hand over a run costs time too: who makes many runs hands over a function that makes them all.

Between two cores the handing over takes up to half as long as a run of a short chain. So the main
thread does a run by itself if that run is compiled already, and then the other thread waits: for
the descriptor to which Python writes every signal at once, whatever the main thread does.
"""

import os
import signal
import socket
import sys
import threading
import weakref
from collections.abc import Callable
from contextlib import suppress
from queue import Empty, SimpleQueue
from typing import Any

import numpy as np


class Interrupted(KeyboardInterrupt):
    """Work that Ctrl-C ended. Python and Jupyter show it as one line, without a traceback."""

    def __init__(self, *words: str) -> None:
        super().__init__(*words)
        if sys.excepthook is sys.__excepthook__:
            sys.excepthook = _show_in_a_line

    def _render_traceback_(self) -> list[str]:
        """Return what IPython shows."""
        return [str(self)]


def _show_in_a_line(kind: type[BaseException], error: BaseException, traceback: Any) -> None:
    if isinstance(error, Interrupted):
        print(error, file=sys.stderr)
    else:
        sys.__excepthook__(kind, error, traceback)


LOOK = 0.1
"""Seconds between two looks of a waiting caller at what happened meanwhile."""
PATIENCE = 0.5
"""Seconds that an interrupted caller waits for the end of a step; compilation may take longer."""


class _Worker:
    """A thread that does one run after another."""

    def __init__(self) -> None:
        self.runs, self.ends = SimpleQueue(), SimpleQueue()
        # A daemon thread, so that the interpreter can leave while that thread still compiles.
        threading.Thread(target=self._work, daemon=True).start()

    def _work(self) -> None:
        while task := self.runs.get():
            _thread_state.stop = task[1][-1]
            end = _end_of(*task)
            del task  # arrays of a run that is over
            self.ends.put(end)
            del end


def _end_of(run: Callable, arguments: tuple) -> tuple[Any, BaseException | None]:
    try:
        return run(*arguments), None
    except BaseException as fault:
        return None, fault


class _Watch:
    """A thread that raises the flag of the main thread's run when Python writes an interrupt."""

    CAUGHT_UP = b"\xff"  # no number of a signal

    def __init__(self) -> None:
        self.stop: np.ndarray | None = None
        self._reads, self._written = socket.socketpair()
        self._written.setblocking(False)
        self._caught_up = SimpleQueue()
        threading.Thread(target=self._look, daemon=True).start()

    def descriptor(self) -> int:
        """Return where Python shall write its signals."""
        return self._written.fileno()

    def _look(self) -> None:
        while numbers := self._reads.recv(4096):
            if signal.SIGINT in numbers and self.stop is not None:
                self.stop[0] = True
            if self.CAUGHT_UP in numbers:
                self._caught_up.put(True)

    def catch_up(self) -> None:
        """Return when all that was written is read, so that it raises the flag of no later run."""
        self._written.send(self.CAUGHT_UP)
        self._caught_up.get()


_thread_state = threading.local()
"""In a worker: the flag of the run that it does."""
_idle: list[_Worker] = []
"""Workers that wait for a run."""
_watch: list[_Watch] = []
"""What watches the main thread's runs, if it has done any."""
_done: weakref.WeakSet[Callable] = weakref.WeakSet()
"""Functions that were called before. For arguments of other types one may still be compiled."""


def _forget_threads() -> None:
    """A fork has none of the threads of its parent."""
    _idle.clear()
    _watch.clear()


if hasattr(os, "register_at_fork"):  # Windows has no forks
    os.register_at_fork(after_in_child=_forget_threads)


def interruptible(run: Callable, *arguments: Any) -> Any:
    """Return run(*arguments, stop), a run that ends when the flag `stop` is raised.

    `stop` is an array of one boolean; `run` releases the GIL and reads the flag at every step, or
    calls this function for such runs, which share its thread and flag. Raises whatever the run
    raises, and KeyboardInterrupt if the caller is interrupted meanwhile, or if it is one of many
    threads and the main thread is interrupted.
    """
    stop = getattr(_thread_state, "stop", None)
    if stop is not None:
        result = run(*arguments, stop)
        if stop[0]:
            raise KeyboardInterrupt
        return result
    if run in _done and _can_be_watched():
        return _run_watched(run, arguments)
    result = _run_by_worker(run, arguments)
    _done.add(run)
    return result


def _can_be_watched() -> bool:
    """Return whether this is the main thread, and nobody else has taken its interrupts."""
    if threading.current_thread() is not threading.main_thread():
        return False
    if signal.getsignal(signal.SIGINT) is not signal.default_int_handler:
        return False
    descriptor = signal.set_wakeup_fd(-1)  # there is no other way to ask
    if descriptor != -1:
        signal.set_wakeup_fd(descriptor)
    return descriptor == -1


def _run_watched(run: Callable, arguments: tuple) -> Any:
    """Return run(*arguments, stop), which this thread calls, while another waits for Ctrl-C.

    Meanwhile an interrupt raises the flag alone: numba kills Python where it raises an exception in
    a kernel that makes its result.
    """
    if not _watch:
        _watch.append(_Watch())
    watch, stop = _watch[0], np.zeros(1, np.bool_)
    signal.signal(signal.SIGINT, lambda number, frame: stop.fill(True))
    try:
        watch.stop = stop
        signal.set_wakeup_fd(watch.descriptor(), warn_on_full_buffer=False)
        return run(*arguments, stop)
    finally:
        # in this order: whatever was written to the descriptor has raised the flag here as well
        signal.set_wakeup_fd(-1)
        signal.signal(signal.SIGINT, signal.default_int_handler)
        if stop[0]:
            watch.catch_up()
            raise KeyboardInterrupt


def _run_by_worker(run: Callable, arguments: tuple) -> Any:
    """Return run(*arguments, stop), which another thread calls, while this one waits for it."""
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
