"""The process that imports modules and forks a child for each job: `server.py SOCKET MODULE...`.

It imports while nobody asks; a job that comes earlier imports for itself what is not there yet.
Only the first job waits for one module, which it and those beside it would else import each. The
rest is imported once a job has ended, because a run may have no more.
"""

import atexit
import gc
import importlib.util
import json
import os
import pkgutil
import select
import signal
import socket
import stat
import sys
import tempfile
import time
from contextlib import suppress
from importlib.machinery import PathFinder
from types import ModuleType

LETTER = 65536
"""Bytes that are more than any message has."""
END = b"end"
"""The last message, unless Snakemake was killed."""
KILLED = (
    "forked: Snakemake was killed, so its jobs end. To go on: snakemake --unlock, then the same "
    "command again."
)
GRACE = 3
"""Seconds in which jobs must end once Snakemake is gone, or is told to end."""


class Server:
    """Imports, forks, and reports how jobs ended, until Snakemake ends."""

    def __init__(self, control: socket.socket, modules: list[str]):
        """Listen at `control`, and import `modules` meanwhile."""
        self.control, self.modules = control, modules
        self.jobs: dict[int, socket.socket] = {}
        self.begun, self.ended = False, False
        signal.signal(signal.SIGCHLD, self.bury)
        signal.pthread_sigmask(signal.SIG_BLOCK, [signal.SIGINT])  # a job hears it in its script

    def serve(self) -> dict[str, str | dict]:
        """Return in each child what it shall do; end with all jobs when Snakemake has ended."""
        while True:
            if self.can_prepare() and not select.select([self.control], [], [], 0)[0]:
                self.prepare(self.modules.pop(0))
                continue
            first = b"" if self.begun else self.control.recv(LETTER, socket.MSG_PEEK)
            if first not in (b"", END):
                self.begin(json.loads(first))
                continue
            message, streams, _, _ = socket.recv_fds(self.control, LETTER, 1)
            if message in (b"", END):
                break
            if self.fork(socket.socket(fileno=streams[0])):
                return json.loads(message)
        for pid in list(self.jobs):
            with suppress(ProcessLookupError):  # it has just ended
                os.kill(pid, signal.SIGINT)
        end = time.monotonic() + GRACE
        while self.jobs and time.monotonic() < end:
            time.sleep(0.01)
        if not message:
            with suppress(OSError):  # its screen is gone too
                print(KILLED, file=sys.stderr, flush=True)
        os.killpg(0, signal.SIGKILL)

    def can_prepare(self) -> bool:
        """Return whether to import: the workflow may not yet have told where the next module is.

        Once it has begun, only a run of more jobs than its first ones gains by further imports.
        """
        name = self.modules[0].partition(".")[0] if self.modules else ""
        may = self.ended if self.begun else name and importlib.util.find_spec(name)
        return bool(name and may)

    def begin(self, path: str) -> None:
        """Look for modules in these folders first; start anew if imported ones would be others."""
        if path and path != os.environ.get("PYTHONPATH"):
            os.environ["PYTHONPATH"] = path
            folders = [os.path.abspath(folder) for folder in path.split(os.pathsep)]
            if any(PathFinder.find_spec(name, folders) for name in sys.modules if "." not in name):
                os.execv(sys.executable, [sys.executable, __file__, *sys.argv[1:]])
            sys.path[:0] = folders
        self.begun = True
        self.control.recv(LETTER)
        if self.modules:
            self.prepare(self.modules.pop(0))  # else all of the first jobs would import it

    def prepare(self, name: str) -> None:
        """Import a module, and put those of a package before all that are still to come."""
        try:
            module = importlib.import_module(name.removesuffix(".*"))
            if name.endswith(".*"):
                inside = pkgutil.iter_modules(module.__path__, f"{module.__name__}.")
                self.modules[:0] = [found.name + ".*" * found.ispkg for found in inside]
        except BaseException as error:  # such as SystemExit of a script that is meant to be run
            print(f"forked: cannot import {name}: {error!r}", file=sys.stderr, flush=True)

    def fork(self, asked: socket.socket) -> bool:
        """Fork a job unless this is not safe, and return whether this is the child."""
        if (threads := len(os.listdir("/proc/self/task"))) > 1:
            with asked:
                asked.sendall(f"what it imported runs {threads} threads".encode())
            return False
        if pid := os.fork():
            with suppress(OSError):  # Snakemake is gone
                asked.sendall(str(pid).encode())
            self.jobs[pid] = asked
            self.bury()  # it may have ended by now
            return False
        signal.signal(signal.SIGCHLD, signal.SIG_DFL)
        for end in (self.control, *self.jobs.values()):
            end.close()
        open_files_anew()
        gc.freeze()
        gc.enable()
        with asked:
            try:
                asked.recv(LETTER)  # Snakemake measures it from now on
            except ConnectionResetError:  # it was killed before it had read the answer
                os._exit(1)
        return True

    def bury(self, *signalled) -> None:
        """Tell Snakemake how jobs ended."""
        for pid in list(self.jobs):
            with suppress(OSError):  # this was called while it was at work, or Snakemake is gone
                ended, status = os.waitpid(pid, os.WNOHANG)
                if ended:
                    self.ended = True
                    with self.jobs.pop(pid) as asked:
                        asked.sendall(str(os.waitstatus_to_exitcode(status)).encode())


def open_files_anew() -> None:
    """Open what the parent reads anew, each at the same place.

    All processes that have an open file from one parent share one place in it: of two jobs that
    draw letters from a font, each would read what the other was looking for.
    """
    for number in map(int, os.listdir("/proc/self/fd")):
        with suppress(OSError):  # the folder that was listed is closed
            if number > 2 and stat.S_ISREG(os.fstat(number).st_mode):
                own = os.open(f"/proc/self/fd/{number}", os.O_RDONLY)
                os.lseek(own, os.lseek(number, 0, os.SEEK_CUR), os.SEEK_SET)
                os.dup2(own, number, inheritable=False)
                os.close(own)


def do(script: str, environment: dict[str, str]) -> int:
    """Run a script in this process as `python SCRIPT` would, and return its exit status."""
    os.environ.update(environment, PWD=os.getcwd())
    tempfile.tempdir = None
    if "numpy" in sys.modules:
        sys.modules["numpy"].random.seed()
    sys.argv = [script]
    if not sys.flags.safe_path:
        sys.path.insert(0, os.path.dirname(script))
    main = sys.modules["__main__"] = ModuleType("__main__")
    main.__file__ = script
    try:
        signal.pthread_sigmask(signal.SIG_UNBLOCK, [signal.SIGINT])
        with open(script, "rb") as file:
            code = compile(file.read(), script, "exec")
        exec(code, main.__dict__)
    except SystemExit as end:
        if isinstance(end.code, int) or end.code is None:
            return (end.code or 0) & 255
        print(end.code, file=sys.stderr)
        return 1
    except KeyboardInterrupt:
        return 128 + signal.SIGINT
    except BaseException as error:
        shown = error.with_traceback(error.__traceback__.tb_next)
        sys.excepthook(type(shown), shown, shown.__traceback__)
        return 1
    finally:
        signal.signal(signal.SIGINT, signal.SIG_IGN)  # the job is done
    return 0


def leave() -> None:
    """End this process without taking apart all that its parent imported."""
    for stream in (sys.stdout, sys.stderr):
        with suppress(OSError, ValueError):  # nobody reads it, or the job has closed it
            stream.flush()
    os._exit(status)


status = 0

if __name__ == "__main__":
    atexit.register(leave)  # the first that is registered is the last that is done
    gc.disable()
    del sys.path[: not sys.flags.safe_path]  # the folder of this file
    job = Server(socket.socket(fileno=int(sys.argv[1])), sys.argv[2:]).serve()
    status = do(**job)
