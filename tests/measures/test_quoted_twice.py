"""What is published in two places is the same number in both: every place reads one dataset."""

from itertools import combinations

import numpy as np
import xarray as xr
from pendula.datasets.netcdf import read

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
