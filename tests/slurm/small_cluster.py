"""A Slurm of one node on this machine, for as long as a command takes.

    python tests/slurm/small_cluster.py snakemake --workflow-profile profiles/slurm

Needs slurmctld, slurmd and munge (Debian: slurm-wlm, munge) and no systemd, database or cgroups.
Everything that the daemons write lies in a folder of their own, which is gone afterwards.
"""

import ctypes
import getpass
import secrets
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from pathlib import Path

from slurm_configuration import PATHS, SEARCHED, configure

PROGRAMS = ("slurmctld", "slurmd", "munged", "sbatch", "srun")

HANGS = 600.0
"""Seconds after which something hangs: far more than anything here takes on a slow machine."""


def missing() -> list[str]:
    """Return the programs that are not installed."""
    return [name for name in PROGRAMS if not shutil.which(name, path=PATHS)]


@contextmanager
def small_cluster() -> Iterator[dict[str, str]]:
    """Start the daemons, give the environment that talks to them, and stop them in any case."""
    with ExitStack() as stack:
        folder = Path(stack.enter_context(tempfile.TemporaryDirectory(prefix="slurm-")))
        folder.chmod(0o755)
        environment = configure(folder)
        stack.enter_context(_munge(folder))
        for daemon in ("slurmctld", "slurmd"):
            stack.enter_context(_daemon([daemon, "-D"], folder, environment))
        stack.callback(_end_jobs, folder, environment)
        _wait(folder, environment)
        yield environment


@contextmanager
def _munge(folder: Path) -> Iterator[None]:
    key = folder / "munge/key"
    key.write_bytes(secrets.token_bytes(128))
    key.chmod(0o400)
    places = {"key-file": "key", "socket": "socket", "pid-file": "pid", "seed-file": "seed"}
    options = [f"--{option}={folder}/munge/{name}" for option, name in places.items()]
    command = ["munged", "--foreground", "--force", f"--log-file={folder}/munge/log", *options]
    with _daemon(command, folder, SEARCHED):
        _until(lambda: (folder / "munge/socket").exists(), "munged makes no socket", folder)
        yield


@contextmanager
def _daemon(command: list[str], folder: Path, environment: dict[str, str]) -> Iterator[None]:
    program = shutil.which(command[0], path=environment["PATH"]) or command[0]
    with open(folder / f"{command[0]}.log", "w") as log:
        process = subprocess.Popen(
            [program, *command[1:]],
            env=environment,
            stdin=subprocess.DEVNULL,
            stdout=log,
            stderr=log,
            preexec_fn=_end_with_parent,
            start_new_session=True,  # Ctrl-C is for the command: they are needed to stop its jobs
        )
    try:
        yield
    finally:
        process.terminate()
        try:
            process.wait(10)
        except subprocess.TimeoutExpired:
            process.kill()
            process.wait()


def _end_with_parent() -> None:
    """Let Linux end this process with the one that started it, even if that one is killed."""
    ctypes.CDLL(None).prctl(1, signal.SIGTERM)  # PR_SET_PDEATHSIG


def _wait(folder: Path, environment: dict[str, str]) -> None:
    command = ["sinfo", "--noheader", "--format=%T"]
    fault = "the node of Slurm does not come up"
    _until(lambda: _ask(command, environment) == "idle", fault, folder)


def _end_jobs(folder: Path, environment: dict[str, str]) -> None:
    """Stop what still runs, while there is a daemon that can."""
    _ask(["scancel", "--signal=KILL", "--full", "--user", getpass.getuser()], environment)
    _ask(["scancel", "--user", getpass.getuser()], environment)
    _until(lambda: not _ask(["squeue", "--noheader"], environment), "jobs do not end", folder)


def _ask(command: list[str], environment: dict[str, str]) -> str:
    asked = subprocess.run(command, env=environment, capture_output=True, text=True, timeout=HANGS)
    return asked.stdout.strip()


def _until(done, fault: str, folder: Path, seconds: float = HANGS) -> None:
    end = time.monotonic() + seconds
    while not done():
        if time.monotonic() > end:
            logs = [f"{log.name}:\n{log.read_text()}" for log in sorted(folder.rglob("*log"))]
            raise RuntimeError("\n".join([fault, *logs]))
        time.sleep(0.2)


if __name__ == "__main__":
    if absent := missing():
        sys.exit(f"{', '.join(absent)} missing; `apt-get install slurm-wlm munge` gives them")
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(143))
    with small_cluster() as environment:
        sys.exit(subprocess.run(sys.argv[1:], env=environment).returncode)
