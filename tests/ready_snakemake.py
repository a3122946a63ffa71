"""A process that has imported Snakemake and forks for each run that a test asks for.

Nearly half of a dry run is the import of Snakemake and of the packages that it uses. A run here is
still a process of its own, with its own folder, screen and exit code, and it imports the project
anew. What is there already is what other people wrote, `workflow/warm_process.py`, and the rules
that an earlier run has parsed.

A run with jobs starts `workflow/warm_process.py`, a new Python that imports what jobs need, which
takes as long again. So each run has a fork in reserve: it waits until the run starts this command,
and then does what the command says, as a child of the run. `helpers.py` starts this process and
asks it. It asks for `python -m doctest` too, for which the same packages are imported.
"""

import gc
import importlib
import io
import json
import os
import pickle
import runpy
import shutil
import signal
import socket
import subprocess
import sys
from hashlib import sha256
from pathlib import Path
from tempfile import mkdtemp
from types import ModuleType

PACKAGES = (
    *("snakemake.cli", "snakemake.report.html_reporter"),
    *("pydantic", "smart_open", "yte", "nbformat", "platformdirs"),
    *("numba", "netCDF4", "xarray", "scipy.special", "scipy.optimize"),
    *(f"matplotlib.{name}" for name in ("figure", "backends.backend_agg", "backends.backend_pdf")),
)
"""What every run or its jobs import, whatever a run is asked for."""
WARM = "warm_process.py"
"""The command that the fork in reserve does."""
LOOKS = {"-n", "--dry-run", "--list", "doctest"}
"""Calls without jobs."""
MOST = 1 << 20
"""Bytes that are more than a command and its environment have."""


class Popen(subprocess.Popen):
    """What starts processes, but for the command that a fork does."""

    def __new__(cls, args, *others, **options):
        """Return a new process, or the fork in reserve."""
        warm = not isinstance(args, str) and [Path(part).name for part in args[1:2]] == [WARM]
        return object.__new__(WarmProcess if warm else cls)


class WarmProcess(Popen):
    """The fork in reserve, which does the command of the first who asks."""

    reserve: tuple[int, socket.socket]
    """Its number, and where it waits."""

    def __init__(self, args, *, env, pass_fds, **streams):
        """Tell it what to do; whatever it says, nobody hears."""
        self.args, (self.pid, waits), (listener,) = args, self.reserve, pass_fds
        reads, writes = os.pipe()
        what = json.dumps([os.getcwd(), dict(env), [str(arg) for arg in args[1:]], listener])
        socket.send_fds(waits, [what.encode()], [reads, listener])
        os.close(reads)
        self.returncode = None
        self.stdin = open(writes, "wb")  # noqa: SIM115, as long as the run lives

    def terminate(self):
        """End it, unless it has ended."""
        if self.returncode is None:
            os.kill(self.pid, signal.SIGTERM)

    def wait(self, timeout=None):
        """Return when it has ended."""
        if self.returncode is None:
            _, status = os.waitpid(self.pid, 0)
            self.returncode = os.waitstatus_to_exitcode(status)


def keep_a_fork_in_reserve() -> None:
    """Fork, and have the fork do the command `WARM` if anybody starts it."""
    tells, told = socket.socketpair(socket.AF_UNIX, socket.SOCK_SEQPACKET)
    if not (fork := os.fork()):
        tells.close()
        wait_in_reserve(told)
    told.close()
    WarmProcess.reserve, subprocess.Popen = (fork, tells), Popen


def wait_in_reserve(told: socket.socket) -> None:
    """Do the command that a run asks for, or end with the run."""
    for number in range(3):
        _take(os.open(os.devnull, os.O_RDWR), number)
    what, opened, _, _ = socket.recv_fds(told, MOST, 2)
    if what:
        folder, variables, command, listener = json.loads(what)
        _be_in(folder, variables)
        for own, number in zip(opened, (0, listener), strict=True):
            _take(own, number)
        sys.argv[:] = command
        sys.path[:1] = [os.path.dirname(command[0]), *variables["PYTHONPATH"].split(os.pathsep)]
        runpy.run_path(command[0], run_name="__main__")
    os._exit(0)


def serve() -> list[str] | None:
    """Fork for each line of standard input; in a fork return a module's name and its arguments."""
    for line in iter(sys.stdin.readline, ""):
        folder, variables, screens, arguments = json.loads(line)
        if not (child := os.fork()):
            if not LOOKS & set(arguments):
                keep_a_fork_in_reserve()
            _be_in(folder, variables)
            _take(os.open(os.devnull, os.O_RDONLY), 0)
            for number, path in enumerate(screens, 1):
                _take(os.open(path, os.O_WRONLY), number)
            return arguments
        _, status = os.waitpid(child, 0)
        print(os.waitstatus_to_exitcode(status), flush=True)
    return None


def _be_in(folder: str, variables: dict[str, str]) -> None:
    os.chdir(folder)
    os.environ.clear()
    os.environ.update(variables)


def _take(opened: int, number: int) -> None:
    if opened != number:
        os.dup2(opened, number)
        os.close(opened)


def keep_what_is_parsed(folder: Path) -> None:
    """Have Snakemake parse each text of rules once for all forks, and keep the code in `folder`.

    Its parser takes a fifth of a dry run, and nearly all runs read the same rules. The code holds
    the path of the rules, and numbers of rules that have no name.
    """
    workflow = sys.modules["snakemake.workflow"]
    parse = workflow.parse

    def parsed(path, *others, linemap, rulecount):
        place = path.get_path_or_uri(secret_free=True)
        text = f"{rulecount} {Path(place).read_text()}"
        kept = folder / sha256(text.encode()).hexdigest()
        if kept.exists():
            first, lines, code, rulecount = pickle.loads(kept.read_bytes())
            linemap |= lines
            return code.replace(repr(first), repr(place)), rulecount
        code, rulecount = parse(path, *others, linemap=linemap, rulecount=rulecount)
        partial = kept.with_suffix(".partial")
        partial.write_bytes(pickle.dumps((place, linemap, code, rulecount)))
        partial.replace(kept)
        return code, rulecount

    workflow.parse = parsed


def get_ready() -> ModuleType:
    """Import what other people wrote, do what it does at its first use; return `WARM`'s module."""
    sys.path[0] = str(Path(__file__).resolve().parents[1] / "workflow")
    warm = importlib.import_module(Path(WARM).stem)
    for _ in warm.prepared(PACKAGES):
        pass
    sys.modules["snakemake.cli"].get_argument_parser()  # it looks for plugins in all folders
    figure = sys.modules["matplotlib.figure"].Figure()
    figure.text(0.0, 0.0, r"$\tau$")
    for kind in ("png", "pdf"):
        figure.savefig(io.BytesIO(), format=kind)
    gc.collect()
    gc.freeze()
    gc.disable()  # no run of a test makes garbage that is worth the time
    return warm


def main() -> None:
    """Get ready once, and in each fork be Snakemake or doctest."""
    warm = get_ready()
    sys.path[0] = ""  # as `python -m` does, so that no test's helper is found by a workflow
    keep_what_is_parsed(folder := Path(mkdtemp()))
    request = serve()
    if request is None:
        return shutil.rmtree(folder)
    sys.argv[:] = request
    if sys.argv[0] == "doctest":
        sys.path[1:1] = os.environ["PYTHONPATH"].split(os.pathsep)
        runpy.run_module("doctest", run_name="__main__")
    try:
        importlib.import_module("snakemake.cli").main()
    except SystemExit as status:
        warm.end(status.code or 0)


if __name__ == "__main__":
    main()
