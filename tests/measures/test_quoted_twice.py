"""What is published in two places is the same number in both: every place reads one dataset."""

import re
from itertools import combinations
from pathlib import Path

import numpy as np
import pytest
import xarray as xr
from pendula.datasets.json_files import load_json
from pendula.datasets.netcdf import read

BASELINE = Path(__file__).parents[1] / "baseline"
FOLDERS = ("checks", "figures", "unbounded")
KEYS = {"case", "sweep"}
"""Along these coordinates a variable says what it is of; others mean another thing in each file."""


def shared(datasets: dict[str, xr.Dataset]):
    """Yield (name, file, values, file, values) of each quantity that two datasets hold.

    Two variables are one quantity where they have the same name, long name and dimensions, among
    them one of KEYS; they are aligned over the coordinates that both have. Two ensembles, which
    name themselves in their attributes, share no quantity.
    """
    held = {}
    for file, data in datasets.items():
        for name, one in data.data_vars.items():
            if KEYS & set(one.dims):
                quantity = name, one.attrs.get("long_name"), frozenset(one.dims)
                held.setdefault(quantity, []).append((file, data.attrs.get("ensemble"), one))
    for (name, *_), holders in held.items():
        for (one, ensemble, a), (other, another, b) in combinations(holders, 2):
            if len({ensemble, another} - {None}) < 2:
                a, b = xr.align(a, b.transpose(*a.dims), join="inner")
                if a.size:
                    yield name, one, a.values, other, b.values


def differing(quantities) -> list[str]:
    """Return those quantities of `shared` that differ between two datasets, named with both."""
    return [
        f"{name}: {one} and {other}"
        for name, one, a, other, b in quantities
        if not np.array_equal(a, b, equal_nan=a.dtype.kind == "f")
    ]


def test_a_quantity_that_differs_between_two_datasets_is_found():
    about = {"long_name": "divergence time"}
    first = xr.Dataset({"time": ("case", [7.4, np.inf], about)}, {"case": ["a", "b"]})
    second = xr.Dataset({"time": ("case", [np.inf, 7.4], about)}, {"case": ["b", "a"]})
    assert differing(shared({"one": first, "other": second})) == []
    second["time"][1] = 7.5
    assert differing(shared({"one": first, "other": second})) == ["time: one and other"]


def test_no_quantity_of_a_run_differs_between_two_of_its_datasets(full_run):
    paths = [path for folder in FOLDERS for path in (full_run / "results" / folder).glob("*.nc")]
    datasets = {path.relative_to(full_run).as_posix(): read(path) for path in sorted(paths)}
    quantities = list(shared(datasets))
    named = {name for name, *_ in quantities}
    assert {"divergence_time", "horizon", "divergence_measured"} <= named
    assert differing(quantities) == []


def test_the_table_quotes_the_dataset_of_the_solvers(full_run):
    results: Path = full_run / "results"
    solvers = read(results / "checks/solvers.nc")
    table = (results / "tables/solvers.md").read_text()
    papers = solvers.sel(pair="ode45 - crank_nicolson", solver="ode45", span="whole")
    for case in map(str, solvers["case"].values):
        one = papers.sel(case=case)
        time, drift = float(one["divergence_time"]), float(one["largest_drift"])
        drifts, times = re.findall(rf"^\| {case} .*$", table, re.MULTILINE)
        assert f"{drift:.1e}" in drifts
        assert ("never" if time == np.inf else f"{time:.1f}") in times.split("|")[2]


def test_the_ledger_measures_what_the_dataset_of_the_solvers_holds():
    """Both are those of the accepted full run: a short run decides nothing on the energy."""
    solvers = read(BASELINE / "checks/solvers.nc")
    rows = load_json(BASELINE / "claims.json")["rows"]
    measured = {row["name"]: row["measured"] for row in rows}
    papers = solvers.sel(pair="ode45 - crank_nicolson", solver="ode45", span="whole")
    for case in map(str, solvers["case"].values):
        one = papers.sel(case=case)
        quoted = measured["second_solver"][f"divergence_{case}"]
        assert float(str(quoted).replace("infinite", "inf")) == pytest.approx(
            float(one["divergence_time"]), rel=1e-5
        )
        drift = measured[f"energy_{case.rpartition('_')[2]}"][case]
        assert drift == pytest.approx(float(one["largest_drift"]), rel=1e-5)
