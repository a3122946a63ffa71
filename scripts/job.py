"""Run one public function as a Snakemake job: plain arguments in, everything said into the log."""

import atexit
import gc
import sys
import time
import traceback
from collections.abc import Callable

import psutil

# When Python ends, it looks for cycles among a million objects that are about to go anyway. This
# would take a fifth of a second in every job.
atexit.register(gc.freeze)

TOOK = "wall time: "
"""How the last line of a log begins."""


class _Tee:
    """Write to the screen and to the log at once."""

    def __init__(self, *streams):
        self.streams = streams

    def write(self, text: str) -> int:
        for stream in self.streams:
            stream.write(text)
            stream.flush()
        return len(text)

    def flush(self) -> None:
        for stream in self.streams:
            stream.flush()


def run(function: Callable, snakemake) -> None:
    """Call `function` with the rule's named input, output and params as keyword arguments.

    `code`, the record of the modules that the job depends on, is for Snakemake alone. A traceback
    goes to the screen and to the rule's log, and the job fails. The last line of a log is the time
    that the job took, its start included; it stands in no dataset, for two runs differ in it.
    """
    arguments = {
        **dict(snakemake.input.items()),
        **dict(snakemake.output.items()),
        **dict(snakemake.params.items()),
    }
    arguments.pop("code", None)
    with open(snakemake.log[0], "w", encoding="utf-8") as log:
        sys.stdout = sys.stderr = _Tee(sys.__stderr__, log)
        try:
            function(**arguments)
        except Exception:
            traceback.print_exc()
            sys.exit(1)
        finally:
            sys.stdout, sys.stderr = sys.__stdout__, sys.__stderr__
            log.write(f"{TOOK}{time.time() - psutil.Process().create_time():.1f} s\n")
