"""How DOP853 measures the error of a step: by its largest component, in units of the tolerance."""

from math import sqrt

import numpy as np

from pendula.compiled import kernel
from pendula.simd import largest_magnitude

from .dop853_tableau import E3, E5


@kernel
def weighted_norm(v, y, w, spare, tolerances, sites):
    """Return the largest modulus in `v`, each relative to atol + rtol max(|y|, |w|).

    Only the columns of `sites` (first, stop) count; `spare` has room for a number for each.
    """
    (rtol, atol), squares, size = tolerances, spare.reshape(-1), np.uint64(0)
    first, count = np.uint64(sites[0]), np.uint64(sites[1] - sites[0])  # never from the end
    for re in range(0, v.shape[0], 2):
        im = re + 1
        for i in range(count):
            j = first + i
            before = y[re, j] * y[re, j] + y[im, j] * y[im, j]
            after = w[re, j] * w[re, j] + w[im, j] * w[im, j]
            scale = atol + rtol * sqrt(max(before, after))
            squares[size + i] = (v[re, j] * v[re, j] + v[im, j] * v[im, j]) / (scale * scale)
        size += count
    return sqrt(largest_magnitude(squares[:size]))


@kernel
def weigh(k, e, out):
    """Write the combination of stages 1 and 6 to 12 that an error estimate is made of (flat)."""
    k1, k6, k7, k8, k9, k10, k11, k12 = k[0], k[5], k[6], k[7], k[8], k[9], k[10], k[11]
    for i in range(out.size):
        out[i] = (
            e[0] * k1[i] + e[1] * k6[i] + e[2] * k7[i] + e[3] * k8[i]
            + e[4] * k9[i] + e[5] * k10[i] + e[6] * k11[i] + e[7] * k12[i]
        )  # fmt: skip


@kernel
def estimates(y, w, k, scratch, spare, tolerances, sites):
    """Return the estimates of orders five and three of the error on `sites` (first, stop)."""
    k_flat, flat = k.reshape(16, -1), scratch.reshape(-1)
    weigh(k_flat, E5, flat)
    fifth = weighted_norm(scratch, y, w, spare, tolerances, sites)
    weigh(k_flat, E3, flat)
    return fifth, weighted_norm(scratch, y, w, spare, tolerances, sites)


@kernel
def step_error(h, fifth, third):
    """Return the error of a step in units of the tolerance, infinite where it is not finite."""
    if not fifth + third < np.inf:
        return np.inf
    if fifth == 0.0:
        return 0.0
    return h * fifth * fifth / sqrt(fifth * fifth + 0.01 * third * third)


@kernel
def worse(one, other):
    """Return the larger of two, or the one that is not a number: max() would drop it."""
    return other if other > one or other != other else one
