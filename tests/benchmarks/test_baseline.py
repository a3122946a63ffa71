"""The measurements that the project keeps: tables follow from datasets, and words from both."""

import numpy as np
import pytest
from helpers import ROOT
from pendula.datasets.netcdf import read

from benchmarks.cost import BY_HAND
from benchmarks.tables import tabulate_cost, tabulate_work_precision

FOLDER = ROOT / "tests/baseline/speed"


@pytest.fixture(scope="module")
def measured():
    return read(FOLDER / "work_precision.nc")


@pytest.mark.parametrize(
    ("name", "tabulate"), [("work_precision", tabulate_work_precision), ("cost", tabulate_cost)]
)
def test_the_kept_tables_are_made_from_the_kept_datasets(name, tabulate):
    page = "\n\n".join(tabulate(read(FOLDER / f"{name}.nc"))) + "\n"
    assert (FOLDER / f"{name}.md").read_text(encoding="utf-8") == page


def least_times(measured, case, error):
    """Return the least time in which each solver comes within an error, NaN where it does not."""
    own = measured.sel(case=case, contestant=measured["solver"].values)
    return own["seconds"].where(own["error"] <= error).min("point").values


def test_the_least_times_follow_from_the_points(measured):
    for case in measured["case"].values:
        one = measured.sel(case=case)
        expected = least_times(measured, case, float(one["target"]))
        np.testing.assert_array_equal(one["best_seconds"], expected)


def test_mean_ratios_are_geometric(measured):
    for peer in measured["peer"].values:
        ratios = measured["ratio"].sel(peer=peer).dropna("case").values
        assert int(measured["reached_cases"].sel(peer=peer)) == len(ratios)
        mean = np.prod(ratios) ** (1 / len(ratios)) if len(ratios) else np.nan
        np.testing.assert_allclose(measured["mean_ratio"].sel(peer=peer), mean)


def test_no_method_but_that_of_taylor_in_cpp_is_faster_than_the_solvers_here(measured):
    """The page on speed says so in words."""
    ratios = measured["mean_ratio"].dropna("peer")
    faster = ratios["peer"].values[ratios.values < 1.0]
    assert set(faster) <= set(BY_HAND) and len(faster) > 0


def test_the_call_from_python_counts_in_short_runs_and_no_longer_in_long_ones():
    """The page on speed says so in words: in short runs the method in C++ gains by it."""
    ratios = read(FOLDER / "cost.nc")["by_hand_ratio"].dropna("by_hand")
    assert (ratios.isel(end_time=-1) > 2.0 * ratios.isel(end_time=0)).all()


def test_the_default_solver_is_the_fastest_below_the_error_that_the_configuration_names(measured):
    names, cases = list(measured["solver"].values), measured["case"].values
    comment = (ROOT / "config/config.yaml").read_text(encoding="utf-8").partition("taylor:")[0]
    assert "at errors of 1e-3 and below" in comment
    for error in (1e-3, 1e-5, 1e-8, 1e-11):
        fastest = {names[np.nanargmin(least_times(measured, case, error))] for case in cases}
        assert fastest == {"taylor"}, error
