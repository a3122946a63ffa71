"""Weights of integrals against NumPy's, and against integrals that are known."""

import hashlib

import numpy as np
import pytest
from latticode.numerics.quadrature import gauss_legendre, integration_matrix


@pytest.mark.parametrize("count", [1, 2, 5, 8, 20])
def test_nodes_and_weights_of_gauss(count):
    found, expected = gauss_legendre(count), np.polynomial.legendre.leggauss(count)
    np.testing.assert_allclose(found, expected, rtol=0, atol=1e-14)


def test_the_bits_of_nodes_and_weights_are_those_of_every_machine():
    nodes, weights = gauss_legendre(8)
    found = hashlib.sha256(nodes.tobytes() + weights.tobytes()).hexdigest()
    assert found[:16] == "d7e6bce31ecf08b5"


def test_integrals_of_polynomials_are_exact():
    nodes = np.array([0.1, 0.35, 0.6, 1.0])
    for degree in range(4):
        integral = integration_matrix(nodes) @ nodes**degree
        np.testing.assert_allclose(integral, nodes ** (degree + 1) / (degree + 1), atol=1e-16)
