"""Starts the process that forks jobs, and sends it requests. Nothing here calls Snakemake."""

import atexit
import json
import os
import signal
import socket
import subprocess
import sys
from contextlib import suppress
from pathlib import Path

SERVER = Path(__file__).with_name("server.py")
LETTER = 65536
"""Bytes that are more than any message has."""
PATH = "PYTHONPATH"
INTERRUPTED = 128 + signal.SIGINT
"""The exit status after Ctrl-C."""
LIBRARIES = ("OMP_NUM", "GOTO_NUM", "OPENBLAS_NUM", "MKL_NUM", "VECLIB_MAXIMUM", "NUMEXPR_NUM")
THREADS = {f"{library}_THREADS": "1" for library in LIBRARIES}
"""The environment variables that Snakemake sets for a job of one thread."""
LOOKS = {"-n", "--dry-run", "--dryrun"}
"""What a command line has that runs no job."""
PLACES = ("TMPDIR", "TMP", "TEMPDIR", "TEMP")
"""Those that it sets to the folder for temporary files. No module reads them at its import."""


class RefusedError(Exception):
    """A job cannot be a fork; the message says why."""


class Forks:
    """The process that forks jobs."""

    process, begun, interrupted = None, False, False

    def __init__(self, modules: list[str]):
        """Start the process, which imports modules; from now on Ctrl-C shows no traceback.

        A dry run, where Snakemake shall be quick and needs no module, starts none.
        """
        self.modules = modules
        if signal.getsignal(signal.SIGINT) is signal.default_int_handler:
            signal.signal(signal.SIGINT, self._interrupt)
        if sys.platform == "linux" and not LOOKS.intersection(sys.argv):
            self.start()
            atexit.register(self.end)

    def _interrupt(self, number, frame) -> None:
        signal.signal(signal.SIGINT, signal.SIG_IGN)
        self.interrupted = True
        if self.process:
            self.control.close()  # which ends all jobs
        raise SystemExit(INTERRUPTED)

    def start(self) -> None:
        """Start the process, with the environment as it is now."""
        self.found = surroundings()
        self.control, theirs = socket.socketpair(socket.AF_UNIX, socket.SOCK_SEQPACKET)
        with theirs:
            self.process = subprocess.Popen(
                [sys.executable, str(SERVER), str(theirs.fileno()), *self.modules],
                pass_fds=[theirs.fileno()],
                env={**os.environ, **THREADS},
                start_new_session=True,  # Ctrl-C is for Snakemake, which ends the jobs
            )

    def begin(self) -> None:
        """Tell the process, before the first job, where the workflow has its modules.

        If the workflow has set more than PYTHONPATH, the imports begin anew.
        """
        if not self.process or self.begun:
            return
        self.begun = True
        path = "" if PATH in self.found[1] else os.environ.get(PATH, "")
        if surroundings(without=path and PATH) != self.found:
            self.end()
            self.start()
            path = ""
        with suppress(OSError):  # it has ended, as the first job will hear
            self.control.send(json.dumps(path).encode())

    def fork(self, script: str, place: str | None) -> tuple[int, socket.socket]:
        """Return the number of a process that runs `script`, once its socket is shut down."""
        if not self.process:
            raise RefusedError(f"forks are not safe on {sys.platform}")
        environment = dict.fromkeys(PLACES, place) if place else {}
        job, theirs = socket.socketpair(socket.AF_UNIX, socket.SOCK_SEQPACKET)
        request = json.dumps({"script": os.path.abspath(script), "environment": environment})
        with theirs, suppress(OSError):  # if the process has ended, there is no answer
            socket.send_fds(self.control, [request.encode()], [theirs.fileno()])
        answer = self.hear(job)
        if not answer.isdigit():
            raise RefusedError(answer)
        return int(answer), job

    def hear(self, job: socket.socket) -> str:
        """Return the next message of the process on a job."""
        if message := job.recv(LETTER).decode():
            return message
        self.end()
        how = in_words(self.process.returncode)
        raise ChildProcessError(f"the process that jobs are forked from {how}")

    def end(self) -> None:
        """End the process and its jobs, which have a moment for it after Ctrl-C."""
        if self.process and self.process.returncode is None:
            self.control.close()
            if not self.interrupted:
                with suppress(ProcessLookupError):  # another thread was faster
                    os.killpg(self.process.pid, signal.SIGKILL)
            self.process.wait()


def surroundings(without: str = "") -> tuple[str, dict[str, str]]:
    """Return what a module may read at its import: the folder, and all other variables."""
    return os.getcwd(), {name: text for name, text in os.environ.items() if name != without}


def in_words(status: int) -> str:
    """Say how a process ended that should not have."""
    if status >= 0:
        return f"ended with exit status {status}"
    hint = ": out of memory?" if status == -signal.SIGKILL else ""
    return f"was killed by signal {-status} ({signal.Signals(-status).name}){hint}"
