"""The quick run on another machine, played on this one: the same files to the last bit.

It takes minutes, with kernels that are compiled anew, so it belongs to a release. The ordinary
tests ask the same of every solver and of some datasets in seconds: see tests/test_same_bits.py.
"""

import os

import machines
import pytest
from helpers import ROOT, skip, snakemake
from unlike import unlike

ASKED = "PENDULA_QUICK_RUN_ON"


@pytest.fixture(scope="session")
def machine():
    """Return the machine that ASKED names; its scope is that of `full_run`, to skip before it."""
    if not (name := os.environ.get(ASKED)):
        skip("a quick run on another machine takes minutes", "run .ci/elsewhere quick")
    if why := machines.why_not(name):
        skip(why, machines.ELSEWHERE)
    return name


@pytest.fixture(scope="session")
def runs(machine, full_run, made_once):
    """Return the results of a quick run here, and of one on the other machine."""

    def make(directory):
        cores = f"--cores={machines.PLAYED[machine].cores}"
        result = snakemake(ROOT, directory, cores, env=machines.environment(machine))
        assert result.returncode == 0, result.stdout + result.stderr

    return full_run / "results", made_once(f"{machine}_run", make) / "results"


def test_datasets(runs):
    assert unlike(*runs, ".nc") == []


def test_claims_controls_tables_and_what_is_written_beside_figures(runs):
    assert unlike(*runs, ".json", ".md", ".txt") == []


def test_pictures(runs):
    assert unlike(*runs, ".png", ".pdf") == []
