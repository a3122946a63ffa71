"""Norms and kept results of runs as CSV tables, for spreadsheets and other programs."""

import csv
from itertools import product
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from . import DatasetError, complete_or_absent

if TYPE_CHECKING:
    from xarray import DataArray, Dataset

AS_COLUMNS = "component", "conserved_quantity", "quantity", "statistic", "window"
"""Each value of these dimensions becomes a column; the other dimensions become rows."""


def write_csv(path: str | Path, dataset: "Dataset") -> None:
    """Write the norms of a run or sweep, or the kept results of a survey, as a table.

    A row is a point on the axes of the first variable: a time, a half-width, or a run. The heading
    of a column has its units in brackets. Variables with other axes, such as snapshots, are left
    out. Raises DatasetError if no variable fits the table.
    """
    first = next(iter(dataset.data_vars.values()), None)
    rows = [name for name in getattr(first, "dims", ()) if name not in AS_COLUMNS]
    columns = _axes(dataset, rows) if rows else {}
    for name, values in dataset.data_vars.items():
        if columns and {*rows} == {*values.dims} - {*AS_COLUMNS}:
            columns |= _columns(name, values, rows)
    if len(columns) <= len(rows):
        raise DatasetError(f"could not write {path}: the dataset has no norms or kept results")
    with complete_or_absent(path) as partial, open(partial, "w", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(columns)
        writer.writerows(zip(*columns.values(), strict=True))


def _axes(dataset: "Dataset", rows: list[str]) -> dict[str, list]:
    """Return the columns of the axes `rows`: the value of each axis in every row of the table.

    The last axis varies fastest.
    """
    variables = [dataset[name] for name in rows]
    grids = np.meshgrid(*(np.arange(variable.size) for variable in variables), indexing="ij")
    pairs = zip(variables, grids, strict=True)
    return {
        _head(variable.name, variable): variable.values[grid.ravel()].tolist()
        for variable, grid in pairs
    }


def _columns(name: str, values: "DataArray", rows: list[str]) -> dict[str, list]:
    """Return the columns of a variable, one for each point on its dimensions that are not rows."""
    column_dimensions = [dimension for dimension in values.dims if dimension not in rows]
    columns = {}
    for place in product(*(values[dimension].values.tolist() for dimension in column_dimensions)):
        chosen = values.sel(dict(zip(column_dimensions, place, strict=True))).transpose(*rows)
        columns[_head(" ".join([name, *map(str, place)]), values)] = chosen.values.ravel().tolist()
    return columns


def _head(name: Any, values: "DataArray") -> str:
    return f"{name} [{values.attrs.get('units', '1')}]"
