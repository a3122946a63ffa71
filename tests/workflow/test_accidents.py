"""What happens to a folder of results: copies, dry runs, disks that are read-only or full."""

import os
import shutil
import subprocess

import pytest
from helpers import ROOT, planned, skip, snakemake


def test_a_copy_that_lost_its_times_reruns_nothing(full_run, tmp_path):
    """`cp -r` gives files new times, so that results seem older than what they are made from."""
    datasets = shutil.copytree(full_run, tmp_path / "made", copy_function=shutil.copy)
    for path in datasets.glob("results/kernels/*"):
        os.utime(path)
    assert planned(ROOT, datasets, "figures") == {}


@pytest.fixture
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


@pytest.mark.parametrize("read_only", ["", ".snakemake"], ids=["all", "its notes"], indirect=True)
def test_a_dry_run_in_a_read_only_folder_says_what_it_needs(read_only, tmp_path):
    result = snakemake(ROOT, tmp_path / "here", "--dry-run", "fig1")
    assert result.returncode != 0
    output = result.stdout + result.stderr
    assert f"{read_only} is read-only" in output and "--directory" in output
    assert "Traceback" not in output and "OSError" not in output


@pytest.mark.parametrize("read_only", ["results", "results/logs"], indirect=True)
def test_a_run_whose_results_are_read_only_says_so_before_any_job(read_only, tmp_path):
    result = snakemake(ROOT, tmp_path / "here", "fig1")
    assert result.returncode == 1
    assert f"{read_only} is read-only: make it writable, or give another" in result.stderr
    assert "Traceback" not in result.stderr and "Drawing" not in result.stderr
    assert snakemake(ROOT, tmp_path / "here", "--dry-run", "fig1").returncode == 0
