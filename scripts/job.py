"""Run functions of the library as a Snakemake job, and keep in its log all that they say.

The rule names the functions in `params.call`, and gives their arguments by name.
"""

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
from importlib import import_module
from pathlib import Path
from typing import Any

BEGAN = time.monotonic()
FAILED = "failed: "
"""How the reason of a failure begins in a log, above its traceback."""


def tell_uncaught(kind: type[BaseException], error: BaseException, trace) -> None:
    """Say in the log of a job what ended it before `run`, as an import that fails does."""
    job = getattr(sys.modules["__main__"], "snakemake", None)
    if job is not None and issubclass(kind, Exception):
        told = f"{FAILED}{kind.__name__}: {error}\n"
        with suppress(OSError), open(job.log[0], "w", encoding="utf-8") as log:
            log.writelines([told, *traceback.format_exception(error)])
    sys.__excepthook__(kind, error, trace)


sys.excepthook = tell_uncaught

from pendula.sources import SCRIPTS, TOOK  # noqa: E402

# When Python ends, it looks for cycles among a million objects that are about to go anyway. This
# would take a fifth of a second in every job. While a job runs, Python would look whenever some
# hundred objects are new: a compiler makes millions of them, and few of those are in cycles.
atexit.register(gc.freeze)
gc.set_threshold(100_000)

OFTEN = 5.0
"""Seconds between two steps that a long job shows on the screen; its log has all steps."""

NO_LOG = os.EX_IOERR
"""The exit status of a job that failed and could not write why to its log."""

INTERRUPTED = 130
"""The exit status of a job that Ctrl-C ended, as shells give it."""


class _Output:
    """What a job says: on the screen and in its log, which a full disk does not stop."""

    def __init__(self, screen, path: str):
        self.screen, self.file = screen, None
        with suppress(OSError):
            self.file = open(path, "w", encoding="utf-8")  # noqa: SIM115, closed by `close`
        self.shown = time.monotonic()

    def log(self, text: str) -> bool:
        """Write to the log alone; return whether the disk took it."""
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
        if time.monotonic() - self.shown > OFTEN:
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
        """All is written at once."""

    def close(self) -> None:
        self.log(f"{TOOK}{time.monotonic() - BEGAN:.1f} s, largest memory: {_memory():.0f} MB\n")
        with suppress(OSError):
            if self.file:
                self.file.close()


NO_ARGUMENTS = ("call", "code", "digests", "kernels", "given", "committed", "chunks", "chunk")
"""What is for Snakemake or a script alone, as hashes and the kernels that a job waits for, or
holds others."""


def arguments(snakemake) -> dict[str, Any]:
    """Return the named inputs and parameters of a rule, but for inputs that are an empty list.

    The parameter `given` holds more of them, which depend on the wildcards of the rule, and
    `committed` files of the project, each with its digest.
    """
    inputs = {name: value for name, value in snakemake.input.items() if value}
    params = dict(snakemake.params.items())
    kept = {name: _paths(files) for name, files in params.get("committed", {}).items()}
    found = {**inputs, **params, **params.get("given", {}), **kept}
    return {name: value for name, value in found.items() if name not in NO_ARGUMENTS}


def _paths(files: list) -> str | list[str]:
    """Return the path of one file of the project, given with its digest, or of several."""
    if files and isinstance(files[0], str):
        return str(SCRIPTS.parent / files[0])
    return [_paths(file) for file in files]


def datasets_in(value: Any) -> list[str]:
    """Return the paths of datasets that an argument consists of, none if it is something else."""
    paths = value if isinstance(value, list) else [value]
    return paths if all(isinstance(one, str) and one.endswith(".nc") for one in paths) else []


def name_of(path: str) -> str:
    """Return the name of a dataset: its path below the folder of results, or the project's."""
    place = Path(path).with_suffix("")
    if place.is_relative_to(SCRIPTS.parent):
        return place.relative_to(SCRIPTS.parent).as_posix()
    return Path(*place.parts[1:]).as_posix()


def called(snakemake) -> list[Callable]:
    """Return the functions that `params.call` names by their modules; its last entry is a hash."""
    names = [name.rpartition(".") for name in snakemake.params.call[:-1]]
    return [getattr(import_module(module), name) for module, _, name in names]


def run(body: Callable, snakemake) -> None:
    """Call `body` with Snakemake's object.

    Where it fails, so does the job, and its log says why, with the traceback. The last line of a
    log is the time that the job took and its largest memory.
    """
    # A cluster sends this signal to a job at its limit of time: then it acts as Ctrl-C does.
    signal.signal(signal.SIGTERM, signal.default_int_handler)
    said = sys.stdout = sys.stderr = _Output(sys.__stderr__, snakemake.log[0])
    try:
        body(snakemake)
    except Exception as error:
        told = f"{FAILED}{say(error)}\n"
        if not said.log(told + traceback.format_exc()):  # the end of the run tells what logs say
            sys.__stderr__.write(told)
            sys.exit(NO_LOG)
        sys.exit(1)
    except KeyboardInterrupt:
        print("interrupted: run the same command again to continue")
        said.log(traceback.format_exc())
        said.close()
        os._exit(INTERRUPTED)  # at once: a thread may be compiling, and is not waited for
    finally:
        sys.stdout, sys.stderr = sys.__stdout__, sys.__stderr__
        said.close()


def step(text: str) -> None:
    """Say how far a long job is: all steps stand in its log, and some on the screen."""
    if isinstance(sys.stdout, _Output):
        sys.stdout.step(f"{text}\n")
    else:
        print(text)


def say(error: Exception) -> str:
    """Return an error in words; one that is not ours is named too, since its words may be few."""
    ours = type(error).__module__.startswith(("pendula", "replication", "latticode"))
    return str(error) if ours else f"{type(error).__name__}: {error}"


def _memory() -> float:
    """Return the largest memory that this process has held so far, in MB."""
    unit = 1 if sys.platform == "darwin" else 1024  # of getrusage, in bytes
    return 1e-6 * unit * resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
