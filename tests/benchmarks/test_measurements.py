"""Small measurements are whole, and the words on the kept ones follow from them."""

import json
import subprocess
import sys
from itertools import product

import numpy as np
import pytest
from helpers import ROOT
from latticode.datasets.netcdf import as_xarray, read
from latticode.simulation.simulate import simulate
from problems import problem_of
from waiting import HANGS

from benchmarks import contestants, cost, pendula, reproduction, scale
from benchmarks.contestants import OURS
from benchmarks.peer import Peer

FOLDER = ROOT / "tests/baseline/speed"


def test_a_time_is_that_of_a_site_and_a_step(monkeypatch):
    monkeypatch.setattr(cost, "SITES", (5, 101))
    monkeypatch.setattr(cost, "WORK", 101)
    monkeypatch.setattr(cost, "timed", lambda action: (None, 5.0))
    monkeypatch.setattr(cost, "measure_peers", dict)
    seconds = as_xarray(cost.measure(), {})["seconds"]
    for start, sites, solver in product(cost.STARTS, (5, 101), cost.SOLVERS):
        steps = simulate(cost.STARTS[start](sites, solver)).outcome.steps
        assert seconds.sel(start=start, sites=sites, solver=solver) == 5.0 / sites / steps


def test_one_pair_moves_at_the_start_of_a_quiet_chain():
    moving = [np.abs(chain(11, "taylor").initial) > 0 for chain in cost.STARTS.values()]
    assert moving[0].all() and moving[1].sum() == 2 and moving[1][:, 5].all()


def test_a_copy_of_the_project_runs_its_own_code(tmp_path, monkeypatch):
    """Python would import the installed project, which another copy rejects."""
    for package in ("packages/latticode/latticode", "scripts/pendula", "benchmarks"):
        (tmp_path / package).mkdir(parents=True)
        (tmp_path / package / "__init__.py").touch()
    packages = "latticode, pendula, benchmarks"
    program = f"import {packages}; print(*(package.__file__ for package in ({packages})))"
    outputs, run = [], subprocess.run

    def recorded(command, **options):
        done = run([sys.executable, "-c", program], **options)
        outputs.append(done.stdout.split())
        return done

    monkeypatch.setattr(reproduction.subprocess, "run", recorded)
    reproduction.run(tmp_path)
    assert len(outputs[0]) == 3 and all(path.startswith(str(tmp_path)) for path in outputs[0])


def test_peers_run_from_one_pair_on_chains_of_these_lengths(monkeypatch):
    sites = []

    def prepare(problem):
        sites.append(problem.sites)
        assert np.count_nonzero(problem.initial) == 2 and problem.end_time == 10.0
        return lambda tolerance: (None, 3.0)

    peer, absent = Peer("slow", lambda: None, prepare), Peer("", lambda: "not installed", prepare)
    monkeypatch.setattr(cost, "PEERS", {"slow": peer, "absent": absent})
    monkeypatch.setattr(cost, "PEERS_OF_ONE_PAIR", ("absent", "slow"))
    monkeypatch.setattr(cost, "LENGTHS", (5, 7))
    monkeypatch.setattr(cost, "timed", lambda action: (action(), 1.5))
    measured = as_xarray(cost.measure_peers(), {})
    assert sites == [5, 7] and measured["peer"].values.tolist() == ["slow"]
    assert (measured["ratio"] == 2.0).all()


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


def test_the_page_on_surveys_says_in_words_what_batches_save():
    rows = json.loads(scale.WRITTEN.read_text(encoding="utf-8"))["surveys"]["rows"]
    ratio = {sites: in_batch / alone for sites, alone, in_batch in rows}
    page = (ROOT / "packages/latticode/docs/surveys.md").read_text(encoding="utf-8")
    assert "3 sites then takes about a third of the time, and one of 11 sites six tenths" in page
    assert round(3 * ratio[3]) == 1 and round(10 * ratio[11]) == 6
