"""Changes of a state made orthonormal again, and how much each had grown (Gram and Schmidt)."""

from math import log, sqrt

from pendula.compiled import kernel
from pendula.models.amplitudes import MIRROR
from pendula.models.tangent import ROWS


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
def orthonormalise(chain, bundle, stretches):
    """Make the changes in `bundle` orthonormal; write the logarithms of their lengths.

    The modified Gram-Schmidt method: the first keeps its direction, each loses what the ones
    before it hold. `stretches` is (change,).
    """
    for k in range(stretches.size):
        first = (k + 1) * ROWS
        u = bundle[first : first + ROWS]
        for before in range(ROWS, first, ROWS):
            v = bundle[before : before + ROWS]
            subtract(u, inner(chain, u, v), v)
        length = sqrt(inner(chain, u, u))
        stretches[k] = log(length)
        scale(u, 1.0 / length)
