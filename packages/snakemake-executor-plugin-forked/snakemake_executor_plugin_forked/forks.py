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

SERVER = Path(__file__).with_name("server.py")
LETTER = 65536
"""Bytes that are more than any message has."""
END = b"end"
"""The last message, without which the process takes Snakemake for killed."""
PATH = "PYTHONPATH"
INTERRUPTED = 128 + signal.SIGINT
"""The exit status after Ctrl-C."""
LIBRARIES = ("OMP_NUM", "GOTO_NUM", "OPENBLAS_NUM", "MKL_NUM", "VECLIB_MAXIMUM", "NUMEXPR_NUM")
THREADS = {f"{library}_THREADS": "1" for library in LIBRARIES}
"""The environment variables that Snakemake sets for a job of one thread."""
LOOKS = r"-[A-Za-z]*n[A-Za-z]*|--dry-?run"
"""What a word of a command line looks like, such as -n or -np, that asks for a run without jobs."""
PLACES = ("TMPDIR", "TMP", "TEMPDIR", "TEMP")
"""Those that it sets to the folder for temporary files. No module reads them at its import."""


class RefusedError(Exception):
    """A job cannot be a fork; the message says why."""


class Parent:
    """A process that imports modules and forks jobs, and the socket for requests to it."""

    def __init__(self, modules: list[str]):
        """Start it, with the environment as it is now."""
        self.found = surroundings()
        self.control, theirs = socket.socketpair(socket.AF_UNIX, socket.SOCK_SEQPACKET)
        with theirs:
            self.process = subprocess.Popen(
                [sys.executable, str(SERVER), str(theirs.fileno()), *modules],
                pass_fds=[theirs.fileno()],
                env={**os.environ, **THREADS},
                start_new_session=True,  # Ctrl-C is for Snakemake, which ends the jobs
            )

    def tell(self, path: str) -> None:
        """Tell it before the first job where modules are beside the folders that it knows."""
        with suppress(OSError):  # it has ended, as the first job will hear
            self.control.send(json.dumps(path).encode())

    def ask(self, request: dict) -> socket.socket:
        """Return the socket on which it answers a request, or which ends if it has died."""
        own, theirs = socket.socketpair(socket.AF_UNIX, socket.SOCK_SEQPACKET)
        with theirs, suppress(OSError):
            socket.send_fds(self.control, [json.dumps(request).encode()], [theirs.fileno()])
        return own

    def hang_up(self) -> None:
        """Have it end its jobs, which have a moment for it, and itself."""
        with suppress(OSError):  # it has ended, or was told before
            self.control.send(END, socket.MSG_DONTWAIT)
        self.control.close()

    def end(self, kill: bool) -> None:
        """End it and its jobs, which have a moment for it unless it is killed."""
        if self.process.returncode is None:
            self.hang_up()
            if kill:
                with suppress(ProcessLookupError):  # another thread was faster
                    os.killpg(self.process.pid, signal.SIGKILL)
            self.process.wait()


@dataclass
class Fork:
    """A job: its number, the socket on which `parent` tells of it, and this parent."""

    pid: int
    socket: socket.socket
    parent: Parent


class Forks:
    """The process that forks jobs, and the one that takes its place if it dies."""

    parent, begun, interrupted, replaced = None, False, False, False

    def __init__(self, modules: list[str]):
        """Start the process, which imports modules; from now on Ctrl-C shows no traceback.

        A dry run, where Snakemake shall be quick and needs no module, starts none.
        """
        self.modules, self.lock = modules, threading.Lock()
        if signal.getsignal(signal.SIGINT) is signal.default_int_handler:
            signal.signal(signal.SIGINT, self._interrupt)
        if sys.platform == "linux":
            atexit.register(self.end)
            if not any(re.fullmatch(LOOKS, word) for word in sys.argv):
                self.parent = Parent(modules)

    def _interrupt(self, number, frame) -> None:
        signal.signal(signal.SIGINT, signal.SIG_IGN)
        self.interrupted = True
        if self.parent:
            self.parent.hang_up()
        raise SystemExit(INTERRUPTED)

    def begin(self) -> None:
        """Tell the process, before the first job, where the workflow has its modules.

        If the workflow has set more than PYTHONPATH, the imports begin anew.
        """
        if self.begun or sys.platform != "linux":
            return
        self.begun = True
        if self.parent:  # else what looked like a dry run is none
            path = "" if PATH in self.parent.found[1] else os.environ.get(PATH, "")
            if surroundings(without=path and PATH) == self.parent.found:
                return self.parent.tell(path)
            self.end()
        self.parent = Parent(self.modules)
        self.parent.tell("")

    def fork(self, script: str, place: str | None) -> Fork:
        """Return a process that runs `script`, once its socket is shut down."""
        if not self.parent:
            raise RefusedError(f"forks are not safe on {sys.platform}")
        environment = dict.fromkeys(PLACES, place) if place else {}
        request = {"script": os.path.abspath(script), "environment": environment}
        while True:
            parent = self.parent
            fork = Fork(0, parent.ask(request), parent)
            try:
                answer = self.hear(fork)
            except ChildProcessError as death:
                self.replace(parent, death)
                continue
            if not answer.isdigit():
                raise RefusedError(answer)
            fork.pid = int(answer)
            return fork

    def hear(self, fork: Fork) -> str:
        """Return the next message of its parent on a job."""
        if message := fork.socket.recv(LETTER).decode():
            return message
        fork.parent.end(kill=not self.interrupted)
        how = in_words(fork.parent.process.returncode)
        raise ChildProcessError(f"the process that jobs are forked from {how}")

    def replace(self, dead: Parent, death: ChildProcessError) -> None:
        """Start a process in the place of the first that died; what has died twice would again."""
        with self.lock:
            if self.interrupted:
                raise death
            if self.parent is not dead:  # another thread was faster
                return
            if self.replaced:
                raise RefusedError(str(death))
            self.replaced = True
            self.parent = Parent(self.modules)
            self.parent.tell("")

    def end(self) -> None:
        """End the process and its jobs, which have a moment for it after Ctrl-C."""
        if self.parent:
            self.parent.end(kill=not self.interrupted)


def surroundings(without: str = "") -> tuple[str, dict[str, str]]:
    """Return what a module may read at its import: the folder, and all other variables."""
    return os.getcwd(), {name: text for name, text in os.environ.items() if name != without}


def in_words(status: int) -> str:
    """Say how a process ended that should not have."""
    if status >= 0:
        return f"ended with exit status {status}"
    hint = ": out of memory?" if status == -signal.SIGKILL else ""
    return f"was killed by signal {-status} ({signal.Signals(-status).name}){hint}"
