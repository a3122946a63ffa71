"""Products of small matrices that have the same bits on every machine.

BLAS chooses the order of its sums according to the processor. Here the order is fixed. The matrices
have only tens of rows, so the speed of BLAS does not matter.
"""

import numpy as np


def times(matrix: np.ndarray, x: np.ndarray) -> np.ndarray:
    """Return products (..., m) of `matrix` (..., m, n) and `x` (..., n); one must be real."""
    return np.sum(matrix * x[..., None, :], axis=-1)
