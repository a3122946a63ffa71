"""A run that is ended at any moment, kindly or not, goes on where it was, to the same bits."""

import os
import signal
import subprocess
from hashlib import sha256

import yaml
from helpers import ROOT, command_of, snakemake
from waiting import wait_for

CASE = {"omega": 0, "initial": {0: [5, 1]}, "end_time": 20, "solver": "dop853"}
TRAJECTORY, SWEEP = TARGETS = "results/trajectories/mine.nc", "results/sweeps/mine.nc"
WINDOWS = [(1, 15)]
LOG = "results/logs/sweeps/mine.log"


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


def end_when(happened, how, folder):
    """Start a run of hours, end it and its jobs by a signal as soon as `happened(folder)`.

    Return what it said.
    """
    (folder / "mine.yaml").write_text(yaml.safe_dump(HOURS))
    with open(folder / "said.txt", "w") as said:
        process = subprocess.Popen(
            # one job at a time: while another starts, Ctrl-C would find it among its imports
            command_of(ROOT, folder, folder / "mine.yaml", *TARGETS, "--cores", "1"),
            stdout=said,
            stderr=said,
            start_new_session=True,
            # tests that run in the background of a shell ignore interrupts, and so would this run
            preexec_fn=lambda: signal.signal(signal.SIGINT, signal.default_int_handler),
        )
        try:
            wait_for(lambda: happened(folder) or process.poll() is not None)
            assert process.poll() is None, (folder / "said.txt").read_text()
            os.killpg(process.pid, how)  # as Ctrl-C in a terminal does
            wait_for(lambda: process.poll() is not None)
        finally:
            if process.poll() is None:
                os.killpg(process.pid, signal.SIGKILL)
    assert process.returncode != 0
    return (folder / "said.txt").read_text()


def is_sweeping(folder):
    return f"Computing {SWEEP}" in (folder / "said.txt").read_text()


def is_in_a_long_chain(folder):
    log = folder / LOG
    return log.exists() and "2 of 12 runs done" in log.read_text()


def test_a_run_ended_at_any_moment_goes_on_to_the_same_files(tmp_path):
    whole, ended = tmp_path / "whole", tmp_path / "ended"
    ended.mkdir()
    end_when(is_sweeping, signal.SIGKILL, ended)
    assert snakemake(ROOT, ended, "--unlock", settings=HOURS).returncode == 0  # nothing else could
    said = end_when(is_in_a_long_chain, signal.SIGINT, ended)
    assert "Traceback" not in said and "interrupted: run the same command again" in said
    assert not list(ended.glob("results/sweeps/*")) + list(ended.glob("results/sweeps/.*"))
    result = snakemake(ROOT, ended, *TARGETS, settings=SHORT)
    assert result.returncode == 0, result.stderr
    assert "Compiling" not in result.stderr  # done in the first run
    whole.mkdir()
    assert snakemake(ROOT, whole, *TARGETS, settings=SHORT).returncode == 0
    assert hashes(ended) == hashes(whole)
