"""One process imports what the jobs of a run import, and each job is a fork of it.

A new Python that imports numba, xarray and matplotlib takes more than a second, longer than most
jobs compute. So a run on this machine starts one process, `workflow/warm_process.py`, which imports
all this once, and by Snakemake's `shell.prefix` each job calls `workflow/ask_warm.py`, which asks
that process for a fork. A fork behaves as if the job's own command had started it. Where a fork is
not safe or not the same, as for a job of many threads, the command itself starts the job.

A run keeps the code that it began with: what is edited meanwhile counts from the next call on, as
the records in results/code do, which are written at the beginning too.

The process ends when Snakemake ends, however it ends. Its socket is abstract, so that no file of it
can stay behind, whatever is killed; this and the safety of forks are why only Linux has it.
"""

import atexit
import json
import os
import secrets
import shlex
import socket
import subprocess
import sys
from collections.abc import Iterable, Mapping
from contextlib import suppress
from pathlib import Path

from pendula.sources import OURS, SCRIPTS, modules_of
from snakemake.shell import shell

HERE = Path(__file__).resolve().parent
PROCESS, CLIENT = HERE / "warm_process.py", HERE / "ask_warm.py"
PACKAGES = (
    *("snakemake.logging", "snakemake.iocontainers", "numpy", "numba", "netCDF4", "xarray"),
    *("matplotlib.figure", "matplotlib.backends.backend_agg", "matplotlib.backends.backend_pdf"),
)
"""What jobs import of other people's modules; our own are known when it is known which jobs run."""
LIBRARIES = ("OMP_NUM", "GOTO_NUM", "OPENBLAS_NUM", "MKL_NUM", "VECLIB_MAXIMUM", "NUMEXPR_NUM")
"""Snakemake tells a job in these variables, with _THREADS behind, how many threads it has."""


def begin() -> subprocess.Popen | None:
    """Start the process, which imports while Snakemake finds out what to do.

    It ends with Snakemake. Where the system cannot have it, return None.
    """
    if (
        sys.platform != "linux"
        or Path(shell.get_executable() or "").name != "bash"
        or shlex.quote(sys.executable) != sys.executable
    ):
        return None
    process = _serve(f"pendula-{secrets.token_hex(16)}", os.environ)
    atexit.register(end, process)
    return process


def use(process: subprocess.Popen | None, workflow, log: Path, called: Mapping) -> None:
    """Have Snakemake ask the process for its jobs, or end it where they gain nothing from it.

    `log` says in its last line what processor time the imports took.
    """
    scripts = scripts_of(workflow.dag.needrun_jobs())
    here = workflow.local_exec and not workflow.deployment_settings.deployment_method
    if process and here and not workflow.touch and scripts:
        log.parent.mkdir(parents=True, exist_ok=True)
        names = [name for functions in called for name in functions if "/" not in name]
        modules = [name.rpartition(".")[0] for name in names if "." in name]
        _tell(process, sorted({*imports_of(scripts), *modules}), len(scripts), log)
        shell.prefix(_prefix(process.args[-1]).replace("{", "{{").replace("}", "}}"))
    elif process:
        end(process)


def scripts_of(jobs: Iterable) -> list[Path]:
    """Return the scripts of all jobs of one thread, as often as they are called."""
    rules = [job.rule for job in jobs if job.rule.script and job.threads == 1]
    return [(Path(rule.snakefile).parent / rule.script).resolve() for rule in rules]


def imports_of(scripts: Iterable[Path]) -> list[str]:
    """Return the names of our modules that the scripts import."""
    modules = {module for script in set(scripts) for module in modules_of(script)}
    bases = (SCRIPTS, SCRIPTS.parent)
    names = {name for module in modules for base in bases if (name := _name(module, base))}
    return sorted(name for name in names if name.split(".")[0] in OURS)


def _name(module: Path, base: Path) -> str:
    """Return the dotted name of a module below `base`, or nothing where it lies elsewhere."""
    if not module.is_relative_to(base):
        return ""
    return ".".join(module.relative_to(base).with_suffix("").parts).removesuffix(".__init__")


def _serve(name: str, environment: Mapping[str, str], packages=PACKAGES) -> subprocess.Popen:
    """Start the process for jobs that ask at the abstract socket `name`."""
    with socket.socket(socket.AF_UNIX) as listener:
        listener.bind(f"\0{name}")
        listener.listen(socket.SOMAXCONN)
        return subprocess.Popen(
            [sys.executable, str(PROCESS), str(listener.fileno()), *packages, name],
            stdin=subprocess.PIPE,  # open as long as Snakemake lives
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
            env={**environment, **{f"{library}_THREADS": "1" for library in LIBRARIES}},
            pass_fds=[listener.fileno()],
        )


def _tell(process: subprocess.Popen, modules: list[str], jobs: int, log: Path) -> None:
    with suppress(BrokenPipeError):  # it failed to import: jobs start by themselves
        process.stdin.write(json.dumps([modules, jobs, str(log)]).encode() + b"\n")
        process.stdin.flush()


def _prefix(name: str) -> str:
    """Return a function of bash that is called by each job in place of Python."""
    client = f"{sys.executable} -I -S {shlex.quote(str(CLIENT))} {name}"
    asking = f'command {client} {sys.executable} "$@"'
    return f"set -euo pipefail; {sys.executable}() {{ {asking}; }};"


def end(process: subprocess.Popen) -> None:
    """End the process and its jobs."""
    with suppress(BrokenPipeError):
        process.stdin.close()
    process.terminate()  # while it still imports, it does not look at its input
    process.wait()
