"""The variational equations against differences of equation (4), and Lemma 1."""

import hashlib

import numpy as np
import pytest
from latticode.localised.tangents import grow
from latticode.simulation.lattice import Reduction, choose_ends, pack, unpack
from oracle import BOUNDARIES, random_chain, slope
from pendula.models.amplitudes import Chain, tangent_rates
from pendula.models.linear_chain import finite_rate
from problems import problem_from

CONSTANTS = (0.7, 1.3, -2.1)
WHOLE = Reduction(even=False, synchronised=False)
HALF = Reduction(even=True, synchronised=False)


def tangent_rate(z, vector, boundary, reduction=WHOLE):
    """Return the rate of `vector` at `z` as the library computes it."""
    chain = Chain(*CONSTANTS, *choose_ends(boundary, reduction))
    y, w = pack(z, reduction), pack(vector, reduction)
    dw = np.zeros_like(w)
    tangent_rates(chain, y, w, dw)
    return unpack(dw, reduction)


def derivative(z, vector, boundary, h=1e-5):
    """Return the derivative of equation (4) along `vector` by a central difference."""
    ahead, behind = (slope(z + s * vector, CONSTANTS, boundary) for s in (h, -h))
    return (ahead - behind) / (2 * h)


@pytest.mark.parametrize("reduction", [WHOLE, HALF])
@pytest.mark.parametrize("boundary", BOUNDARIES)
@pytest.mark.parametrize("half_width", [1, 4])
def test_tangent_rates_are_differences_of_equation_4(half_width, boundary, reduction):
    z = 2 * random_chain(half_width, even=reduction.even, seed=1)
    vector = random_chain(half_width, even=reduction.even, seed=2)
    expected = derivative(z, vector, boundary)
    actual = tangent_rate(z, vector, boundary, reduction)
    np.testing.assert_allclose(actual, expected, rtol=1e-8, atol=1e-8)


@pytest.mark.parametrize("boundary", BOUNDARIES)
def test_an_odd_vector_of_an_even_state_stays_odd_to_the_last_bit(boundary):
    z, vector = random_chain(5, even=True), random_chain(5, seed=3)
    rate = tangent_rate(z, vector - vector[:, ::-1], boundary)
    np.testing.assert_array_equal(rate, -rate[:, ::-1])


@pytest.mark.parametrize("omega", [-1.0, 0.0, 2.5])
def test_at_rest_a_vector_grows_as_lemma_1_says(omega):
    rest, vector = np.zeros((2, 7), complex), random_chain(3)[None]
    growth = grow(problem_from(rest, (1.0, 1.0, omega)), vector, 60.0)
    rate = (growth.log_growth[0, -1] - growth.log_growth[0, 160]) / 20.0
    assert rate == pytest.approx(finite_rate(omega, 1.0, 1.0, 7, "dirichlet"), rel=2e-3)


HASH = "669dfa1c71eb6f7b"
"""Of the bits that every machine must get of the growth below."""


def test_the_bits_of_growth_are_those_of_every_machine():
    z, *vectors = (np.round(random_chain(2, even=True, seed=n), 3) for n in (4, 5, 6))
    growth = grow(problem_from(z, CONSTANTS), np.array(vectors), 3.0, even=True)
    assert growth.tau.tolist() == [0.25 * step for step in range(13)]
    bits = growth.log_growth.tobytes() + growth.size.tobytes()
    assert hashlib.sha256(bits).hexdigest()[:16] == HASH
