"""What happens to a folder of results: copies, dry runs, disks that are read-only or full."""

import os
import shutil
import subprocess

import pytest
from helpers import ROOT, planned_with, skip, snakemake, snakemake_with

CASE = {"omega": 8, "initial": {0: [1, 0.1]}, "end_time": 2, "solver": "ode45"}
SETTINGS = {"cases": {"mine": CASE}}
TARGETS = ["results/trajectories/mine.nc", "results/trajectories/mine.taylor.nc"]


@pytest.fixture(scope="module")
def small_run(tmp_path_factory):
    """Return a folder with two trajectories, made once for all tests of this file."""
    folder = tmp_path_factory.mktemp("small_run")
    result = snakemake_with(SETTINGS, ROOT, folder, *TARGETS)
    assert result.returncode == 0, result.stderr
    return folder


@pytest.fixture
def made(small_run, tmp_path):
    return shutil.copytree(small_run, tmp_path / "made")


def test_a_copy_that_lost_its_times_reruns_nothing(small_run, tmp_path):
    """`cp -r` gives files new times, so that results seem older than what they are made from."""
    made = shutil.copytree(small_run, tmp_path / "made", copy_function=shutil.copy)
    for path in made.glob("results/kernels/*"):
        os.utime(path)
    assert planned_with(SETTINGS, ROOT, made, *TARGETS) == {}


def test_a_tolerance_reruns_what_uses_it_and_compiles_nothing(made):
    changed = SETTINGS | {"solvers": {"ode45": {"rtol": 1e-5}}}
    assert planned_with(changed, ROOT, made, *TARGETS) == {"trajectory": 1}
    others = ["check_stability", "check_bounds", "hard_cases"]
    before = planned_with(SETTINGS, ROOT, made, *others)
    assert "compile_solver" in before  # of the solvers that the small run did without
    shutil.copytree(made / "results/kernels", made / "kept")
    for solver in ("crank_nicolson", "delfour_fortin_payre", "dop853"):
        shutil.copy(made / "kept/taylor.txt", made / f"results/kernels/{solver}.txt")
    assert "compile_solver" not in planned_with(changed, ROOT, made, *others)


def test_who_only_looks_leaves_the_folder_as_it_is(looked):
    assert {path.name for path in (looked / "folder").iterdir()} <= {".snakemake"}


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
