"""Compiled runs that Ctrl-C ends at once.

Python tells its main thread of an interrupt between two of its own instructions. A compiled run is
a single instruction that may take hours, and an interrupt that comes while LLVM compiles may be
lost altogether. So the run gets a thread of its own, and the caller waits for it in Python. Where
the wait is interrupted, the caller raises a flag, which the kernels read at every step. What the
run has written by then is dropped, so that nobody sees half of a result.
"""

import sys
import threading
from collections.abc import Callable
from typing import Any

import numpy as np

LOOK = 0.1
"""Seconds between two looks of a waiting caller at what happened meanwhile."""
PATIENCE = 0.5
"""Seconds that an interrupted caller waits for the end of a step; compilation may take longer."""


def interruptible(run: Callable, *arguments) -> Any:
    """Return run(*arguments, stop), a run that ends when the flag `stop` is raised.

    `stop` is an array of one boolean; `run` releases the GIL and reads the flag at every step.
    Raises whatever the run raises, and KeyboardInterrupt if the caller is interrupted meanwhile, or
    if it is one of many threads and the main thread is interrupted.
    """
    stop = np.zeros(1, np.bool_)
    results, faults = [], []

    def work() -> None:
        try:
            results.append(run(*arguments, stop))
        except BaseException as fault:
            faults.append(fault)

    # A daemon thread, so that the interpreter can leave while that thread still compiles.
    thread = threading.Thread(target=work, daemon=True)
    try:
        thread.start()
        while thread.is_alive():
            thread.join(LOOK)
            if _main_thread_is_interrupted():
                raise KeyboardInterrupt
    except BaseException:
        stop[0] = True
        if thread.is_alive():  # not so if it never started
            thread.join(PATIENCE)
        raise
    for fault in faults:
        raise fault
    return results[0]


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
