"""Products of small matrices that have the same bits on every machine.

BLAS chooses the order of its sums by the processor. Here every sum has one order. The matrices have
tens of rows, so that speed is not missed.
"""

import numpy as np


def times(matrix: np.ndarray, x: np.ndarray) -> np.ndarray:
    """Return `matrix` (..., m, n) times the vectors `x` (..., n), one real and one of any kind."""
    return np.sum(matrix * x[..., None, :], axis=-1)
