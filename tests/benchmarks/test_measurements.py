"""Small measurements are whole, and the words on the kept ones follow from them."""

from itertools import product

import numpy as np
import pytest
from helpers import ROOT
from latticode.datasets.netcdf import as_xarray, read
from latticode.simulation.simulate import simulate
from problems import problem_of
from waiting import HANGS

from benchmarks import contestants, cost, pendula
from benchmarks.contestants import OURS

FOLDER = ROOT / "tests/baseline/speed"


def test_a_time_is_that_of_a_site_and_a_step(monkeypatch):
    monkeypatch.setattr(cost, "SITES", (5, 101))
    monkeypatch.setattr(cost, "WORK", 101)
    monkeypatch.setattr(cost, "timed", lambda action: (None, 5.0))
    seconds = as_xarray(cost.measure(), {})["seconds"]
    for start, sites, solver in product(cost.STARTS, (5, 101), cost.SOLVERS):
        steps = simulate(cost.STARTS[start](sites, solver)).outcome.steps
        assert seconds.sel(start=start, sites=sites, solver=solver) == 5.0 / sites / steps


def test_one_pair_moves_at_the_start_of_a_quiet_chain():
    moving = [np.abs(chain(11, "taylor").initial) > 0 for chain in cost.STARTS.values()]
    assert moving[0].all() and moving[1].sum() == 2 and moving[1][:, 5].all()


# --- The kept measurements ------------------------------------------------------------------------


@pytest.fixture(scope="module")
def timings():
    return read(FOLDER / "work_precision.nc")


def least_times(timings, error):
    """Return the least time (case, solver) within an error, NaN where a solver misses it."""
    solvers = timings.sel(contestant=timings["solver"].values)
    return solvers["seconds"].where(solvers["error"] <= error).min("point").values


def test_the_page_on_speed_says_in_words_what_was_measured(timings):
    """No method but that of Taylor in C++ is faster. `taylor` is our fastest below the error that
    the configuration names, by the geometric mean over the cases."""
    faster = {str(peer) for peer in timings["peer"].values[timings["mean_ratio"].values < 1.0]}
    assert faster and all(peer.startswith("cpp_taylor") for peer in faster)
    comment = (ROOT / "config/config.yaml").read_text(encoding="utf-8").partition("taylor:")[0]
    assert "for errors of 1e-3 and below" in comment
    for error in (1e-3, 1e-5, 1e-8, 1e-11):
        means = np.log(least_times(timings, error)).mean(axis=0)  # NaN where a case is missed
        assert timings["solver"].values[np.nanargmin(means)] == "taylor", error


def test_the_dataset_of_the_pendula_is_whole(monkeypatch):
    monkeypatch.setattr(pendula, "END_TIME", 0.02)
    monkeypatch.setattr(pendula, "OURS", {"taylor": pendula.OURS["taylor"]})
    for name, seconds in {"PATIENCE": HANGS, "LIMIT": HANGS}.items():
        monkeypatch.setattr(contestants, name, seconds)  # on a busy machine too
    problems = {"fig3_small": problem_of("fig3_small", half_width=2)}
    measured = as_xarray(pendula.measure(problems, {"again": OURS["dop853"]}, print), {})
    committed = read(FOLDER / "pendula.nc")
    assert set(committed.variables) <= set(measured.variables)
    assert float(measured["error"].min()) < 1e-10 and measured["ratio"].item() > 0.1
    for name in committed.variables:
        assert measured[name].attrs == committed[name].attrs, name
