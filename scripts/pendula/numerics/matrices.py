"""Small matrices that have the same bits on every machine: products, a factor, eigenvalues.

BLAS and LAPACK choose the order of their sums, and the signs of eigenvectors, by the processor.
Here every sum has one order. The matrices have tens of rows, so that speed is not missed.
"""

import numpy as np

SWEEPS = 60
"""Sweeps of Jacobi's method after which something is wrong; it needs about ten."""


def times(matrix: np.ndarray, x: np.ndarray) -> np.ndarray:
    """Return `matrix` (..., m, n) times the vectors `x` (..., n), one real and one of any kind."""
    return np.sum(matrix * x[..., None, :], axis=-1)


def multiply(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    """Return the product of matrices (..., l, m) and (..., m, n)."""
    return np.sum(a[..., :, :, None] * b[..., None, :, :], axis=-2)


def cholesky(matrix: np.ndarray) -> np.ndarray:
    """Return the lower triangular L with L L^T = `matrix` (..., n, n), each positive definite."""
    factor = np.zeros_like(matrix)
    for j in range(matrix.shape[-1]):
        column = matrix[..., j:, j] - times(factor[..., j:, :j], factor[..., j, :j])
        factor[..., j:, j] = column / np.sqrt(column[..., :1])
    return factor


def growth_bound(matrix: np.ndarray) -> float:
    """Return a bound of the rate at which |x| grows under x' = matrix x, by its symmetric part."""
    return float(np.sum(np.abs(0.5 * (matrix + matrix.T)), axis=1).max())


def symmetric_eigenvalues(matrices: np.ndarray) -> np.ndarray:
    """Return the eigenvalues (..., n), in rising order, of symmetric matrices (..., n, n).

    By Jacobi's method: turns of two axes at a time make each entry beside the diagonal vanish in
    its turn, until nothing beside the diagonal is left above rounding (G. H. Golub and C. F. Van
    Loan, Matrix Computations, 4th ed. (2013), section 8.5). Errors are a few units in the last
    place of the largest eigenvalue.
    """
    a = np.array(matrices, dtype=float)
    size = a.shape[-1]
    diagonal = np.arange(size)
    beside = ~np.eye(size, dtype=bool)
    for _ in range(SWEEPS):
        if np.all(np.sum(a[..., beside] ** 2, axis=-1) <= 1e-36 * np.sum(a**2, axis=(-2, -1))):
            return np.sort(a[..., diagonal, diagonal], axis=-1)
        with np.errstate(over="ignore"):  # an entry near zero asks for a turn by nothing
            for p in range(size - 1):
                for q in range(p + 1, size):
                    _turn(a, p, q)
    raise ArithmeticError(f"Jacobi's method did not end after {SWEEPS} sweeps")


def _turn(a: np.ndarray, p: int, q: int) -> None:
    """Turn the axes p and q of every matrix so that the entry (p, q) vanishes."""
    entry = a[..., p, q].copy()
    gone = entry == 0.0
    ratio = (a[..., q, q] - a[..., p, p]) / (2.0 * np.where(gone, 1.0, entry))
    sign = np.where(ratio < 0.0, -1.0, 1.0)
    tangent = np.where(gone, 0.0, sign / (np.abs(ratio) + np.sqrt(1.0 + ratio * ratio)))
    cosine = 1.0 / np.sqrt(1.0 + tangent * tangent)
    c, s = cosine[..., None], (tangent * cosine)[..., None]
    row_p, row_q = a[..., p, :].copy(), a[..., q, :].copy()
    a[..., p, :], a[..., q, :] = c * row_p - s * row_q, s * row_p + c * row_q
    column_p, column_q = a[..., p].copy(), a[..., q].copy()
    a[..., p], a[..., q] = c * column_p - s * column_q, s * column_p + c * column_q
    a[..., p, q] = a[..., q, p] = 0.0
