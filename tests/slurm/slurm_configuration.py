"""What the daemons of a Slurm of one node need to know, in a folder of their own."""

import getpass
import os
import shutil
import socket
import subprocess
from pathlib import Path

PATHS = f"{os.environ['PATH']}:/usr/sbin"
SEARCHED = {**os.environ, "PATH": PATHS}
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


def configure(folder: Path) -> dict[str, str]:
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
    """Return a plugin that needs no cgroups here; newer versions know one that does nothing."""
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
