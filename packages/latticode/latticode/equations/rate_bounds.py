"""Upper bounds of the rates at which the fields of a model rotate or grow.

The bounds predict the cost of a run and whether it is feasible. They are not results: their last
bits may depend on the processor.
"""

from collections.abc import Mapping
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


def bound_rate(rows: int, slopes: Slopes, parameters: Mapping[str, Any], peak: float) -> float:
    """Return an upper bound of the rate per unit time at amplitude `peak`: see `Model.rate`."""
    sizes = {name: _size_of(value) for name, value in parameters.items()}

    def size(entry: Node) -> float:
        if entry.operation == "number":
            return entry.operands[0]
        if entry.operation == "field":
            return peak
        return sizes.get(entry.operands[0], 1.0) if entry.operands else 1.0

    columns, changes = slopes
    with np.errstate(all="ignore"):
        values = np.abs(evaluate(changes, lambda entry: np.float64(size(entry))))
    sums = np.zeros((rows, rows))
    for column, change in zip(columns, values.reshape(-1, rows), strict=True):
        sums[:, column] += change
    if not peak and not np.isfinite(sums).all():
        sums = np.nan_to_num(sums, posinf=0.0)
    return _largest_eigenvalue(sums)


def _size_of(value: Any) -> float:
    """Return the largest magnitude of a parameter, or the largest row sum of a matrix."""
    if isinstance(value, Mapping):
        return largest_row_sum(value)
    if hasattr(value, "tocoo") or np.ndim(value) == 2:
        return float(abs(value).sum(axis=1).max())
    return float(np.abs(value).max())


def _largest_eigenvalue(matrix: np.ndarray) -> float:
    """Return an upper bound of the largest eigenvalue of a matrix without negative entries.

    The bound is the 64th root of the norm of the 64th power. The norm itself would be too coarse:
    x'' = -k x oscillates at sqrt(k), but the norm of its matrix is k.
    """
    bound, exponent = 1.0, 1.0
    for _ in range(6):
        largest = matrix.max()
        if not 0.0 < largest < np.inf:
            return float(largest) if largest else 0.0
        bound, matrix = bound * largest**exponent, matrix / largest
        matrix, exponent = matrix @ matrix, 0.5 * exponent
    return float(bound * matrix.sum(axis=1).max() ** exponent)
