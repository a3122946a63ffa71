"""One job's function runs in a Python session with the arguments of its rule."""

import pytest
import xarray as xr
from helpers import ROOT, run_ready
from latticode.datasets.netcdf import as_xarray
from matplotlib.figure import Figure
from pendula.workflow import debug
from pendula.workflow.debug import job

QUICK = ("--configfile", str(ROOT / "config/quick.yaml"))


@pytest.fixture
def in_run(full_run, monkeypatch):
    monkeypatch.chdir(full_run)
    return full_run


@pytest.fixture
def fork(monkeypatch):
    """Let Snakemake plan a job in a fork; the test of a dataset starts it as a user does."""
    monkeypatch.setattr(debug.subprocess, "run", lambda command, **_: run_ready(command))


def test_a_dataset_comes_out_as_the_job_writes_it(in_run):
    threshold = job("results/pendula/threshold.nc", *QUICK)
    data = as_xarray(*threshold.call())
    with xr.open_dataset(in_run / "results/pendula/threshold.nc") as written:
        for name in data.data_vars:
            xr.testing.assert_equal(data[name], written[name])
    assert threshold.rule == "find_threshold" and "epsilon" in threshold.arguments


def test_all_runs_of_a_study_and_a_figure_are_made_in_the_session(in_run, fork):
    fates = job("results/breathers/fates.nc", *QUICK)
    variables, _ = fates.call()
    with xr.open_dataset(in_run / "results/breathers/fates.nc") as written:
        assert (variables["fate"].values == written["fate"].values).all()
    assert isinstance(job("results/figures/fates.png", *QUICK).call(), Figure)


def test_what_is_absent_is_named_with_the_command_that_makes_it(tmp_path, monkeypatch, fork):
    monkeypatch.chdir(tmp_path)
    with pytest.raises(
        FileNotFoundError, match=r"type `snakemake results/breathers/fates\.nc` first"
    ):
        job("results/figures/fates.png", *QUICK)
    with pytest.raises(ValueError, match=r"(?s)no job for results/nothing\.nc: .*Missing"):
        job("results/nothing.nc", *QUICK)
