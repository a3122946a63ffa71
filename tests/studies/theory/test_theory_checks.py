"""Every check holds, and says so in a form that a file can keep."""

import numpy as np
import pytest
import xarray as xr
from helpers import ROOT, chosen
from pendula.datasets.checks import broken, variable
from pendula.datasets.netcdf import read
from pendula.studies.theory.checks import CHECKS, run_check
from pendula.studies.theory.settings import GROUPS


@pytest.mark.parametrize("name", CHECKS)
def test_check_holds(name, checked):
    assert broken(checked(name)) == {}


@pytest.mark.parametrize("name", CHECKS)
def test_check_holds_at_the_sizes_of_the_full_run(name):
    """They take a minute, so that the accepted results stand for them."""
    assert broken(read(ROOT / f"tests/baseline/checks/{name}.nc").to_dict()) == {}


def test_checks_are_repeatable(numbers):
    again = run_check("samples", chosen("theory", "quick").samples.model_dump())["data_vars"]
    np.testing.assert_array_equal(numbers("samples", "sampled"), again["sampled"]["data"])


def test_table_becomes_a_dataset(tmp_path, checked):
    ds = xr.Dataset.from_dict(checked("theorem_3_constant"))
    ds.to_netcdf(tmp_path / "check.nc")
    again = xr.load_dataset(tmp_path / "check.nc")
    xr.testing.assert_identical(ds, again)
    assert all({"long_name", "units"} <= set(v.attrs) for v in again.data_vars.values())


def test_groups_hold_every_check_once():
    assert sorted(name for group in GROUPS.values() for name in group) == sorted(CHECKS)


@pytest.mark.parametrize("value", [2.0, np.nan, np.inf])
def test_values_above_tolerance_or_no_numbers_break_a_check(value):
    check = {"data_vars": {"error": variable([0.0, value], ("x",), "error", tolerance=1.0)}}
    assert "error" in broken(check)
