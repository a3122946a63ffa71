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


def test_a_copy_that_lost_its_times_and_snakemakes_notes_reruns_nothing(small_run, tmp_path):
    made = shutil.copytree(small_run, tmp_path / "made", copy_function=shutil.copy)
    shutil.rmtree(made / ".snakemake")
    for path in [*made.glob("results/code/*"), *made.glob("results/kernels/*")]:
        os.utime(path)  # in the copy, what results are made from is newer than they are
    assert planned_with(SETTINGS, ROOT, made, *TARGETS) == {}


def test_a_tolerance_reruns_what_uses_it_and_compiles_nothing(made):
    changed = SETTINGS | {"solvers": {"ode45": {"rtol": 1e-5}}}
    assert planned_with(changed, ROOT, made, *TARGETS) == {"own_trajectory": 1}
    others = ["check_stability", "check_bounds", "hard_cases"]
    before = planned_with(SETTINGS, ROOT, made, *others)
    assert "compile_solver" in before  # of the solvers that the small run did without
    shutil.copytree(made / "results/kernels", made / "kept")
    for solver in ("crank_nicolson", "delfour_fortin_payre", "dop853"):
        shutil.copy(made / "kept/taylor.txt", made / f"results/kernels/{solver}.txt")
    assert "compile_solver" not in planned_with(changed, ROOT, made, *others)


def test_who_only_looks_leaves_the_folder_as_it_is(looked):
    """A dry run, and a call of the list of targets."""
    assert {path.name for path in (looked / "folder").iterdir()} <= {".snakemake"}


@pytest.mark.parametrize("name", ["results", "results/figures"])
def test_a_file_in_the_way_of_a_folder_is_named(tmp_path, name):
    (tmp_path / name).parent.mkdir(exist_ok=True)
    (tmp_path / name).write_text("mine")
    result = snakemake(ROOT, tmp_path, "fig1")
    assert result.returncode != 0 and (tmp_path / name).read_text() == "mine"
    assert f"{tmp_path / name} is a file, and results need a folder" in result.stderr
    assert "Traceback" not in result.stderr and ".smk" not in result.stderr


def test_results_on_a_disk_that_is_not_there_are_told(tmp_path):
    (tmp_path / "results").symlink_to(tmp_path / "scratch")
    result = snakemake(ROOT, tmp_path, "--dry-run", "fig1")
    assert result.returncode != 0
    assert (
        f"results is a link to {tmp_path / 'scratch'}, which is not there"
        in result.stdout + result.stderr
    )


@pytest.fixture
def read_only(tmp_path):
    """Return a folder that nobody can write to; for root it must lie on a read-only disk."""
    folder = tmp_path / "read_only"
    folder.mkdir()
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


def test_a_dry_run_in_a_read_only_folder_says_what_it_needs(read_only):
    result = snakemake(ROOT, read_only, "--dry-run", "fig1")
    assert result.returncode != 0
    said = result.stdout + result.stderr
    assert f"{read_only} is read-only" in said and "--directory" in said
    assert "Traceback" not in said and "OSError" not in said
