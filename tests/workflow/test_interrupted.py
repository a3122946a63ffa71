"""A run that is killed goes on where it was, to the same bits.

The tests of the executor, of jobs and of kernels interrupt by Ctrl-C.
"""

import os
import signal
import subprocess
from hashlib import sha256

import yaml
from helpers import ROOT, command_of, snakemake
from waiting import wait_for

CASE = {"omega": 0, "initial": {0: [5, 1]}, "end_time": 20, "solver": "dop853"}
TARGETS = "results/trajectories/mine.nc", "results/sweeps/mine.nc"
WINDOWS = [(1, 15)]


def settings(*half_widths):
    sweep = {"case": "mine", "half_widths": [4, 8, *half_widths], "windows": WINDOWS}
    return {"cases": {"mine": CASE}, "sweeps": {"mine": sweep}}


SHORT, HOURS = settings(), settings(*range(30000, 30010))


def hashes(folder):
    """Return the hash of every result, hidden ones too, but for logs and kernels."""
    others = {folder / "results" / name for name in ("kernels", "logs")}
    files = [path for path in folder.rglob("results/**/*") if path.is_file()]
    kept = [path for path in files if others.isdisjoint(path.parents)]
    return {str(path.relative_to(folder)): sha256(path.read_bytes()).hexdigest() for path in kept}


def kill_in_a_long_chain(folder):
    """Start a run of hours, and kill it and its jobs when two of twelve chains are done."""
    (folder / "mine.yaml").write_text(yaml.safe_dump(HOURS))
    command = command_of(ROOT, folder, folder / "mine.yaml", *TARGETS, "--cores", "1")
    with open(folder / "said.txt", "w") as said:
        process = subprocess.Popen(command, stdout=said, stderr=said, start_new_session=True)
        log = folder / "results/logs/sweeps/mine.log"
        try:
            wait_for(
                lambda: (
                    (log.exists() and "2 of 12 runs done" in log.read_text())
                    or process.poll() is not None
                )
            )
            assert process.poll() is None, (folder / "said.txt").read_text()
        finally:
            if process.poll() is None:
                os.killpg(process.pid, signal.SIGKILL)
            process.wait()


def test_a_run_that_was_killed_goes_on_to_the_same_files(tmp_path):
    whole, ended = tmp_path / "whole", tmp_path / "ended"
    ended.mkdir()
    kill_in_a_long_chain(ended)
    assert snakemake(ROOT, ended, "--unlock", settings=SHORT).returncode == 0  # nothing else could
    result = snakemake(ROOT, ended, *TARGETS, settings=SHORT)
    assert result.returncode == 0, result.stderr
    assert "Compiling" not in result.stderr  # done in the first run
    whole.mkdir()
    assert snakemake(ROOT, whole, *TARGETS, settings=SHORT).returncode == 0
    assert hashes(ended) == hashes(whole)
