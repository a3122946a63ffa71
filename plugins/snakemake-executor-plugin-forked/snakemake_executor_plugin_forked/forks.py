"""Starts the process that forks jobs, and asks it for them. Nothing here knows Snakemake."""

import atexit
import json
import os
import signal
import socket
import subprocess
import sys
from pathlib import Path
from threading import Event

SERVER = Path(__file__).with_name("server.py")
LETTER = 65536
INTERRUPTED = 128 + signal.SIGINT
"""The exit status of what Ctrl-C ended."""
KEPT = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP, signal.SIGQUIT)
LIBRARIES = ("OMP_NUM", "GOTO_NUM", "OPENBLAS_NUM", "MKL_NUM", "VECLIB_MAXIMUM", "NUMEXPR_NUM")
THREADS = {f"{library}_THREADS": "1" for library in LIBRARIES}
"""What Snakemake tells a job of one thread."""
PLACES = {"TMPDIR", "TMP", "TEMPDIR", "TEMP"}
"""Where Snakemake tells a job to put temporary files. No module reads this at its import."""


class RefusedError(Exception):
    """A job must start by itself; the message says why."""


class EndedError(Exception):
    """The process that forks jobs has ended; the message says how."""


class Forks:
    """The process that forks jobs."""

    process = None

    def __init__(self, modules: list[str]):
        """Start the process where forks are safe; it imports `modules`."""
        self.modules, self.environment = modules, {**os.environ, **THREADS}
        self.interrupted = Event()
        if sys.platform != "linux":
            return
        self.control, theirs = socket.socketpair(socket.AF_UNIX, socket.SOCK_SEQPACKET)
        before = signal.pthread_sigmask(signal.SIG_BLOCK, KEPT)  # it never hears Ctrl-C
        with theirs:
            command = [sys.executable, str(SERVER), str(theirs.fileno()), *modules]
            fds = [theirs.fileno()]
            self.process = subprocess.Popen(command, pass_fds=fds, env=self.environment)
        signal.pthread_sigmask(signal.SIG_SETMASK, before)
        atexit.register(self.end)
        if signal.getsignal(signal.SIGINT) is signal.default_int_handler:
            signal.signal(signal.SIGINT, self.interrupt)

    def interrupt(self, number, frame) -> None:
        """End Snakemake at Ctrl-C without a traceback; another Ctrl-C changes nothing."""
        signal.signal(signal.SIGINT, signal.SIG_IGN)
        self.interrupted.set()
        print("\ninterrupted: the same command goes on from here", file=sys.stderr, flush=True)
        raise SystemExit(INTERRUPTED)

    def changed(self) -> list[str]:
        """Return the variables that are no longer what they were when the imports began."""
        now, then = {**os.environ, **THREADS}, self.environment
        free = PLACES | {"PYTHONPATH"} - then.keys()
        return sorted(name for name in {*now, *then} - free if now.get(name) != then.get(name))

    def get_ready(self) -> None:
        """Tell the process where jobs run, now that the workflow is known."""
        if self.process and self.changed():
            self.end()
            self.__init__(self.modules)
        mask = os.umask(0)
        os.umask(mask)
        if self.process:
            path = os.environ.get("PYTHONPATH", "")
            self._send({"folder": os.getcwd(), "mask": mask, "path": path})

    def fork(self, script: str, place: str | None) -> tuple[int, socket.socket]:
        """Return the number of a process, and where it is told to run `script`."""
        if not self.process:
            raise RefusedError(f"forks are not safe on {sys.platform}")
        if changed := self.changed():
            raise RefusedError(f"the workflow has changed {', '.join(changed)}")
        environment = dict.fromkeys(PLACES, place) if place else {}
        asked, theirs = socket.socketpair(socket.AF_UNIX, socket.SOCK_SEQPACKET)
        with theirs:
            self._send({"script": os.path.abspath(script), "environment": environment}, theirs)
        answer = self.hear(asked)
        if not answer.isdigit():
            raise RefusedError(answer)
        return int(answer), asked

    def hear(self, asked: socket.socket) -> str:
        """Return the next thing that the process says."""
        try:
            said = asked.recv(LETTER)
        except ConnectionResetError:  # the job was killed before it could begin
            said = asked.recv(LETTER)
        if not said:
            raise self.ended()
        return said.decode()

    def _send(self, what: dict, *streams: socket.socket) -> None:
        try:
            fds = [stream.fileno() for stream in streams]
            socket.send_fds(self.control, [json.dumps(what).encode()], fds)
        except OSError:
            raise self.ended() from None

    def ended(self) -> EndedError:
        """Return what to say of the process's end."""
        return EndedError(f"the process that jobs are forked from {in_words(self.process.wait())}")

    def end(self, kindly: bool = False) -> None:
        """End the process and its jobs, which get a moment for it if this is done `kindly`."""
        if self.process:
            self.control.close()
            if not kindly:
                self.process.kill()
            self.process.wait()


def in_words(status: int) -> str:
    """Say how a process ended that should not have."""
    if status >= 0:
        return f"ended with exit status {status}"
    hint = ": out of memory?" if status == -signal.SIGKILL else ""
    return f"was killed by signal {-status} ({signal.Signals(-status).name}){hint}"
