"""Matrices that couple the sites of a chain, converted to plain values.

A matrix becomes {"sites": N, "rows": [...], "columns": [...], "weights": [...]}: its nonzero
entries, sorted by row and then by column. Sums over a row therefore have one order and the same
bits for every input format.
"""

from collections.abc import Mapping
from typing import Any

import numpy as np

from .model_file import call_on_sites, chain_sites

Entries = Mapping[str, Any]
"""A matrix as plain values, with the keys sites, rows, columns and weights."""


def entries_of(matrix: Any, sites: range) -> Entries:
    """Return the nonzero entries of an N x N matrix that couples the sites of a chain.

    `matrix` is an array, nested lists, a matrix of scipy.sparse, a function of the array of sites
    that returns any of these, or `Entries`. Raises ValueError for any other shape or type and for
    values that are not finite; callers put "parameter W" before the message.
    """
    if callable(matrix):
        matrix = call_on_sites(matrix, np.array(sites))
    if isinstance(matrix, Mapping):
        if matrix.keys() != {"sites", "rows", "columns", "weights"}:
            raise ValueError("is a mapping; give a matrix as nested lists or an array")
        _require_sites((matrix["sites"], matrix["sites"]), len(sites))
        return matrix
    rows, columns, weights = _nonzero(matrix, len(sites))
    wrong = np.flatnonzero(~np.isfinite(weights))
    if wrong.size:
        place = f"({sites[rows[wrong[0]]]}, {sites[columns[wrong[0]]]})"
        raise ValueError(f"is {weights[wrong[0]]:g} at the sites {place}, which is not finite")
    order = np.lexsort((columns, rows))
    return {
        "sites": len(sites),
        "rows": rows[order].tolist(),
        "columns": columns[order].tolist(),
        "weights": weights[order].astype(float).tolist(),
    }


def _nonzero(matrix: Any, count: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return the rows, columns and values of the nonzero entries of a matrix."""
    if hasattr(matrix, "tocoo"):
        _require_sites(matrix.shape, count)
        sparse = matrix.tocsr().tocoo()  # tocsr() adds up duplicate entries
        rows, columns, weights = sparse.row, sparse.col, sparse.data
    else:
        try:
            matrix = np.asarray(matrix)
        except ValueError:
            raise ValueError("is a matrix with rows of different lengths") from None
        _require_sites(matrix.shape, count)
        rows, columns = np.nonzero(matrix)
        weights = matrix[rows, columns]
    if weights.dtype.kind not in "iufb":
        hint = "; give real and imaginary parts as two matrices" * (weights.dtype.kind == "c")
        raise ValueError(f"is a matrix of type {weights.dtype}; couple needs real numbers{hint}")
    return rows, columns, weights


def _require_sites(shape: tuple[int, ...], count: int) -> None:
    if shape != (count, count):
        size = " x ".join(map(str, shape)) or "one number"
        raise ValueError(f"is {size}; couple needs a {count} x {count} matrix for {count} sites")


def at_middle(values: Any, half_width: int) -> Any:
    """Return the values of a parameter on the middle sites -M..M of a longer chain."""
    if isinstance(values, Mapping):
        return _middle_of(values, half_width)
    if np.ndim(values) == 0:
        return values
    margin = len(values) // 2 - half_width
    return values[margin : len(values) - margin]


def _middle_of(entries: Entries, half_width: int) -> Entries:
    """Return the entries of a longer chain's matrix that couple two of the sites -M..M."""
    margin, count = entries["sites"] // 2 - half_width, len(chain_sites(half_width))
    rows, columns = (np.array(entries[name], int) - margin for name in ("rows", "columns"))
    inside = (rows >= 0) & (rows < count) & (columns >= 0) & (columns < count)
    return {
        "sites": count,
        "rows": rows[inside].tolist(),
        "columns": columns[inside].tolist(),
        "weights": np.array(entries["weights"], float)[inside].tolist(),
    }


def largest_row_sum(entries: Entries) -> float:
    """Return the largest row sum of magnitudes; the maximum norm induces this matrix norm."""
    weights = np.abs(np.array(entries["weights"], float))
    sums = np.bincount(np.array(entries["rows"], int), weights, minlength=1)
    return float(sums.max())
