"""Weighted sums of slopes: the arguments of stages, error estimates and interpolants.

Each sum goes from its first term to its last, so its bits are those of the formula written out.
Four vectors of numbers are summed side by side, since each addition waits for the one before it.
The weights lie in a table and not in the code: of each formula that is written out, LLVM makes a
loop of its own, which asks of every array that is read whether it overlaps the one that is written.
"""

from collections.abc import Mapping
from typing import NamedTuple

import numpy as np

from latticode.kernels.compiled import inlined_by_llvm, kernel
from latticode.kernels.simd import LANES, load, store

STRIP = 4 * LANES
"""Numbers that are summed at once."""


class WeightTable(NamedTuple):
    """Rows of weights that are not zero, and of the stages whose slopes they multiply, from 0."""

    weights: np.ndarray  # (row, term)
    stages: np.ndarray  # (row, term)
    terms: np.ndarray  # (row,), how many terms a row has


def table(rows: Mapping[int, Mapping[int, float]], count: int) -> WeightTable:
    """Return `count` rows, given as weights by stage, which are counted from 1 as in formulae."""
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
def sum_of_vectors(k, weights, stages, size, i):
    total = weights[0] * load(k, stages[0] * size + i)
    for term in range(1, weights.size):
        total = total + weights[term] * load(k, stages[term] * size + i)
    return total


@inlined_by_llvm
def sums_of_a_strip(k, weights, stages, size, i):
    w, p = weights[0], stages[0] * size + i
    a, b = w * load(k, p), w * load(k, p + LANES)
    c, d = w * load(k, p + 2 * LANES), w * load(k, p + 3 * LANES)
    for term in range(1, weights.size):
        w, p = weights[term], stages[term] * size + i
        a, b = a + w * load(k, p), b + w * load(k, p + LANES)
        c, d = c + w * load(k, p + 2 * LANES), d + w * load(k, p + 3 * LANES)
    return a, b, c, d


@inlined_by_llvm
def put(y, h, total, out, i):
    store(out, i, load(y, i) + h * total if y.size > 0 else h * total)


@kernel
def write_sum(rows, row, y, h, k, out):
    """Write y + h times the sum of a row's weights times slopes into `out`, which is another array.

    `k` is (stage, number), all arrays are contiguous; an empty `y` adds nothing.
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
    while i < size:  # the last vector overlaps the one before, and writes the same bits again
        j = min(i, size - LANES)
        put(y, h, sum_of_vectors(k, weights, stages, size, j), out, j)
        i += LANES
