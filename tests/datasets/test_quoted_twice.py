"""What is published in two places is the same number in both: every place reads one dataset."""

from itertools import combinations

import numpy as np
import xarray as xr
from latticode.datasets.netcdf import read

FOLDERS = ("checks", "figures", "unbounded")
KEYS = {"case", "sweep"}
"""Along these coordinates a variable says what it is of; others mean another thing in each file."""


def test_no_quantity_of_a_run_differs_between_two_of_its_datasets(full_run):
    """A quantity is a name, a long name and dimensions; ensembles by two solvers share none."""
    held = {}
    for path in [path for name in FOLDERS for path in (full_run / "results" / name).glob("*.nc")]:
        data = read(path)
        for name, variable in data.data_vars.items():
            if KEYS & set(variable.dims):
                quantity = name, variable.attrs.get("long_name"), frozenset(variable.dims)
                drawn = data.attrs.get("ensemble")
                drawn = drawn and (drawn, data.attrs["solver"], data.attrs.get("solver_step"))
                held.setdefault(quantity, []).append((path, drawn, variable))
    differing = []
    for (name, *_), holders in held.items():
        for (left, ensemble, a), (right, another, b) in combinations(holders, 2):
            a, b = xr.align(a, b.transpose(*a.dims), join="inner")
            same = np.array_equal(a, b, equal_nan=a.dtype.kind == "f")
            if len({ensemble, another} - {None}) < 2 and not same:
                differing.append(f"{name}: {left} and {right}")
    assert {"horizon", "relative_width"} <= {name for name, *_ in held}
    assert differing == []
