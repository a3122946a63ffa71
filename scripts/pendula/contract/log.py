"""Run a job of the workflow, and log what it prints, why it failed and how long it took."""

import atexit
import gc
import os
import resource
import signal
import sys
import time
import traceback
from collections.abc import Callable
from contextlib import suppress
from types import TracebackType
from typing import Any, TextIO

STARTED = time.monotonic()
FAILED = "failed: "
"""The beginning of the reason of a failure in a log, above the traceback."""


def log_uncaught(
    kind: type[BaseException], error: BaseException, trace: TracebackType | None
) -> None:
    """Write to the job's log an error that was raised outside of `run`, such as by an import."""
    job = getattr(sys.modules["__main__"], "snakemake", None)
    if job is not None and issubclass(kind, Exception):
        reason = f"{FAILED}{kind.__name__}: {error}\n"
        with suppress(OSError), open(job.log[0], "w", encoding="utf-8") as log:
            log.writelines([reason, *traceback.format_exception(error)])
    sys.__excepthook__(kind, error, trace)


sys.excepthook = log_uncaught

from replication.logs import last_line  # noqa: E402, after the hook

# At exit Python would search a million objects for reference cycles, which takes 0.2 s in every
# job. While a job runs it would search after every few hundred new objects; a compiler creates
# millions, few of them in cycles.
atexit.register(gc.freeze)
gc.set_threshold(100_000)

SECONDS_BETWEEN_STEPS = 5.0
"""The screen shows at most one step of a long job in this time; its log has all steps."""
NO_LOG = os.EX_IOERR
"""Exit status of a job that failed and could not write the reason to its log."""
INTERRUPTED = 130
"""Exit status of a job that Ctrl-C ended, as in shells."""
PACKAGES = ("pendula", "latticode", "replication")
"""Packages whose error messages are logged without the name of the class."""


class _Output:
    """Standard output and error of a job: the screen, and a log, which may fail on a full disk."""

    def __init__(self, screen: TextIO, path: str) -> None:
        self.screen, self.file = screen, None
        with suppress(OSError):
            self.file = open(path, "w", encoding="utf-8")  # noqa: SIM115, closed by `close`
        self.shown = time.monotonic()

    def log(self, text: str) -> bool:
        """Write only to the log, and return whether this succeeded."""
        if self.file is None:
            return False
        try:
            self.file.write(text)
            self.file.flush()
        except OSError:
            return False
        return True

    def step(self, text: str) -> None:
        """Write to the log, and to the screen if it showed no step for a while."""
        if time.monotonic() - self.shown > SECONDS_BETWEEN_STEPS:
            self.shown = time.monotonic()
            self.write(text)
        else:
            self.log(text)

    def write(self, text: str) -> int:
        self.log(text)
        self.screen.write(text)
        self.screen.flush()
        return len(text)

    def flush(self) -> None:
        """Do nothing: `write` has flushed both."""

    def close(self) -> None:
        seconds = time.monotonic() - STARTED
        self.log(last_line(seconds, _peak_memory()))
        with suppress(OSError):
            if self.file:
                self.file.close()


def run(body: Callable[[Any], None], snakemake: Any) -> None:
    """Call `body` with Snakemake's object, with the rule's log as its standard output.

    If it fails, the job fails with status 1, and its log begins with the reason. The last line of
    each log has the wall time and the peak memory of the job.
    """
    # Slurm sends SIGTERM to a job at its time limit: treat it like Ctrl-C.
    signal.signal(signal.SIGTERM, signal.default_int_handler)
    output = sys.stdout = sys.stderr = _Output(sys.__stderr__, snakemake.log[0])
    try:
        body(snakemake)
    except Exception as error:
        reason = f"{FAILED}{message_of(error)}\n"
        if not output.log(reason + traceback.format_exc()):
            sys.__stderr__.write(reason)
            sys.exit(NO_LOG)
        sys.exit(1)
    except KeyboardInterrupt:
        print("interrupted: run the same command again to continue")
        output.log(traceback.format_exc())
        output.close()
        os._exit(INTERRUPTED)  # without waiting for a thread that compiles
    finally:
        sys.stdout, sys.stderr = sys.__stdout__, sys.__stderr__
        output.close()


def message_of(error: Exception) -> str:
    """Return the message of an error, with the name of its class unless PACKAGES raised it."""
    ours = type(error).__module__.startswith(PACKAGES)
    return str(error) if ours else f"{type(error).__name__}: {error}"


def _peak_memory() -> float:
    """Return the peak memory of this process, in MB."""
    unit = 1 if sys.platform == "darwin" else 1024  # bytes in a unit of getrusage
    return 1e-6 * unit * resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
