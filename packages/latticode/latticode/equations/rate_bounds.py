"""Upper bounds of the rates at which the fields of a model rotate or grow.

The bounds predict the cost of a run and whether it is feasible. They are not results: their last
bits may depend on the processor.
"""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from .couplings import largest_row_sum
from .graph import Node, derivative, evaluate, leaves_in, number

Slopes = tuple[list[int], tuple[Node, ...]]
"""The row of each field value that is read, and the derivatives of all rates by this value."""


def slopes_of(rates: tuple[Node, ...]) -> Slopes:
    """Return the derivatives of `rates` (row,) with respect to each row and site that they read."""
    columns, changes = [], []
    for entry in leaves_in(rates, "field"):
        component, re_im, _ = entry.operands
        columns.append(2 * component + re_im)
        changes += derivative(rates, lambda leaf, entry=entry: number(leaf is entry))
    return columns, tuple(changes)


def bound_rates(
    rows: int, slopes: Slopes, parameters: Mapping[str, Any], peaks: Sequence[float]
) -> list[float]:
    """Return upper bounds of the rate per unit time, one for each peak: see `Model.rates_at`."""
    sizes = {name: _size_of(value) for name, value in parameters.items()}
    each = np.array(peaks, float)

    def size(entry: Node) -> np.ndarray | np.float64:
        if entry.operation == "field":
            return each
        named = entry.operands[0] if entry.operands else None
        return np.float64(named if entry.operation == "number" else sizes.get(named, 1.0))

    columns, changes = slopes
    matrices = np.zeros((each.size, rows, rows))
    with np.errstate(all="ignore"):
        values = [np.abs(value) + np.zeros_like(each) for value in evaluate(changes, size)]
        for column, change in zip(columns, np.reshape(values, (-1, rows, each.size)), strict=True):
            matrices[:, :, column] += change.T
        at_rest = matrices[each == 0.0]
        matrices[each == 0.0] = np.nan_to_num(at_rest, nan=0.0, posinf=0.0)
        return _largest_eigenvalues(matrices).tolist()


def _size_of(value: Any) -> float:
    """Return the largest magnitude of a parameter, or the largest row sum of a matrix."""
    if isinstance(value, Mapping):
        return largest_row_sum(value)
    if hasattr(value, "tocoo") or np.ndim(value) == 2:
        return float(abs(value).sum(axis=1).max())
    return float(np.abs(value).max())


def _largest_eigenvalues(matrices: np.ndarray) -> np.ndarray:
    """Return upper bounds of the largest eigenvalues of matrices (matrix, row, row) of sizes.

    A bound is the 64th root of the norm of the 64th power. The norm itself would be too coarse:
    x'' = -k x oscillates at sqrt(k), but the norm of its matrix is k. If an entry is not finite,
    the bound is that entry.
    """
    bounds, exponent, first = 1.0, 1.0, matrices.max(axis=(1, 2))
    for _ in range(6):
        largest = matrices.max(axis=(1, 2))
        largest[largest == 0.0] = 1.0
        bounds, matrices = bounds * largest**exponent, matrices / largest[:, None, None]
        matrices, exponent = matrices @ matrices, 0.5 * exponent
    bounds *= matrices.sum(axis=2).max(axis=1) ** exponent
    return np.where(np.isfinite(first), bounds, first)
