"""Weighted sums of slopes: the arguments of stages, error estimates and interpolants.

Each sum is computed from its first term to its last and has the bits of the formula written out.
Four vectors are summed in parallel, because each addition must wait for the previous one. The
weights are in a table: formulas written out would each be compiled into a loop that first tests
whether the output overlaps any of its inputs.
"""

from collections.abc import Mapping
from typing import Any, NamedTuple

import numpy as np

from latticode.kernels.compiled import inlined_by_llvm, kernel
from latticode.kernels.simd import LANES, load, store

Array = np.ndarray

STRIP = 4 * LANES
"""Number of neighbouring sums that are computed in parallel."""


class WeightTable(NamedTuple):
    """The nonzero weights of each row, with the indices (from 0) of the slopes they multiply."""

    weights: Array  # (row, term)
    stages: Array  # (row, term)
    terms: Array  # (row,), number of terms


def table(rows: Mapping[int, Mapping[int, float]], count: int) -> WeightTable:
    """Return a table of `count` rows from mappings of stages, numbered from 1, to weights."""
    longest = max(map(len, rows.values()))
    weight_table = WeightTable(
        np.zeros((count, longest)), np.zeros((count, longest), np.int64), np.zeros(count, np.int64)
    )
    for row, weights in rows.items():
        weight_table.terms[row] = len(weights)
        weight_table.weights[row, : len(weights)] = list(weights.values())
        weight_table.stages[row, : len(weights)] = [stage - 1 for stage in weights]
    return weight_table


@inlined_by_llvm
def sum_of_vectors(k: Array, weights: Array, stages: Array, size: int, i: int) -> Any:
    total = weights[0] * load(k, stages[0] * size + i)
    for term in range(1, weights.size):
        total = total + weights[term] * load(k, stages[term] * size + i)
    return total


@inlined_by_llvm
def sums_of_a_strip(
    k: Array, weights: Array, stages: Array, size: int, i: int
) -> tuple[Any, Any, Any, Any]:
    w, p = weights[0], stages[0] * size + i
    a, b = w * load(k, p), w * load(k, p + LANES)
    c, d = w * load(k, p + 2 * LANES), w * load(k, p + 3 * LANES)
    for term in range(1, weights.size):
        w, p = weights[term], stages[term] * size + i
        a, b = a + w * load(k, p), b + w * load(k, p + LANES)
        c, d = c + w * load(k, p + 2 * LANES), d + w * load(k, p + 3 * LANES)
    return a, b, c, d


@inlined_by_llvm
def put(y: Array, h: float, total: Any, out: Array, i: int) -> None:
    store(out, i, load(y, i) + h * total if y.size > 0 else h * total)


@kernel
def write_sum(rows: WeightTable, row: int, y: Array, h: float, k: Array, out: Array) -> None:
    """Write y + h sum_s weight_s k_s into `out`, with the weights of a row of the table.

    `k` (stage, number), `y` and `out` (number,) are contiguous and separate; an empty `y` is zero.
    """
    size, terms = out.size, rows.terms[row]
    weights, stages = rows.weights[row, :terms], rows.stages[row, :terms]
    if size < LANES:
        for i in range(size):
            total = weights[0] * k[stages[0], i]
            for term in range(1, weights.size):
                total += weights[term] * k[stages[term], i]
            out[i] = y[i] + h * total if y.size > 0 else h * total
        return
    i = 0
    while i + STRIP <= size:
        a, b, c, d = sums_of_a_strip(k, weights, stages, size, i)
        put(y, h, a, out, i)
        put(y, h, b, out, i + LANES)
        put(y, h, c, out, i + 2 * LANES)
        put(y, h, d, out, i + 3 * LANES)
        i += STRIP
    while i < size:  # the last vector may overlap the one before and rewrite the same bits
        j = min(i, size - LANES)
        put(y, h, sum_of_vectors(k, weights, stages, size, j), out, j)
        i += LANES
