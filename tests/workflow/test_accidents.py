"""What happens to a folder of results: copies, dry runs, disks that are read-only or full."""

import os
import shutil
import subprocess

import pytest
from helpers import ROOT, planned, skip, snakemake


def test_a_copy_that_lost_its_times_reruns_nothing(full_run, tmp_path):
    """`cp -r` gives files new times, so that results seem older than what they are made from."""
    made = shutil.copytree(full_run, tmp_path / "made", copy_function=shutil.copy)
    for path in made.glob("results/kernels/*"):
        os.utime(path)
    assert planned(ROOT, made, "figures") == {}


def test_a_tolerance_reruns_what_uses_it_and_compiles_nothing(full_run, tmp_path):
    settings = {"cases": {"mine": {"omega": 8, "end_time": 2}}}
    before = planned(ROOT, tmp_path, "results/trajectories/mine.nc", settings=settings)
    assert before == {"compile_solver": 1, "trajectory": 1}
    solvers = ("--config", "solvers={dop853: {rtol: 1e-5}}")
    jobs = planned(ROOT, full_run, *solvers)
    assert jobs["measure_solvers"] == 1 and "compile_solver" not in jobs


def test_who_only_looks_leaves_the_folder_as_it_is(looked):
    assert {path.name for path in (looked / "folder").iterdir()} <= {".snakemake"}


def test_who_asks_for_the_graph_gets_nothing_else(tmp_path):
    result = snakemake(ROOT, tmp_path, "--dag")
    assert result.returncode == 0 and result.stdout.startswith("digraph"), result.stderr
    assert {path.name for path in tmp_path.iterdir()} <= {".snakemake"}


@pytest.fixture(params=["", ".snakemake"], ids=["the folder", "its notes"])
def read_only(request, tmp_path):
    """Return a folder that nobody can write to; for root it must lie on a read-only disk."""
    folder = tmp_path / "here" / request.param
    folder.mkdir(parents=True)
    if os.access("/", os.W_OK):
        mount = ["mount", "-t", "tmpfs", "-o", "ro,size=1m", "none", str(folder)]
        if subprocess.run(mount, capture_output=True).returncode:
            skip("root may write everywhere", "run the tests as another user")
        yield folder
        subprocess.run(["umount", str(folder)], check=True)
    else:
        folder.chmod(0o555)
        yield folder
        folder.chmod(0o755)


def test_a_dry_run_in_a_read_only_folder_says_what_it_needs(read_only, tmp_path):
    result = snakemake(ROOT, tmp_path / "here", "--dry-run", "fig1")
    assert result.returncode != 0
    said = result.stdout + result.stderr
    assert f"{read_only} is read-only" in said and "--directory" in said
    assert "Traceback" not in said and "OSError" not in said
