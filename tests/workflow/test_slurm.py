"""The whole quick run by a real Slurm on this machine: the same numbers as without it."""

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
import xarray as xr
import yaml
from helpers import HANGS, ROOT, command_of, package, planned, skip

CLUSTER = ROOT / "tests/slurm/small_cluster.py"
PROFILE = yaml.safe_load((ROOT / "profiles/slurm/profile.yaml").read_text())
THIS_MACHINE = {"cores", "scheduler", "executor", "forked-modules"}
"""What profiles/default says of the jobs of one machine: a cluster has a queue of its own."""
TOPICS = ("trajectories", "sweeps", "checks", "unbounded")


@pytest.fixture(scope="module")
def slurm_run(tmp_path_factory) -> Path:
    """Return a folder with the results of a quick run through profiles/slurm."""
    daemons = ("slurmctld", "slurmd", "munged")
    path = f"{os.environ['PATH']}:/usr/sbin"
    if absent := [name for name in daemons if not shutil.which(name, path=path)]:
        skip(
            f"there is no Slurm here: {', '.join(absent)} missing",
            "apt-get install slurm-wlm munge",
        )
    package("snakemake_executor_plugin_slurm", "-r profiles/slurm/requirements.txt")
    directory = tmp_path_factory.mktemp("slurm")
    # A cluster without accounting, and jobs so short that waiting to ask for them would double it
    options = ["--slurm-status-command=squeue", "--slurm-init-seconds-before-status-checks=3"]
    profile = ["--workflow-profile", str(ROOT / "profiles/slurm")]
    run = command_of(ROOT, directory, ROOT / "config/quick.yaml", *profile, *options)
    command = [sys.executable, str(CLUSTER), *run]
    done = subprocess.run(command, capture_output=True, text=True, timeout=6 * HANGS)
    assert done.returncode == 0, done.stdout + done.stderr
    (directory / "said.txt").write_text(done.stdout + done.stderr)
    return directory


def test_datasets_have_the_same_content_as_without_slurm(full_run, slurm_run):
    names = [
        path.relative_to(full_run)
        for topic in TOPICS
        for path in sorted((full_run / "results" / topic).glob("*.nc"))
    ]
    assert len(names) > 60
    for name in names:
        with xr.open_dataset(full_run / name) as here, xr.open_dataset(slurm_run / name) as there:
            xr.testing.assert_identical(here, there)


def test_every_figure_is_there(full_run, slurm_run):
    drawn = {path.name for path in (full_run / "results/figures").iterdir()}
    assert {path.name for path in (slurm_run / "results/figures").iterdir()} == drawn
    assert planned(ROOT, slurm_run) == {}


def test_jobs_went_to_slurm_in_groups(slurm_run):
    submitted = (slurm_run / "said.txt").read_text().count("has been submitted with SLURM jobid")
    assert 10 <= submitted <= 30


def test_every_kind_of_job_is_in_a_group():
    base = (ROOT / "workflow/rules/base.smk").read_text()
    groups = re.findall(r'group:\n        "(\w+)"', base)
    assert groups == list(PROFILE["group-components"]) and len(groups) == base.count("script:")


def test_the_profile_reruns_what_the_default_profile_does():
    default = yaml.safe_load((ROOT / "profiles/default/profile.yaml").read_text())
    assert all(PROFILE[key] == default[key] for key in default.keys() - THIS_MACHINE)


def test_the_plugin_is_pinned_and_no_part_of_the_environment():
    pins = (ROOT / "profiles/slurm/requirements.txt").read_text().splitlines()
    names = [pin.split("==")[0] for pin in pins if not pin.startswith("#")]
    assert all("==" in pin for pin in pins if not pin.startswith("#"))
    assert not any(name in (ROOT / "environment.txt").read_text() for name in names)
