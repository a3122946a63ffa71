"""A Slurm of one node on this machine, for as long as a command takes.

    python tests/slurm/small_cluster.py snakemake --workflow-profile profiles/slurm

Needs slurmctld, slurmd and munge (Debian: slurm-wlm, munge) and no systemd, database or cgroups.
Everything that the daemons write lies in a folder of their own, which is gone afterwards.
"""

import ctypes
import getpass
import os
import secrets
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from pathlib import Path

PATHS = f"{os.environ['PATH']}:/usr/sbin"
SEARCHED = {**os.environ, "PATH": PATHS}
PROGRAMS = ("slurmctld", "slurmd", "munged", "sbatch", "srun")
CONFIGURATION = """
ClusterName=small
SlurmctldHost={host}(127.0.0.1)
SlurmctldPort={controller}
SlurmdPort={node}
SlurmUser={user}
SlurmdUser={user}
AuthType=auth/munge
AuthInfo=socket={folder}/munge/socket
CredType=cred/munge
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/slurmd.pid
PlugStackConfig={folder}/plugstack.conf
MpiDefault=none
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU_Memory
SchedulerParameters=batch_sched_delay=0,sched_min_interval=100000,bf_interval=1
# Finished jobs stay in the list: without accounting, Snakemake asks the list for their state.
MinJobAge=3600
NodeName={host} NodeAddr=127.0.0.1 CPUs={cpus} RealMemory={memory}
PartitionName=small Nodes=ALL Default=YES MaxTime=INFINITE State=UP
"""


def missing() -> list[str]:
    """Return the programs that are not installed."""
    return [name for name in PROGRAMS if not shutil.which(name, path=PATHS)]


@contextmanager
def small_cluster() -> Iterator[dict[str, str]]:
    """Start the daemons, give the environment that talks to them, and stop them in any case."""
    with ExitStack() as stack:
        folder = Path(stack.enter_context(tempfile.TemporaryDirectory(prefix="slurm-")))
        folder.chmod(0o755)
        environment = _configure(folder)
        stack.enter_context(_munge(folder))
        for daemon in ("slurmctld", "slurmd"):
            stack.enter_context(_daemon([daemon, "-D"], folder, environment))
        stack.callback(subprocess.run, ["scancel", "--user", getpass.getuser()], env=environment)
        _wait(folder, environment)
        yield environment


def _configure(folder: Path) -> dict[str, str]:
    """Write the configuration, and return the environment that names it."""
    for name in ("state", "spool", "munge", "bin"):
        (folder / name).mkdir(mode=0o755)
    memory = os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES") // 2**20
    text = CONFIGURATION.format(
        folder=folder,
        host=socket.gethostname().split(".")[0],
        user=getpass.getuser(),
        controller=_free_port(),
        node=_free_port(),
        cpus=os.cpu_count(),
        memory=memory * 9 // 10,
    )
    (folder / "slurm.conf").write_text(text)
    (folder / "cgroup.conf").write_text(f"CgroupPlugin={_cgroup_plugin()}\n")
    (folder / "plugstack.conf").touch(mode=0o644)
    _wrap_srun(folder)
    paths = f"{folder}/bin:{PATHS}"
    return {**os.environ, "PATH": paths, "SLURM_CONF": str(folder / "slurm.conf")}


def _cgroup_plugin() -> str:
    """Return one that needs no cgroups: to disable it is known since 23.11 only."""
    version = subprocess.run(["slurmd", "-V"], capture_output=True, text=True, env=SEARCHED)
    return "disabled" if version.stdout.split()[-1] >= "23.11" else "cgroup/v1"


def _wrap_srun(folder: Path) -> None:
    """Let srun find the configuration: Snakemake takes SLURM_CONF out of its environment."""
    wrapper = folder / "bin/srun"
    program = shutil.which("srun", path=PATHS)
    wrapper.write_text(f'#!/bin/sh\nSLURM_CONF={folder}/slurm.conf exec {program} "$@"\n')
    wrapper.chmod(0o755)


def _free_port() -> int:
    with socket.socket() as found:
        found.bind(("127.0.0.1", 0))
        return found.getsockname()[1]


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
    def idle() -> bool:
        asked = subprocess.run(
            ["sinfo", "--noheader", "-o", "%T"], env=environment, capture_output=True, text=True
        )
        return asked.stdout.strip() == "idle"

    _until(idle, "the node of Slurm does not come up", folder)


def _until(done, fault: str, folder: Path, seconds: float = 30.0) -> None:
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
