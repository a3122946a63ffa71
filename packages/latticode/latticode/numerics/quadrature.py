"""Weights of integrals of polynomials, with the same bits on every machine."""

from fractions import Fraction
from functools import cache

import numpy as np

from .elementary import cos


def gauss_legendre(count: int) -> tuple[np.ndarray, np.ndarray]:
    """Return nodes and weights on [-1, 1] of the quadrature of Gauss.

    NumPy's own come from LAPACK, whose last bits depend on the processor. These are the roots of
    Legendre's polynomial by Newton's method.
    """
    x = -cos(np.pi * (np.arange(count) + 0.75) / (count + 0.5))
    for _ in range(6):
        below, value = np.ones(count), x
        for n in range(2, count + 1):
            below, value = value, ((2 * n - 1) * x * value - (n - 1) * below) / n
        slope = count * (below - x * value) / (1.0 - x * x)
        x = x - value / slope
    return x, 2.0 / ((1.0 - x * x) * slope * slope)


def integration_matrix(nodes: np.ndarray) -> np.ndarray:
    """Return the integrals from 0 to each of `nodes` of the polynomials that are one at a node.

    Rational arithmetic makes them exact, so that nothing hangs on how a matrix is inverted.
    """
    return _integration_matrix(tuple(map(float, nodes))).copy()


@cache
def _integration_matrix(nodes: tuple[float, ...]) -> np.ndarray:
    exact, columns = [Fraction(node) for node in nodes], []
    for own in exact:
        coefficients = [Fraction(1)]  # of the polynomial, from the constant on
        for other in exact:
            if other != own:
                raised, level = [Fraction(0), *coefficients], [*coefficients, Fraction(0)]
                pairs = zip(raised, level, strict=True)
                coefficients = [(up - other * same) / (own - other) for up, same in pairs]
        integral = [Fraction(0), *(c / (k + 1) for k, c in enumerate(coefficients))]
        columns.append([sum(c * end**k for k, c in enumerate(integral)) for end in exact])
    return np.array(columns, dtype=float).T
