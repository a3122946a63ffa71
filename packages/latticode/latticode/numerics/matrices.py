"""Products of small matrices that have the same bits on every machine.

BLAS chooses the order of its sums by the processor. Here the order is fixed. The matrices have only
tens of rows, for which the speed of BLAS does not matter.
"""

import numpy as np


def times(matrix: np.ndarray, x: np.ndarray) -> np.ndarray:
    """Return `matrix` (..., m, n) times vectors `x` (..., n), (..., m); one of them is real."""
    return np.sum(matrix * x[..., None, :], axis=-1)
