"""What the processor time of this process was spent on: compiling, drawing, writing, and the rest.

Parts of the library say what they do while they do it. Where one does another's work meanwhile, as
a figure that is written, or a kernel that is compiled for a drawing, the first of KINDS counts.
"""

import os
import threading
import time
from contextlib import ContextDecorator

KINDS = ("compiling", "writing", "drawing")
REST = "computing"

SPENT = "spent: "
"""How the line of a log begins that says what processor time was spent on, in seconds, and the
largest memory, in megabytes."""
TOOK = "wall time: "
"""How the last line of a log begins, with the time of the whole job in seconds."""

_lock = threading.Lock()
_active = dict.fromkeys(KINDS, 0)
_seconds = dict.fromkeys((*KINDS, REST), 0.0)
_counted = 0.0


class spending(ContextDecorator):  # noqa: N801, a context and a decorator
    """Count the processor time of a block, or of each call of a function, as of this kind."""

    def __init__(self, kind: str):
        """`kind` is one of KINDS."""
        self._kind = kind

    def __enter__(self) -> None:
        """Begin."""
        begin(self._kind)

    def __exit__(self, *_) -> None:
        """End."""
        end(self._kind)


def begin(kind: str) -> None:
    """Count as of this kind from now on, also in other threads: a job computes in one at a time."""
    with _lock:
        _count()
        _active[kind] += 1


def end(kind: str) -> None:
    """End what `begin` began."""
    with _lock:
        _count()
        _active[kind] -= 1


def seconds() -> dict[str, float]:
    """Return the processor time of this process so far, by kind, in seconds."""
    with _lock:
        _count()
        return dict(_seconds)


def _count() -> None:
    global _counted
    now = time.process_time()
    kind = next((kind for kind in KINDS if _active[kind]), REST)
    _seconds[kind] += now - _counted
    _counted = now


def _begin_anew() -> None:
    global _counted, _lock
    _counted, _lock = 0.0, threading.Lock()
    _seconds.update(dict.fromkeys(_seconds, 0.0))


if hasattr(os, "register_at_fork"):  # Windows has no forks
    os.register_at_fork(after_in_child=_begin_anew)  # the time of a fork begins at zero
