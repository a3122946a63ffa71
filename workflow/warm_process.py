"""The process that workflow/warm.py starts: it imports modules, and forks a child for each job.

A child has the arguments, the folder, the environment, the streams and the signals that its command
would have had. What a process reads from its environment while it imports is the same in all of
them, so that a job whose environment differs is refused, and then starts by itself.

The first jobs of a run are ready before all is imported. They do not wait: a child imports what its
parent has not yet, and most of the first jobs draw nothing, for which the parent imports last.
"""

import atexit
import ctypes
import gc
import importlib
import io
import json
import marshal
import os
import resource
import runpy
import selectors
import signal
import socket
import struct
import sys
import tempfile
import threading
import time
import traceback
from collections.abc import Iterator
from contextlib import suppress
from itertools import chain
from typing import NamedTuple

OF_A_SHELL = {b"_", b"SHLVL", b"PWD", b"OLDPWD", b"PS1", b"TMPDIR", b"TMP", b"TEMPDIR", b"TEMP"}
"""What bash and Snakemake set for each job: nothing that is imported reads it."""
KEPT = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP, signal.SIGQUIT)
"""Signals to a whole group of processes, such as Ctrl-C. This process ends with Snakemake only."""
PATIENCE = 2.0
"""Seconds that a job has to end once Snakemake, or who waits for the job, is gone."""
DIE_WITH_PARENT = 1
"""PR_SET_PDEATHSIG of Linux."""


class Request(NamedTuple):
    """A job, as ask_warm.py describes it, and its three standard streams."""

    command: list[str]
    folder: str
    mask: int
    environment: dict[bytes, bytes]
    streams: list[int]


def prepared(modules: list[str]) -> Iterator[None]:
    """Import everything, and do what each process that imported it would do at its first use.

    It pauses after each step.
    """
    for name in modules:
        importlib.import_module(name)
        yield
        if "numba" in sys.modules:
            from numba.core.registry import cpu_target

            cpu_target.typing_context.refresh()
            cpu_target.target_context.refresh()
    if "xarray" in sys.modules:
        sys.modules["xarray"].backends.list_engines()
    if "pendula.drawing.style" in sys.modules:
        yield
        _draw_something(sys.modules["pendula.drawing.style"])


POWERS = range(-16, 5)
CASES = [(omega, pair) for omega in (8, -4, 0) for pair in ("1, 0.1", "5, 1")]
"""What stands at axes and above panels of many figures: its formulas are read once for all."""


def _draw_something(style) -> None:
    """Draw a picture that nobody sees, which loads fonts and the tables of both kinds of files."""

    @style.styled
    def draw():
        figure = style.new_figure(1.0, 1.0)
        axes = figure.add_subplot(yscale="log", xlabel=r"$\tau$")
        axes.set_yticks([float(f"1e{power}") for power in POWERS])
        for omega, pair in CASES:
            figure.text(0.0, 0.0, rf"$\Omega = {omega}$,  $(A_{{0}}, B_{{0}}) = ({pair})$")
        with style.thrifty():
            for kind in ("png", "pdf"):
                figure.savefig(io.BytesIO(), format=kind)

    draw()


class Server:
    """Takes requests and forks jobs until Snakemake ends."""

    def __init__(self, listener: socket.socket, handlers: dict, environment: dict[bytes, bytes]):
        """Listen at `listener`.

        Children get the `handlers` of signals that this process got when it started; `environment`
        is what it got then, since a module may add to it.
        """
        self._listener, self._handlers, self._environment = listener, handlers, environment
        self._pid, self._libc = os.getpid(), ctypes.CDLL(None)
        self._children: dict[int, socket.socket] = {}
        self._deadlines: dict[int, float] = {}
        self._selector = selectors.DefaultSelector()
        self._died, told = socket.socketpair()
        self._told = told  # kept open
        for end in (self._died, told):
            end.setblocking(False)
        signal.set_wakeup_fd(told.fileno(), warn_on_full_buffer=False)
        signal.signal(signal.SIGCHLD, lambda number, frame: None)
        for source in (sys.stdin, self._died):
            self._selector.register(source, selectors.EVENT_READ)

    def serve(self, packages: list[str]) -> Request | None:
        """Return None when Snakemake has ended, and in each child the job that it shall do.

        Import `packages`, and what Snakemake names, while nobody asks for a job.
        """
        self._left, self._expected = prepared(packages), 1  # until Snakemake says how many jobs
        lives = True
        while lives or self._children:
            prepares = lives and self._prepare()
            for key, _ in self._selector.select(0 if prepares else self._patience()):
                if key.fileobj is self._listener:
                    if request := self._take():
                        return request
                elif key.fileobj is self._died:
                    self._died.recv(4096)
                elif key.fileobj is sys.stdin:
                    lives = self._hear()
                else:  # nobody waits for this job any more
                    self._selector.unregister(key.fileobj)
                    self._end(key.data)
            self._bury()
        return None

    def _prepare(self) -> bool:
        """Do the next step of what is left to prepare; return whether there was one.

        Nothing is left when no job is to come that would gain from it.
        """
        if not self._expected:
            return False
        try:
            return next(self._left, "nothing") is None
        except Exception:  # each job that needs the module will say so
            traceback.print_exc()
            return False

    def _hear(self) -> bool:
        """Take down what jobs import, and listen to them; return False if Snakemake is gone."""
        if line := sys.stdin.readline():
            modules, self._expected, log = json.loads(line)
            with open(log, "wb") as file:
                os.dup2(file.fileno(), 1)
                os.dup2(file.fileno(), 2)
            self._left = chain(self._left, prepared(modules))
            self._selector.register(self._listener, selectors.EVENT_READ)
            signal.pthread_sigmask(signal.SIG_BLOCK, KEPT)
            return True
        self._selector.unregister(sys.stdin)
        for pid in self._children:
            self._end(pid)
        return False

    def _take(self) -> Request | None:
        """Take the job of the next client, or refuse it; return it in the child only."""
        connection, _ = self._listener.accept()
        request = self._read(connection)
        if request is None or not self._can_do(request):
            connection.close()
        else:
            connection.sendall(b"!")
            pid = os.fork()
            if pid == 0:
                self._become_a_job(connection)
                return request
            self._children[pid] = connection
            self._expected = max(0, self._expected - 1)
            self._selector.register(connection, selectors.EVENT_READ, pid)
        for stream in request.streams if request else ():
            os.close(stream)
        return None

    def _read(self, connection: socket.socket) -> Request | None:
        peer = connection.getsockopt(socket.SOL_SOCKET, socket.SO_PEERCRED, 12)
        if struct.unpack("3i", peer)[1] != os.getuid():
            return None
        connection.settimeout(PATIENCE)
        streams = []
        try:
            size, streams, _, _ = socket.recv_fds(connection, 4, 3)
            with connection.makefile("rb") as file:
                content = file.read(int.from_bytes(size, "little"))
            return Request(*marshal.loads(content), streams)
        except (OSError, EOFError, ValueError, TypeError):
            for stream in streams:
                os.close(stream)
            return None
        finally:
            connection.settimeout(None)

    def _can_do(self, request: Request) -> bool:
        """Return whether a fork is as good as a new process, and is safe: it copies one thread."""
        single = len(os.listdir("/proc/self/task")) == 1
        alike = _compared(request.environment) == _compared(self._environment)
        return single and alike and request.command[0] == sys.executable

    def _become_a_job(self, connection: socket.socket) -> None:
        """Leave all that belongs to the parent, and die with it."""
        self._libc.prctl(DIE_WITH_PARENT, signal.SIGKILL)
        if os.getppid() != self._pid:
            os._exit(1)
        signal.set_wakeup_fd(-1)
        self._selector.close()
        for end in (connection, self._listener, self._died, self._told, *self._children.values()):
            end.close()
        _open_anew(".ttf")
        for number, handler in self._handlers.items():
            signal.signal(number, handler)
        signal.pthread_sigmask(signal.SIG_UNBLOCK, KEPT)
        gc.freeze()
        gc.enable()

    def _end(self, pid: int) -> None:
        """Ask a job to end; _bury kills it if it does not."""
        os.kill(pid, signal.SIGTERM)
        self._deadlines.setdefault(pid, time.monotonic() + PATIENCE)

    def _patience(self) -> float | None:
        left = [deadline - time.monotonic() for deadline in self._deadlines.values()]
        return max(0.0, min(left)) if left else None

    def _bury(self) -> None:
        """Tell each client how its job ended."""
        for pid, deadline in self._deadlines.items():
            if time.monotonic() >= deadline:
                os.kill(pid, signal.SIGKILL)
        for pid in list(self._children):
            ended, status = os.waitpid(pid, os.WNOHANG)
            if ended:
                code = os.waitstatus_to_exitcode(status)
                self._deadlines.pop(pid, None)
                with self._children.pop(pid) as connection:
                    if connection in self._selector.get_map():
                        self._selector.unregister(connection)
                    # a shell, too, adds 128 to the number of a signal
                    code = code if code >= 0 else 128 - code
                    with suppress(OSError):  # nobody may wait for it
                        connection.sendall(code.to_bytes(4, "little"))


def _open_anew(ending: str) -> None:
    """Open the files of this ending anew that the parent has open, each where the parent is in it.

    A formula that the parent has read holds its fonts open. All processes that have an open file
    from one parent have one place in it, so that a job would read what another one was looking for:
    it draws other letters then, or fails at a letter that is none.
    """
    for number in map(int, os.listdir("/proc/self/fd")):
        with suppress(OSError):  # the one that listed them is closed
            path = os.readlink(f"/proc/self/fd/{number}")
            if path.endswith(ending):
                own = os.open(path, os.O_RDONLY)
                os.lseek(own, os.lseek(number, 0, os.SEEK_CUR), os.SEEK_SET)
                os.dup2(own, number, inheritable=False)
                os.close(own)


def _compared(environment: dict[bytes, bytes]) -> dict[bytes, bytes]:
    return {name: value for name, value in environment.items() if name not in OF_A_SHELL}


def do(request: Request) -> int:
    """Run the job in this process as `python SCRIPT` would, and return its exit status."""
    for number, stream in enumerate(request.streams):
        os.dup2(stream, number)
        os.close(stream)
    sys.stdin = sys.__stdin__ = open(0, closefd=False)  # noqa: SIM115, without what was read ahead
    sys.stdout.reconfigure(line_buffering=os.isatty(1))
    os.chdir(request.folder)
    os.umask(request.mask)
    os.environb.update(request.environment)
    tempfile.tempdir = None
    if "numpy" in sys.modules:
        sys.modules["numpy"].random.seed()
    script = request.command[1]
    sys.argv = [script]
    sys.path[0] = os.path.dirname(script)
    try:
        runpy.run_path(script, run_name="__main__")
    except SystemExit as end:
        if isinstance(end.code, int) or end.code is None:
            return (end.code or 0) & 255
        print(end.code, file=sys.stderr)
        return 1
    except KeyboardInterrupt:
        traceback.print_exc()
        return 128 + signal.SIGINT
    except BaseException:
        traceback.print_exc()
        return 1
    return 0


def end(status: int) -> None:
    """End this process as Python does, but do not take apart all that its parent imported."""
    try:
        threading._shutdown()
        atexit._run_exitfuncs()
        sys.stdout.flush()
        sys.stderr.flush()
    finally:
        os._exit(status)


def _tell() -> None:
    """Say what processor time this process took, as jobs do in their logs."""
    usage = resource.getrusage(resource.RUSAGE_SELF)
    taken = round(usage.ru_utime + usage.ru_stime, 3)
    print(f"spent: {json.dumps({'imports': taken, 'memory': round(usage.ru_maxrss * 1024 / 1e6)})}")


def main(listener: int, packages: list[str]) -> None:
    """Import, serve, and in each child do a job."""
    handlers = {number: signal.getsignal(number) for number in (*KEPT, signal.SIGCHLD)}
    signal.pthread_sigmask(signal.SIG_BLOCK, set(KEPT) - {signal.SIGTERM})
    environment, path = dict(os.environb), list(sys.path)
    gc.disable()
    server = Server(socket.socket(fileno=listener), handlers, environment)
    request = server.serve(packages)
    sys.path[:] = path
    if request is None:
        _tell()
    end(do(request) if request else 0)


if __name__ == "__main__":
    main(int(sys.argv[1]), sys.argv[2:-1])
