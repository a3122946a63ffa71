"""What a dataset holds of its runs as a table in CSV, for spreadsheets and other programs."""

import csv
from itertools import product
from pathlib import Path
from typing import Any

import numpy as np

from . import DatasetError, complete_or_absent

AS_COLUMNS = "component", "conserved_quantity", "quantity", "statistic", "window"
"""Dimensions with a column for each of their values; each place on the others is a row."""


def write_csv(path: str | Path, dataset) -> None:
    """Write the norms of a run or sweep, or what a survey kept of each run, as a table.

    Its rows are the places on the axes of the first variable of an xarray.Dataset: the times, the
    half-widths, or the runs. Each column has its units in brackets. What has other axes, such as
    the snapshots of a run, is left out. Raises DatasetError where nothing can stand in a table.
    """
    first = next(iter(dataset.data_vars.values()), None)
    rows = [name for name in getattr(first, "dims", ()) if name not in AS_COLUMNS]
    columns = _axes(dataset, rows) if rows else {}
    for name, values in dataset.data_vars.items():
        if columns and {*rows} == {*values.dims} - {*AS_COLUMNS}:
            columns |= _columns(name, values, rows)
    if len(columns) <= len(rows):
        raise DatasetError(f"could not write {path}: the dataset has no norms and nothing kept")
    with complete_or_absent(path) as partial, open(partial, "w", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(columns)
        writer.writerows(zip(*columns.values(), strict=True))


def _axes(dataset, rows: list[str]) -> dict[str, list]:
    """Return the values of each axis at all places, the last axis fastest."""
    variables = [dataset[name] for name in rows]
    grids = np.meshgrid(*(np.arange(variable.size) for variable in variables), indexing="ij")
    pairs = zip(variables, grids, strict=True)
    return {
        _head(variable.name, variable): variable.values[grid.ravel()].tolist()
        for variable, grid in pairs
    }


def _columns(name: str, values, rows: list[str]) -> dict[str, list]:
    """Return the columns of a variable: one for each place on its other dimensions."""
    column_dimensions = [dimension for dimension in values.dims if dimension not in rows]
    columns = {}
    for place in product(*(values[dimension].values.tolist() for dimension in column_dimensions)):
        chosen = values.sel(dict(zip(column_dimensions, place, strict=True))).transpose(*rows)
        columns[_head(" ".join([name, *map(str, place)]), values)] = chosen.values.ravel().tolist()
    return columns


def _head(name: Any, values) -> str:
    return f"{name} [{values.attrs.get('units', '1')}]"
