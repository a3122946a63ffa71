"""Kernels that integrate tangent vectors with a solution and orthonormalise them at intervals.

A tangent vector is a small perturbation of a solution, to first order. Without orthonormalisation
all vectors would align with the fastest growing direction, and their lengths would overflow
(Benettin, Galgani, Giorgilli and Strelcyn, Meccanica 15 (1980) 9).

A bundle is an array (row, column) of stacked states: first the solution, then its tangent vectors.
Each state has the ghost columns of the chain.
"""

from collections.abc import Callable
from math import sqrt
from typing import Any

import numpy as np

from latticode.equations.ends import MIRROR
from latticode.integrators import DONE, dop853
from latticode.kernels.compiled import at_any_time, in_one_pass, kernel


@kernel
def inner(chain: Any, u: np.ndarray, v: np.ndarray) -> float:
    """Return the scalar product of two states over the whole chain, also if they store half."""
    total = 0.0
    for row in range(u.shape[0]):
        for j in range(1, u.shape[1] - 1):
            total += u[row, j] * v[row, j]
    if chain.left == MIRROR:
        centre = 0.0
        for row in range(u.shape[0]):
            centre += u[row, 1] * v[row, 1]
        total = 2.0 * total - centre
    return total


@kernel
def subtract(u: np.ndarray, factor: float, v: np.ndarray) -> None:
    """Subtract `factor` times `v` from `u`, in place."""
    for row in range(u.shape[0]):
        for j in range(1, u.shape[1] - 1):
            u[row, j] -= factor * v[row, j]


@kernel
def scale(u: np.ndarray, factor: float) -> None:
    """Multiply `u` by `factor`, in place."""
    for row in range(u.shape[0]):
        for j in range(1, u.shape[1] - 1):
            u[row, j] *= factor


@kernel
def orthonormalise(chain: Any, bundle: np.ndarray, lengths: np.ndarray) -> None:
    """Orthonormalise the tangent vectors in `bundle`, and write their `lengths` (vector,).

    This is the modified Gram-Schmidt method: the first vector keeps its direction, and the
    components along earlier vectors are subtracted from each later vector.
    """
    rows = bundle.shape[0] // (1 + lengths.size)
    for k in range(lengths.size):
        first = (k + 1) * rows
        u = bundle[first : first + rows]
        for before in range(rows, first, rows):
            v = bundle[before : before + rows]
            subtract(u, inner(chain, u, v), v)
        length = sqrt(inner(chain, u, u))
        lengths[k] = length
        scale(u, 1.0 / length)


@kernel
def size_of_solution(chain: Any, bundle: np.ndarray, count: int) -> float:
    """Return the l2 norm of the solution in a bundle with `count` tangent vectors."""
    y = bundle[: bundle.shape[0] // (1 + count)]
    return sqrt(inner(chain, y, y))


@kernel
def observe_nothing(chain: Any, bundle: np.ndarray, i: int, record: Any) -> None:
    """Do nothing: only the bundle at the end of each interval is needed."""


def build(bundle_rates: Callable, at_time: Callable = at_any_time) -> Callable:
    """Return the kernel that integrates a bundle over the intervals between successive `times`.

    After each interval it writes the `lengths` (interval, vector) of the tangent vectors and the l2
    norm of the solution into `sizes` (interval,). It returns the status of the solver. Without
    `at_time` every interval starts at times[0], and all intervals must be equally long.
    """
    solve = dop853.build(bundle_rates, observe_nothing, at_time=at_time)
    driven = at_time is not at_any_time

    @in_one_pass
    def carry(
        chain: Any,
        bundle: np.ndarray,
        times: np.ndarray,
        controls: tuple[float, ...],
        work: np.ndarray,
        record: Any,
        lengths: np.ndarray,
        sizes: np.ndarray,
        stop: np.ndarray,
    ) -> int:
        status = DONE
        for i in range(lengths.shape[0]):
            span = times[i : i + 2] if driven else times[:2]
            outcome = solve(chain, bundle, span, controls, work, record, stop)
            status = outcome.status
            if status != DONE:
                break
            orthonormalise(chain, bundle, lengths[i])
            sizes[i] = size_of_solution(chain, bundle, lengths.shape[1])
        return status

    return carry
