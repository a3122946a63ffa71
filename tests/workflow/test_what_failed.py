"""The last lines of a run say why each job failed, also where the job itself could not."""

import subprocess

import pytest
from helpers import ROOT, edit, skip, snakemake
from pendula.workflow.failures import NO_LOG, NO_REASON, causes_of_failures

TARGETS = "results/pendula/threshold.nc", "fig1", "results/kernels/dop853.txt"


def test_an_import_that_fails_and_a_signal_are_told_and_the_rest_is_made(clone, tmp_path):
    edit(clone / "scripts/dataset.py", "from latticode.datasets.netcdf", "import absent\nfrom p")
    edit(
        clone / "scripts/figure.py",
        "    gather = gather_for",
        "    import os; os.kill(os.getpid(), 9)\n    gather = gather_for",
    )
    folder = tmp_path / "folder"
    folder.mkdir()
    result = snakemake(clone, folder, "--keep-going", *TARGETS)
    assert result.returncode == 1
    last, log = result.stderr.splitlines()[-4:], folder / "results/logs/pendula/threshold.log"
    assert (output := "ModuleNotFoundError: No module named 'absent'") in last
    assert f"  (more in {log})" in last
    assert log.read_text().startswith(f"failed: {output}\nTraceback")
    assert (folder / TARGETS[-1]).exists()
    assert any("killed by SIGKILL (out of memory?)" in line for line in last), last
    assert NO_REASON not in result.stderr


@pytest.mark.parametrize("quiet", ["--quiet=rules", "--quiet=all"])
def test_a_run_that_was_told_to_be_quiet_ends_with_the_reason_too(clone, tmp_path, quiet):
    """Snakemake then leaves the errors of jobs out of its own log, and all else by `all`."""
    edit(clone / "scripts/figure.py", "    gather = ", "    1 / 0\n    gather = ")
    (folder := tmp_path / "folder").mkdir()
    result = snakemake(clone, folder, quiet, "fig1")
    log = folder / "results/logs/figures/fig1.log"
    assert result.returncode == 1
    assert result.stderr.splitlines()[-2:] == [
        "ZeroDivisionError: division by zero",
        f"  (more in {log})",
    ]


def test_a_call_that_is_rejected_gives_its_reason_by_quiet_all_too(tmp_path):
    result = snakemake(ROOT, tmp_path, "--quiet=all", "--config", "bits=x")
    assert result.returncode == 1
    assert result.stderr.count("bits=x: the only allowed value is any") == 1


@pytest.fixture
def small_disk(tmp_path):
    """Return a folder on a disk of 3 MB."""
    (folder := tmp_path / "disk").mkdir()
    mount = ["mount", "-t", "tmpfs", "-o", "size=3m", "none", str(folder)]
    if subprocess.run(mount, capture_output=True).returncode:
        skip("only root may mount a small disk", "run the tests as root")
    yield folder
    subprocess.run(["umount", str(folder)], check=True)


FILL = """    import contextlib
    with contextlib.suppress(OSError), open("fill", "wb", buffering=0) as fill:
        while fill.write(bytes(512)):
            pass
    gather = gather_for"""


def test_a_disk_that_is_full_is_the_reason(clone, small_disk):
    """Not even a line of a log fits on it then, of the job or of Snakemake."""
    edit(clone / "scripts/figure.py", "    gather = gather_for", FILL)
    result = snakemake(clone, small_disk, "fig1", "results/kernels/dop853.txt")
    assert result.returncode == 1
    assert "No space left on device (is the disk full? " in result.stderr
    last, log = result.stderr.splitlines()[-2:], small_disk / "results/logs/figures/fig1.log"
    # The job beside it may free a page after the first message, and then the log has its line.
    assert last[0] == NO_LOG or "(is the disk full? " in last[0]
    assert last[1] == f"  (more in {log})"
    repeated = snakemake(clone, small_disk, "fig1")
    assert repeated.returncode == 1 and "Traceback" not in repeated.stderr
    assert f"cannot write to {small_disk}" in repeated.stderr


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
        "killed by SIGKILL (out of memory?): try fewer --cores",
    ),
    ("FAILED", "", "returned non-zero exit status 137.\n", "killed by SIGKILL (out of"),
    ("FAILED", "", "returned non-zero exit status 74.\n", NO_LOG),
    ("FAILED", "", "returned non-zero exit status 143.\n", "killed by SIGTERM (by a user"),
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
        "Slurm ended job 7 (TIMEOUT) at its time limit",
    ),
    ("OUT_OF_MEMORY", "", "", "--set-resources sweep:mem_mb=MB"),
    ("CANCELLED", "", "", "scancel"),
    ("NODE_FAIL", "", "", "(NODE_FAIL) because its node failed"),
    ("BOOT_FAIL", "", "", "Slurm: job 7 is BOOT_FAIL"),
]


@pytest.mark.parametrize(("state", "log", "screen", "cause"), REASONS)
def test_the_reason_of_a_job_of_slurm(tmp_path, state, log, screen, cause):
    (tmp_path / "own.log").write_text(log)
    (tmp_path / "slurm.log").write_text(screen)
    ((reason, more),) = causes_of_failures(SLURM.format(state=state, folder=tmp_path))
    assert cause in reason
    assert more == str(tmp_path / ("own.log" if log or not screen else "slurm.log"))
