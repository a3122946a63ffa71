"""Compiled runs that Ctrl-C stops immediately.

Python handles signals in its main thread, and only between bytecodes. A compiled run is a single
bytecode that may take hours, and an interrupt during a compilation by LLVM may be lost. A worker
thread therefore executes the run, while the caller waits for it in Python. If the wait is
interrupted, the caller sets a flag, which the kernels read at every step. The incomplete results
are discarded.

Starting a thread takes as long as a short run, so workers are reused. Passing a run to a worker
takes up to half as long as a run of a short chain. For many runs, pass one function that executes
them all. Once a function is compiled, the main thread executes it. Python then writes each signal
to a file descriptor when it arrives. A second thread reads the descriptor and sets the flag.
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
    """Ctrl-C stopped some work; Python and Jupyter print its message without a traceback."""

    def __init__(self, *message: str) -> None:
        super().__init__(*message)
        if sys.excepthook is sys.__excepthook__:
            sys.excepthook = _print_message

    def _render_traceback_(self) -> list[str]:
        """Return the lines that IPython prints in place of a traceback."""
        return [str(self)]


def _print_message(kind: type[BaseException], error: BaseException, traceback: Any) -> None:
    if isinstance(error, Interrupted):
        print(error, file=sys.stderr)
    else:
        sys.__excepthook__(kind, error, traceback)


POLLING_INTERVAL = 0.1
"""Seconds between two checks of a waiting caller."""
PATIENCE = 0.5
"""Seconds that an interrupted caller waits for the run to stop; a compilation may take longer."""


class _Worker:
    """A thread that executes one run after another."""

    def __init__(self) -> None:
        self.runs, self.ends = SimpleQueue(), SimpleQueue()
        # a daemon thread, so that the interpreter can exit while the thread still compiles
        threading.Thread(target=self._work, daemon=True).start()

    def _work(self) -> None:
        while task := self.runs.get():
            _thread_state.stop = task[1][-1]
            end = _end_of(*task)
            del task  # frees the arrays of the run
            self.ends.put(end)
            del end


def _end_of(run: Callable, arguments: tuple) -> tuple[Any, BaseException | None]:
    try:
        return run(*arguments), None
    except BaseException as error:
        return None, error


class _Watch:
    """A thread that sets the flag of the main thread's run when an interrupt arrives."""

    CAUGHT_UP = b"\xff"  # differs from the number of every signal

    def __init__(self) -> None:
        self.stop: np.ndarray | None = None
        self._reads, self._written = socket.socketpair()
        self._written.setblocking(False)
        self._caught_up = SimpleQueue()
        threading.Thread(target=self._look, daemon=True).start()

    def descriptor(self) -> int:
        """Return the file descriptor for `signal.set_wakeup_fd`."""
        return self._written.fileno()

    def _look(self) -> None:
        while numbers := self._reads.recv(4096):
            if signal.SIGINT in numbers and self.stop is not None:
                self.stop[0] = True
            if self.CAUGHT_UP in numbers:
                self._caught_up.put(True)

    def catch_up(self) -> None:
        """Wait until all signals written so far are read, so none of them stops a later run."""
        self._written.send(self.CAUGHT_UP)
        self._caught_up.get()


_thread_state = threading.local()
"""In a worker: the flag of its current run."""
_idle: list[_Worker] = []
"""Workers without a run."""
_watch: list[_Watch] = []
"""The watch of the main thread, after its first run."""
_done: weakref.WeakSet[Callable] = weakref.WeakSet()
"""Functions that were called before, and are compiled at least for some types of arguments."""


def _forget_threads() -> None:
    """Clear the lists of threads in a forked process, which has none of its parent's threads."""
    _idle.clear()
    _watch.clear()


if hasattr(os, "register_at_fork"):  # Windows has no forks
    os.register_at_fork(after_in_child=_forget_threads)


def interruptible(run: Callable, *arguments: Any) -> Any:
    """Return run(*arguments, stop), a run that Ctrl-C can stop.

    The flag `stop` is an array of one boolean. `run` must release the GIL and read the flag at
    every step, or consist of calls of this function, which share one thread and flag. Raises the
    errors of the run, and KeyboardInterrupt if the caller or the main thread is interrupted.
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
    """Return whether this is the main thread, and no other code handles its interrupts."""
    if threading.current_thread() is not threading.main_thread():
        return False
    if signal.getsignal(signal.SIGINT) is not signal.default_int_handler:
        return False
    descriptor = signal.set_wakeup_fd(-1)  # the only way to read the current descriptor
    if descriptor != -1:
        signal.set_wakeup_fd(descriptor)
    return descriptor == -1


def _run_watched(run: Callable, arguments: tuple) -> Any:
    """Return run(*arguments, stop), called in this thread while the watch waits for Ctrl-C.

    During the run an interrupt only sets the flag. An exception would abort Python if it were
    raised while numba converts the result of a kernel.
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
        # in this order, the handler above has set the flag for each signal in the descriptor
        signal.set_wakeup_fd(-1)
        signal.signal(signal.SIGINT, signal.default_int_handler)
        if stop[0]:
            watch.catch_up()
            raise KeyboardInterrupt


def _run_by_worker(run: Callable, arguments: tuple) -> Any:
    """Return run(*arguments, stop), called in a worker while this thread waits for it."""
    stop, worker = np.zeros(1, np.bool_), None
    try:
        worker = _idle_worker()
        worker.runs.put((run, (*arguments, stop)))
        result, error = _wait(worker.ends)
    except BaseException:
        stop[0] = True
        if worker is not None:
            worker.runs.put(None)  # ends the worker after its run, which may take long
            with suppress(Empty):
                worker.ends.get(timeout=PATIENCE)
        raise
    _idle.append(worker)
    if error is not None:
        raise error
    return result


def _idle_worker() -> _Worker:
    try:
        return _idle.pop()
    except IndexError:
        return _Worker()


def _wait(ends: SimpleQueue) -> tuple[Any, BaseException | None]:
    while True:
        try:
            return ends.get(timeout=POLLING_INTERVAL)
        except Empty:
            if _main_thread_is_interrupted():
                raise KeyboardInterrupt from None


def _main_thread_is_interrupted() -> bool:
    """Return whether the main thread is handling a KeyboardInterrupt.

    Python raises KeyboardInterrupt only in the main thread. If the main thread then leaves a pool
    of threads, it waits for the runs of the pool. These runs must therefore stop by themselves.
    """
    main = threading.main_thread()
    if main is threading.current_thread():
        return False
    handled = sys._current_exceptions().get(main.ident)
    handled = handled[1] if isinstance(handled, tuple) else handled  # a tuple in Python 3.11
    return isinstance(handled, KeyboardInterrupt)
