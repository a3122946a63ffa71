"""Starts the process that forks jobs, and asks it for them. Nothing here calls Snakemake."""

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
INTERRUPTED = 128 + signal.SIGINT
"""The exit status of what Ctrl-C ended."""
LOOKS = ("-n", "--dry", "--list", "--lint", "--dag", "--rulegraph", "--summary", "--unlock")
"""How options begin with which Snakemake runs no job: then the imports need not begin early."""
LIBRARIES = ("OMP_NUM", "GOTO_NUM", "OPENBLAS_NUM", "MKL_NUM", "VECLIB_MAXIMUM", "NUMEXPR_NUM")
THREADS = {f"{library}_THREADS": "1" for library in LIBRARIES}
"""What Snakemake tells a job of one thread."""
PLACES = {"TMPDIR", "TMP", "TEMPDIR", "TEMP"}
"""Where Snakemake tells a job to put temporary files. No module reads this at its import."""


class RefusedError(Exception):
    """A job must start by itself; the message says why."""


class Forks:
    """The process that forks jobs."""

    process, interrupted = None, False

    def __init__(self, modules: list[str]):
        """Start the process, which imports `modules`, unless Snakemake is asked only to look."""
        self.modules = modules
        if sys.platform == "linux" and not any(word.startswith(LOOKS) for word in sys.argv):
            self._start()
        if signal.getsignal(signal.SIGINT) is signal.default_int_handler:
            signal.signal(signal.SIGINT, self._interrupt)

    def _start(self) -> None:
        self.environment = {**os.environ, **THREADS}
        self.control, theirs = socket.socketpair(socket.AF_UNIX, socket.SOCK_SEQPACKET)
        with theirs:
            self.process = subprocess.Popen(
                [sys.executable, str(SERVER), str(theirs.fileno()), *self.modules],
                pass_fds=[theirs.fileno()],
                env=self.environment,
                start_new_session=True,  # Ctrl-C is for Snakemake, which ends the jobs
            )
        atexit.register(self.end)

    def _interrupt(self, number, frame) -> None:
        """End Snakemake at Ctrl-C without a traceback; another Ctrl-C changes nothing."""
        signal.signal(signal.SIGINT, signal.SIG_IGN)
        self.interrupted = True
        if self.process:
            self.control.close()  # which ends all jobs
        raise SystemExit(INTERRUPTED)

    def changed(self) -> list[str]:
        """Return the variables that are no longer what they were when the imports began."""
        now, then = {**os.environ, **THREADS}, self.environment
        free = PLACES | {"PYTHONPATH"} - then.keys()
        return sorted(name for name in {*now, *then} - free if now.get(name) != then.get(name))

    def get_ready(self) -> None:
        """Tell the process where jobs run, now that the workflow is known."""
        if sys.platform != "linux":
            return
        if not self.process or self.changed():
            self.end()
            self._start()
        os.umask(mask := os.umask(0))
        path = os.environ.get("PYTHONPATH", "")
        self._send({"folder": os.getcwd(), "mask": mask, "path": path})

    def fork(self, script: str, place: str | None) -> tuple[int, socket.socket]:
        """Return the number of a process that runs `script`, once its socket is shut down."""
        if not self.process:
            raise RefusedError(f"forks are not safe on {sys.platform}")
        if changed := self.changed():
            raise RefusedError(f"the workflow has changed {', '.join(changed)}")
        environment = dict.fromkeys(PLACES, place) if place else {}
        job, theirs = socket.socketpair(socket.AF_UNIX, socket.SOCK_SEQPACKET)
        with theirs:
            self._send({"script": os.path.abspath(script), "environment": environment}, theirs)
        answer = self.hear(job)
        if not answer.isdigit():
            raise RefusedError(answer)
        return int(answer), job

    def hear(self, job: socket.socket) -> str:
        """Return the next thing that the process says of a job."""
        return job.recv(LETTER).decode() or self._complain()

    def _send(self, what: dict, *streams: socket.socket) -> None:
        try:
            fds = [stream.fileno() for stream in streams]
            socket.send_fds(self.control, [json.dumps(what).encode()], fds)
        except OSError:
            self._complain()

    def _complain(self):
        self.end()
        how = in_words(self.process.returncode)
        raise ChildProcessError(f"the process that jobs are forked from {how}")

    def end(self) -> None:
        """End the process and its jobs, which get a moment for it if Ctrl-C ends them."""
        if self.process and self.process.returncode is None:
            self.control.close()
            if not self.interrupted:
                with suppress(ProcessLookupError):  # another thread was faster
                    os.killpg(self.process.pid, signal.SIGKILL)
            self.process.wait()


def in_words(status: int) -> str:
    """Say how a process ended that should not have."""
    if status >= 0:
        return f"ended with exit status {status}"
    hint = ": out of memory?" if status == -signal.SIGKILL else ""
    return f"was killed by signal {-status} ({signal.Signals(-status).name}){hint}"
