"""Tangent vectors carried along with a solution, and made orthonormal again after spans of time.

A tangent vector is a small perturbation of the data, to first order. Orthonormal vectors do not
all turn to the fastest direction, and lengths that are taken at each span do not overflow
(Benettin, Galgani, Giorgilli and Strelcyn, Meccanica 15 (1980) 9).

A bundle is an array of states stacked by rows: first a solution, then its tangent vectors, all with
the ghost columns and the ends of one chain.
"""

from math import sqrt

from latticode.equations.ends import MIRROR
from latticode.integrators import DONE, dop853
from latticode.integrators.autonomous import at_any_time
from latticode.kernels.compiled import inlined_by_numba, kernel


@kernel
def inner(chain, u, v):
    """Return the scalar product of two states over the whole chain, also where half is kept."""
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
def subtract(u, factor, v):
    """Take `factor` times `v` from `u`."""
    for row in range(u.shape[0]):
        for j in range(1, u.shape[1] - 1):
            u[row, j] -= factor * v[row, j]


@kernel
def scale(u, factor):
    """Multiply `u` by `factor`."""
    for row in range(u.shape[0]):
        for j in range(1, u.shape[1] - 1):
            u[row, j] *= factor


@kernel
def orthonormalise(chain, bundle, lengths):
    """Make the tangent vectors in `bundle` orthonormal; write their `lengths` (vector,).

    This is the modified Gram-Schmidt method: the first vector keeps its direction, and each other
    one loses its components along those before it.
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
def size_of_solution(chain, bundle, count):
    """Return the l2 norm of the solution in a bundle of `count` tangent vectors."""
    y = bundle[: bundle.shape[0] // (1 + count)]
    return sqrt(inner(chain, y, y))


@kernel
def observe_nothing(chain, bundle, i, record):
    """Keep nothing: the bundle at the end of each span of time has all that is wanted."""


def build(bundle_rates, at_time=at_any_time):
    """Return what carries a bundle from each of `times` to the next.

    It writes `lengths` (span, vector) and `sizes` (span,) of the solution, and returns the status
    of the solver. Where nothing depends on the time, all spans are as the first.
    """
    solve = dop853.build(bundle_rates, observe_nothing, at_time=at_time)
    driven = at_time is not at_any_time

    @inlined_by_numba
    def carry(chain, bundle, times, controls, work, record, lengths, sizes, stop):
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
