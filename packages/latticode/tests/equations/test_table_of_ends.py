"""The table of the ends of a chain: each line is of one Laplacian."""

import numpy as np
import pytest
from latticode.equations.ends import ENDS, neighbours
from oracle import BOUNDARIES, laplacian, random_chain


@pytest.mark.parametrize("boundary", BOUNDARIES)
def test_each_line_of_the_table_is_of_one_laplacian(boundary):
    matrix, z = laplacian(7, boundary), 0.1 * random_chain(3)
    right, left = neighbours(z, boundary)
    np.testing.assert_allclose(right + left - 2.0 * z, z @ matrix.T, atol=1e-15)
    modes = ENDS[boundary].mode(np.arange(7)[:, None], np.arange(7), 7)
    expected = np.diag(-4.0 * np.sin(ENDS[boundary].half_angle(np.arange(7), 7)) ** 2)
    np.testing.assert_allclose(modes @ matrix @ modes.T, expected, atol=1e-14)
