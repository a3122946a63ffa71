"""The last lines of a run say why each job failed, also where the job itself could not."""

import pytest
from helpers import edit, snakemake
from reasons import WORDLESS, why_jobs_failed

TARGETS = "results/pendula/threshold.nc", "fig1", "results/kernels/dop853.txt"


def test_an_import_that_fails_and_a_signal_are_told_and_the_rest_is_made(clone, tmp_path):
    edit(clone / "scripts/dataset.py", "from latticode.datasets.netcdf", "import absent\nfrom p")
    edit(
        clone / "scripts/figure.py",
        "    files = {",
        "    import os; os.kill(os.getpid(), 9)\n    files = {",
    )
    folder = tmp_path / "folder"
    folder.mkdir()
    result = snakemake(clone, folder, "--keep-going", *TARGETS)
    assert result.returncode == 1
    last, log = result.stderr.splitlines()[-4:], folder / "results/logs/pendula/threshold.log"
    assert (said := "ModuleNotFoundError: No module named 'absent'") in last
    assert f"  (more in {log})" in last
    assert log.read_text().startswith(f"failed: {said}\nTraceback")
    assert (folder / TARGETS[-1]).exists()
    assert any("killed by SIGKILL: the system does this if memory" in line for line in last), last
    assert WORDLESS not in result.stderr


SLURM = """
Error in rule sweep:
    message: SLURM-job '7' failed, SLURM status is: '{state}'. Detailed failure reason ...
    jobid: 3
    output: results/sweeps/mine.nc
    log: {folder}/own.log, {folder}/slurm.log (check log file(s) for error details)
    external_jobid: 7
"""
STEP = "slurmstepd-n2: error: StepId=41.0 exceeded memory limit (1168646144 > 1048576000), being"
REASONS = [
    ("FAILED", "failed: wrong: why\nTraceback\n", "srun: error: n1: task 0: Exited", "wrong: w"),
    ("FAILED", "", f"Reason\n{STEP} killed\nsrun: error: n2: task 0: Killed\n", STEP),
    (
        "FAILED",
        "",
        "Command x died with <Signals.SIGKILL: 9>\nsrun: error: n",
        "killed by SIGKILL: the system does this if memory runs out",
    ),
    ("FAILED", "", "returned non-zero exit status 137.\n", "killed by SIGKILL: the system"),
    ("FAILED", "", "returned non-zero exit status 143.\n", "killed by SIGTERM: a person"),
    ("FAILED", "", "srun: error: Unable to create step: More processors\n", "srun: error: Unable"),
    (
        "FAILED",
        "",
        "  File x\nModuleNotFoundError: No module named 'y'\n",
        "ModuleNotFoundError: N",
    ),
    (
        "TIMEOUT",
        "interrupted: run\nTraceback\n",
        "",
        "Slurm ended job 7 (TIMEOUT): its limit of time",
    ),
    ("OUT_OF_MEMORY", "", "", "--set-resources sweep:mem_mb=MB"),
    ("CANCELLED", "", "", "scancel"),
    ("NODE_FAIL", "", "", "its node was lost"),
    ("BOOT_FAIL", "", "", "Slurm: job 7 is BOOT_FAIL"),
]


@pytest.mark.parametrize(("state", "own", "screen", "says"), REASONS)
def test_the_reason_of_a_job_of_slurm(tmp_path, state, own, screen, says):
    (tmp_path / "own.log").write_text(own)
    (tmp_path / "slurm.log").write_text(screen)
    ((reason, more),) = why_jobs_failed(SLURM.format(state=state, folder=tmp_path))
    assert says in reason
    assert more == str(tmp_path / ("own.log" if own or not screen else "slurm.log"))
