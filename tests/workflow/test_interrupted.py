"""A run that is killed goes on where it was, to the same bits.

The tests of the executor, of jobs and of kernels interrupt by Ctrl-C.
"""

import os
import signal
import subprocess

import yaml
from helpers import ROOT, command_of, snakemake
from waiting import wait_for

TARGETS = "results/trajectories/fig3_large.nc", "results/sweeps/fig5_left.nc"
LOG = "results/logs/sweeps/fig5_left.log"


def kill_in_a_long_chain(folder):
    """Start a run with chains that take hours, and kill it and its jobs when two are done."""
    settings = yaml.safe_load((ROOT / "config/quick.yaml").read_text())
    settings["sweeps"]["fig5_left"]["half_widths"] = [4, 8, *range(30000, 30010)]
    (folder / "mine.yaml").write_text(yaml.safe_dump(settings))
    command = command_of(ROOT, folder, folder / "mine.yaml", *TARGETS, "--cores", "1")
    with open(folder / "said.txt", "w") as output:
        process = subprocess.Popen(command, stdout=output, stderr=output, start_new_session=True)
        log = folder / LOG
        try:
            wait_for(
                lambda: (
                    (log.exists() and "2 of 12 runs of " in log.read_text())
                    or process.poll() is not None
                )
            )
            assert process.poll() is None, (folder / "said.txt").read_text()
        finally:
            if process.poll() is None:
                os.killpg(process.pid, signal.SIGKILL)
            process.wait()


def test_a_run_that_was_killed_goes_on_to_the_same_files(full_run, tmp_path):
    kill_in_a_long_chain(tmp_path)
    output = tmp_path / "said.txt"
    wait_for(lambda: "To continue, run snakemake --unlock" in output.read_text())
    assert "ConnectionResetError" not in output.read_text()
    assert snakemake(ROOT, tmp_path, "--unlock").returncode == 0  # nothing else could
    result = snakemake(ROOT, tmp_path, *TARGETS)
    assert result.returncode == 0, result.stderr
    assert "Compiling" not in result.stderr  # done in the first run
    files = (path for path in tmp_path.glob("results/**/*") if path.is_file())
    results = {path.relative_to(tmp_path).as_posix() for path in files}
    assert {
        name for name in results if not name.startswith(("results/kernels", "results/logs"))
    } == {*TARGETS}
    for name in TARGETS:
        assert (tmp_path / name).read_bytes() == (full_run / name).read_bytes()
