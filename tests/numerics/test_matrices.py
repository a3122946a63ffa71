"""Products, factor and eigenvalues of small matrices against NumPy's."""

import numpy as np
import pytest
from pendula.numerics.matrices import cholesky, growth_bound, multiply, symmetric_eigenvalues, times

rng = np.random.default_rng(8)
SQUARE = rng.normal(size=(3, 7, 7))
SYMMETRIC = SQUARE + SQUARE.swapaxes(1, 2)


def test_products_are_those_of_matrices():
    x = rng.normal(size=7) + 1j * rng.normal(size=7)
    np.testing.assert_allclose(times(SQUARE[0], x), SQUARE[0] @ x, atol=1e-13)
    np.testing.assert_allclose(times(SQUARE[0][:3], SQUARE[1]), SQUARE[1] @ SQUARE[0][:3].T)
    np.testing.assert_allclose(multiply(SQUARE, SYMMETRIC[:, :, :2]), SQUARE @ SYMMETRIC[:, :, :2])


def test_the_factor_is_triangular_and_gives_the_matrix_back():
    matrix = multiply(SQUARE[0], SQUARE[0].T)
    factor = cholesky(matrix)
    assert np.array_equal(factor, np.tril(factor))
    np.testing.assert_allclose(factor @ factor.T, matrix, atol=1e-13)


@pytest.mark.parametrize(
    "matrices",
    [
        SYMMETRIC,
        np.eye(4),
        np.zeros((3, 3)),
        np.array([[2.0]]),
        np.array([[1.0, 1e-200], [1e-200, 3.0]]),
        np.diag([1e-8, 1.0, 1e8]) + 1e-3,
        np.array([[2.0, 1.0], [1.0, 2.0]]),
        np.array([[1.0, 0.0, 2.0], [0.0, 5.0, 3.0], [2.0, 3.0, 9.0]]),
        np.diag(np.full(9, 2.0)) - np.diag(np.ones(8), 1) - np.diag(np.ones(8), -1),
    ],
)
def test_eigenvalues_of_symmetric_matrices(matrices):
    found, expected = symmetric_eigenvalues(matrices), np.linalg.eigvalsh(matrices)
    np.testing.assert_allclose(found, expected, rtol=0, atol=1e-14 * (1.0 + np.abs(expected).max()))


def test_a_matrix_that_is_not_a_number_has_no_eigenvalues():
    with pytest.raises(ArithmeticError):
        symmetric_eigenvalues(np.array([[1.0, np.nan], [np.nan, 1.0]]))


def test_the_bound_of_growth_is_zero_for_a_turn_and_holds_for_any_matrix():
    turn = np.array([[0.0, 3.0], [-3.0, 0.0]])
    assert growth_bound(turn) == 0.0
    for matrix in SQUARE:
        assert np.linalg.eigvals(matrix).real.max() <= growth_bound(matrix)


def test_the_bound_of_growth_is_the_largest_sum_of_a_row_of_the_symmetric_part():
    assert growth_bound(np.array([[1.0, 2.0], [0.0, -3.0]])) == 4.0
