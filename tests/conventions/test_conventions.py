"""Every dataset of a full run keeps the CF conventions, by a checker that other people maintain."""

import json
from functools import cache

import netCDF4
import pytest
from helpers import package

PINS = "-r tests/conventions/requirements.txt"
runner = package("compliance_checker.runner", PINS)
util = package("compliance_checker.cf.util", PINS)

CONVENTIONS = "cf:1.11"


@pytest.fixture(scope="module", autouse=True)
def checkers():
    """Load the checkers, and the table of standard names once: each file would read it twice."""
    runner.CheckSuite.load_all_available_checkers()
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(util, "StandardNameTable", cache(util.StandardNameTable))
        yield


def faults_of(path, folder):
    """Return what the checker finds wrong with one file, errors and warnings alike."""
    report = folder / "report.json"
    runner.ComplianceChecker.run_checker(
        str(path), [CONVENTIONS], 0, "normal", output_filename=str(report), output_format="json"
    )
    groups = json.loads(report.read_text())[CONVENTIONS]["all_priorities"]
    return [message for group in groups for message in group["msgs"]]


def form_of(path):
    """Return all of a file that the checker reads but for the values of its variables."""
    with netCDF4.Dataset(path) as data:
        variables = [
            (name, str(array.dtype), array.dimensions, sorted(array.__dict__.items(), key=str))
            for name, array in data.variables.items()
        ]
        return repr((sorted(data.ncattrs()), variables))


def test_every_dataset_of_a_full_run_keeps_the_conventions(full_run, tmp_path):
    """Of files that differ in values alone, such as those of six cases, it reads one."""
    paths = sorted((full_run / "results").rglob("*.nc"))
    assert len(paths) > 60
    forms = {form_of(path): path for path in paths}
    faults = {path.name: faults_of(path, tmp_path) for path in forms.values()}
    assert {name: messages for name, messages in faults.items() if messages} == {}


def test_the_checker_finds_units_that_nobody_parses(full_run, tmp_path):
    """The control: the same file with the units that rates once had is refused."""
    path = tmp_path / "wrong.nc"
    path.write_bytes((full_run / "results/trajectories/fig2_small.nc").read_bytes())
    with netCDF4.Dataset(path, "a") as data:
        data["energy"].units = "1/tau"
    assert any("UDUNITS" in message for message in faults_of(path, tmp_path))
