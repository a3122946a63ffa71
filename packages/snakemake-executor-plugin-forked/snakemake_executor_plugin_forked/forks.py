"""Starts the process that forks jobs, and sends it requests. Nothing here calls Snakemake."""

import atexit
import json
import os
import re
import signal
import socket
import subprocess
import sys
import threading
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path
from types import FrameType

SERVER = Path(__file__).with_name("server.py")
MAX_MESSAGE_BYTES = 65536
"""An upper bound for the size of a message."""
END = b"end"
"""The last message; if it is missing, the process assumes that Snakemake was killed."""
PATH = "PYTHONPATH"
INTERRUPTED = 128 + signal.SIGINT
"""The exit status after Ctrl-C."""
LIBRARIES = ("OMP_NUM", "GOTO_NUM", "OPENBLAS_NUM", "MKL_NUM", "VECLIB_MAXIMUM", "NUMEXPR_NUM")
THREADS = {f"{library}_THREADS": "1" for library in LIBRARIES}
"""The environment variables that Snakemake sets for a job of one thread."""
DRY_RUN_OPTION = r"-[A-Za-z]*n[A-Za-z]*|--dry-?run"
"""Pattern of an option for a dry run, such as -n or -np."""
TMPDIR_VARIABLES = ("TMPDIR", "TMP", "TEMPDIR", "TEMP")
"""Variables that Snakemake sets to the folder for temporary files; no import reads them."""


class CannotForkError(Exception):
    """A job cannot be a fork; the message has the reason."""


class Parent:
    """A process that imports modules and forks jobs, and the socket for requests to it."""

    def __init__(self, modules: list[str]) -> None:
        """Start the process with the current environment."""
        self.start_environment = folder_and_variables()
        self.control, theirs = socket.socketpair(socket.AF_UNIX, socket.SOCK_SEQPACKET)
        with theirs:
            self.process = subprocess.Popen(
                [sys.executable, str(SERVER), str(theirs.fileno()), *modules],
                pass_fds=[theirs.fileno()],
                env={**os.environ, **THREADS},
                start_new_session=True,  # Ctrl-C is for Snakemake, which ends the jobs
            )

    def send_path(self, path: str) -> None:
        """Before the first job, send the workflow's PYTHONPATH, or "" if it adds nothing."""
        with suppress(OSError):  # the process has ended, which the first job will report
            self.control.send(json.dumps(path).encode())

    def send_request(self, request: dict) -> socket.socket:
        """Send a request and return the socket for its answer; it closes if the process dies."""
        ours, theirs = socket.socketpair(socket.AF_UNIX, socket.SOCK_SEQPACKET)
        with theirs, suppress(OSError):
            socket.send_fds(self.control, [json.dumps(request).encode()], [theirs.fileno()])
        return ours

    def request_end(self) -> None:
        """Send the last message: jobs get SIGINT and have 3 seconds before the process ends."""
        with suppress(OSError):  # the process has ended, or the message was sent before
            self.control.send(END, socket.MSG_DONTWAIT)
        self.control.close()

    def end(self, kill: bool) -> None:
        """Stop the process and its jobs: at once if `kill`, otherwise by `request_end`."""
        if self.process.returncode is None:
            self.request_end()
            if kill:
                with suppress(ProcessLookupError):  # another thread was faster
                    os.killpg(self.process.pid, signal.SIGKILL)
            self.process.wait()


@dataclass
class Fork:
    """A job: its process ID, the socket for messages about it, the process that forked it."""

    pid: int
    socket: socket.socket
    parent: Parent


class Forks:
    """The process that forks jobs, and its replacement if it dies."""

    parent, begun, interrupted, replaced = None, False, False, False

    def __init__(self, modules: list[str]) -> None:
        """Start the process that imports `modules`, and handle Ctrl-C without a traceback.

        A dry run needs no module, so it starts no process.
        """
        self.modules, self.lock = modules, threading.Lock()
        if signal.getsignal(signal.SIGINT) is signal.default_int_handler:
            signal.signal(signal.SIGINT, self._interrupt)
        if sys.platform == "linux":
            atexit.register(self.end)
            if not any(re.fullmatch(DRY_RUN_OPTION, word) for word in sys.argv):
                self.parent = Parent(modules)

    def _interrupt(self, number: int, frame: FrameType | None) -> None:
        signal.signal(signal.SIGINT, signal.SIG_IGN)
        self.interrupted = True
        if self.parent:
            self.parent.request_end()
        raise SystemExit(INTERRUPTED)

    def begin(self) -> None:
        """Before the first job, send the process the workflow's PYTHONPATH.

        Start a new process if the workflow has changed the folder or other variables.
        """
        if self.begun or sys.platform != "linux":
            return
        self.begun = True
        if self.parent:  # None if another option looked like a dry run
            _, variables = self.parent.start_environment
            path = "" if PATH in variables else os.environ.get(PATH, "")
            if folder_and_variables(without=path and PATH) == self.parent.start_environment:
                return self.parent.send_path(path)
            self.end()
        self.parent = Parent(self.modules)
        self.parent.send_path("")

    def fork(self, script: str, tmpdir: str | None) -> Fork:
        """Return a process that runs `script` once its socket is shut down for writing."""
        if not self.parent:
            raise CannotForkError(f"forks are not safe on {sys.platform}")
        environment = dict.fromkeys(TMPDIR_VARIABLES, tmpdir) if tmpdir else {}
        request = {"script": os.path.abspath(script), "environment": environment}
        while True:
            parent = self.parent
            fork = Fork(0, parent.send_request(request), parent)
            try:
                answer = self.receive(fork)
            except ChildProcessError as death:
                self.replace(parent, death)
                continue
            if not answer.isdigit():
                raise CannotForkError(answer)
            fork.pid = int(answer)
            return fork

    def receive(self, fork: Fork) -> str:
        """Return the next message about a job; raise ChildProcessError if its parent has died."""
        if message := fork.socket.recv(MAX_MESSAGE_BYTES).decode():
            return message
        fork.parent.end(kill=not self.interrupted)
        end = describe_end(fork.parent.process.returncode)
        raise ChildProcessError(f"the process that jobs are forked from {end}")

    def replace(self, dead: Parent, death: ChildProcessError) -> None:
        """Replace the process when it first dies; raise the next time, as the cause remains."""
        with self.lock:
            if self.interrupted:
                raise death
            if self.parent is not dead:  # another thread was faster
                return
            if self.replaced:
                raise CannotForkError(str(death))
            self.replaced = True
            self.parent = Parent(self.modules)
            self.parent.send_path("")

    def end(self) -> None:
        """Stop the process and its jobs: at once, or after Ctrl-C within 3 seconds."""
        if self.parent:
            self.parent.end(kill=not self.interrupted)


def folder_and_variables(without: str = "") -> tuple[str, dict[str, str]]:
    """Return the working directory and the environment without one variable.

    Imported modules may have read them.
    """
    return os.getcwd(), {name: text for name, text in os.environ.items() if name != without}


def describe_end(status: int) -> str:
    """Return how a process with this exit status ended, as the predicate of a sentence."""
    if status >= 0:
        return f"ended with exit status {status}"
    hint = ": out of memory?" if status == -signal.SIGKILL else ""
    return f"was killed by signal {-status} ({signal.Signals(-status).name}){hint}"
