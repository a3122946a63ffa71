"""The profile for Slurm: its plugin takes it, kinds of jobs have groups, versions are pinned."""

import re

import yaml
from helpers import ROOT, package, planned

PROFILE = yaml.safe_load((ROOT / "profiles/slurm/profile.yaml").read_text())
THIS_MACHINE = {"cores", "scheduler", "executor", "forked-modules"}
"""What profiles/default says of the jobs of one machine: a cluster has a queue of its own."""


def test_the_plugin_plans_the_same_jobs_as_a_run_on_one_machine(tmp_path):
    package("snakemake_executor_plugin_slurm", "-r profiles/slurm/requirements.txt")
    by_slurm = planned(ROOT, tmp_path, "--workflow-profile", str(ROOT / "profiles/slurm"))
    assert by_slurm == planned(ROOT, tmp_path)


def test_every_kind_of_job_is_in_a_group():
    base = (ROOT / "workflow/rules/base.smk").read_text()
    groups = re.findall(r'group:\n        "(\w+)"', base)
    assert len(groups) == base.count("script:")
    assert PROFILE["group-components"].keys() < set(groups)


def test_the_profile_reruns_what_the_default_profile_does():
    default = yaml.safe_load((ROOT / "profiles/default/profile.yaml").read_text())
    assert all(PROFILE[key] == default[key] for key in default.keys() - THIS_MACHINE)


def test_the_plugin_is_pinned_and_no_part_of_the_environment():
    pins = (ROOT / "profiles/slurm/requirements.txt").read_text().splitlines()
    names = [pin.split("==")[0] for pin in pins if not pin.startswith("#")]
    assert all("==" in pin for pin in pins if not pin.startswith("#"))
    assert not any(name in (ROOT / "environment.txt").read_text() for name in names)
