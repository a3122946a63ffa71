"""Products of small matrices against NumPy's."""

import numpy as np
from pendula.numerics.matrices import times

rng = np.random.default_rng(8)
MATRIX = rng.normal(size=(7, 7))


def test_products_are_those_of_matrices():
    x = rng.normal(size=7) + 1j * rng.normal(size=7)
    np.testing.assert_allclose(times(MATRIX, x), MATRIX @ x, atol=1e-13)
    np.testing.assert_allclose(times(MATRIX[:3], MATRIX), MATRIX @ MATRIX[:3].T)
