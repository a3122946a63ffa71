"""The process that imports modules and forks a child for each job: `server.py SOCKET MODULE...`.

It imports modules while idle; a job that arrives earlier imports the missing modules itself. The
first job waits for one module, because otherwise each of the first parallel jobs would import it.
The others are imported once a job has ended, because the run may have no further jobs.
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

MAX_MESSAGE_BYTES = 65536
"""An upper bound for the size of a message."""
END = b"end"
"""The last message, unless Snakemake was killed."""
KILLED = (
    "forked: Snakemake was killed, so its jobs end. To continue, run snakemake --unlock, then the "
    "same command again."
)
SECONDS_TO_END = 3
"""Time in seconds for jobs to end after Snakemake has ended or interrupted them."""


class Server:
    """Imports, forks, and reports how jobs ended, until Snakemake ends."""

    def __init__(self, control: socket.socket, modules: list[str]) -> None:
        """Listen at `control`, and import `modules` while idle."""
        self.control, self.modules = control, modules
        self.jobs: dict[int, socket.socket] = {}
        self.begun, self.ended = False, False
        signal.signal(signal.SIGCHLD, self.report_ended_jobs)
        signal.pthread_sigmask(signal.SIG_BLOCK, [signal.SIGINT])  # only scripts get it

    def serve(self) -> dict[str, str | dict]:
        """Fork a child for each request, and return it in the child; end with Snakemake."""
        while True:
            if self.can_prepare() and not select.select([self.control], [], [], 0)[0]:
                self.prepare(self.modules.pop(0))
                continue
            first = b"" if self.begun else self.control.recv(MAX_MESSAGE_BYTES, socket.MSG_PEEK)
            if first not in (b"", END):
                self.begin(json.loads(first))
                continue
            message, streams, _, _ = socket.recv_fds(self.control, MAX_MESSAGE_BYTES, 1)
            if message in (b"", END):
                break
            if self.fork(socket.socket(fileno=streams[0])):
                return json.loads(message)
        for pid in list(self.jobs):
            with suppress(ProcessLookupError):  # the job has just ended
                os.kill(pid, signal.SIGINT)
        end = time.monotonic() + SECONDS_TO_END
        while self.jobs and time.monotonic() < end:
            time.sleep(0.01)
        if not message:
            with suppress(OSError):  # the terminal is closed too
                print(KILLED, file=sys.stderr, flush=True)
        os.killpg(0, signal.SIGKILL)

    def can_prepare(self) -> bool:
        """Return whether to import the next module now.

        Before the workflow has set PYTHONPATH, the module may not exist. After the first request,
        wait until a job has ended: further imports pay only if more jobs follow.
        """
        name = self.modules[0].partition(".")[0] if self.modules else ""
        is_useful = self.ended if self.begun else name and importlib.util.find_spec(name)
        return bool(name and is_useful)

    def begin(self, path: str) -> None:
        """Put the folders of `path` first in sys.path; restart if they replace imported modules."""
        if path and path != os.environ.get("PYTHONPATH"):
            os.environ["PYTHONPATH"] = path
            folders = [os.path.abspath(folder) for folder in path.split(os.pathsep)]
            if any(PathFinder.find_spec(name, folders) for name in sys.modules if "." not in name):
                os.execv(sys.executable, [sys.executable, __file__, *sys.argv[1:]])
            sys.path[:0] = folders
        self.begun = True
        self.control.recv(MAX_MESSAGE_BYTES)
        if self.modules:
            self.prepare(self.modules.pop(0))  # otherwise each of the first jobs would import it

    def prepare(self, name: str) -> None:
        """Import a module; for "package.*", put the package's modules first in the list."""
        try:
            module = importlib.import_module(name.removesuffix(".*"))
            if name.endswith(".*"):
                inside = pkgutil.iter_modules(module.__path__, f"{module.__name__}.")
                self.modules[:0] = [module.name + ".*" * module.ispkg for module in inside]
        except BaseException as error:  # such as SystemExit of a script
            print(f"forked: cannot import {name}: {error!r}", file=sys.stderr, flush=True)

    def fork(self, job: socket.socket) -> bool:
        """Fork a job if this is safe, and return whether this process is the child."""
        if (threads := len(os.listdir("/proc/self/task"))) > 1:
            with job:
                job.sendall(f"the imported modules run {threads} threads".encode())
            return False
        if pid := os.fork():
            with suppress(OSError):  # Snakemake has ended
                job.sendall(str(pid).encode())
            self.jobs[pid] = job
            self.report_ended_jobs()  # the job may already have ended
            return False
        signal.signal(signal.SIGCHLD, signal.SIG_DFL)
        for end in (self.control, *self.jobs.values()):
            end.close()
        reopen_files()
        gc.freeze()
        gc.enable()
        with job:
            try:
                job.recv(MAX_MESSAGE_BYTES)  # wait until Snakemake measures the job
            except ConnectionResetError:  # Snakemake was killed before it read the answer
                os._exit(1)
        return True

    def report_ended_jobs(self, *signal_and_frame: object) -> None:
        """Collect the exit statuses of jobs that have ended, and send them to Snakemake."""
        for pid in list(self.jobs):
            with suppress(OSError):  # SIGCHLD interrupted this call, or Snakemake has ended
                ended, status = os.waitpid(pid, os.WNOHANG)
                if ended:
                    self.ended = True
                    with self.jobs.pop(pid) as job:
                        job.sendall(str(os.waitstatus_to_exitcode(status)).encode())


def reopen_files() -> None:
    """Reopen the files that the parent holds open, each at its current offset.

    Forked processes share the file offset: two jobs that read glyphs from the same font file would
    move each other's position.
    """
    for number in map(int, os.listdir("/proc/self/fd")):
        with suppress(OSError):  # the descriptor of the listing itself is closed
            if number > 2 and stat.S_ISREG(os.fstat(number).st_mode):
                reopened = os.open(f"/proc/self/fd/{number}", os.O_RDONLY)
                os.lseek(reopened, os.lseek(number, 0, os.SEEK_CUR), os.SEEK_SET)
                os.dup2(reopened, number, inheritable=False)
                os.close(reopened)


def run_script(script: str, environment: dict[str, str]) -> int:
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
        in_script = error.with_traceback(error.__traceback__.tb_next)
        sys.excepthook(type(in_script), in_script, in_script.__traceback__)
        return 1
    finally:
        signal.signal(signal.SIGINT, signal.SIG_IGN)  # the job is done
    return 0


def leave() -> None:
    """End this process without freeing the imported modules."""
    for stream in (sys.stdout, sys.stderr):
        with suppress(OSError, ValueError):  # the reader has ended, or the job has closed it
            stream.flush()
    os._exit(status)


status = 0

if __name__ == "__main__":
    atexit.register(leave)  # the first registered function is called last
    gc.disable()
    del sys.path[: not sys.flags.safe_path]  # the folder of this file
    request = Server(socket.socket(fileno=int(sys.argv[1])), sys.argv[2:]).serve()
    status = run_script(**request)
