"""The variational equations against differences of equation (4), and Lemma 1."""

import hashlib

import numpy as np
import pytest
from latticode.localised.tangents import grow
from latticode.simulation.lattice import Reduction, choose_ends, pack, unpack
from oracle import BOUNDARIES, random_chain, slope
from pendula.models.amplitudes import Chain, tangent_rates
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


HASH = "669dfa1c71eb6f7b"
"""Of the bits that every machine must get of the growth below."""


def test_the_bits_of_growth_are_those_of_every_machine():
    z, *vectors = (np.round(random_chain(2, even=True, seed=n), 3) for n in (4, 5, 6))
    growth = grow(problem_from(z, CONSTANTS), np.array(vectors), 3.0, even=True)
    assert growth.tau.tolist() == [0.25 * step for step in range(13)]
    bits = growth.log_growth.tobytes() + growth.size.tobytes()
    assert hashlib.sha256(bits).hexdigest()[:16] == HASH
