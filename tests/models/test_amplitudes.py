"""The right-hand side against equation (4), and the laws that its arithmetic keeps exactly."""

import itertools

import numpy as np
import pytest
from hypothesis import given
from latticode.kernels.simd import LANES
from latticode.simulation.lattice import Reduction, choose_ends, pack, unpack
from oracle import BOUNDARIES, boundaries, chains, constants, random_chain, slope
from pendula.models.amplitudes import (
    Chain,
    midpoint_rates,
    rates,
    rates_at_site,
)

CONSTANTS = (0.7, 1.3, -2.1)
WHOLE = Reduction(even=False, synchronised=False)
REDUCTIONS = [Reduction(even, same) for even in (False, True) for same in (False, True)]


def library_slope(z, numbers, boundary, reduction=WHOLE):
    """Return dz/dtau as the library computes it on what `reduction` leaves of the chain."""
    chain = Chain(*numbers, *choose_ends(boundary, reduction))
    y = pack(z, reduction)
    dy = np.zeros_like(y)
    rates(chain, y, dy)
    return unpack(dy, reduction)


@pytest.mark.parametrize("boundary", BOUNDARIES)
def test_rates_are_equation_4(boundary):
    cases = itertools.product([1, 2, 4, 5, 7, 8], REDUCTIONS)
    for half_width, reduction in [(0, WHOLE), *cases]:
        z = random_chain(half_width, **reduction._asdict())
        expected = slope(z, CONSTANTS, boundary)
        actual = library_slope(z, CONSTANTS, boundary, reduction)
        np.testing.assert_allclose(
            actual, expected, 1e-13, 1e-13, err_msg=f"{half_width} {reduction}"
        )


@given(chains(), constants, boundaries)
def test_conjugation_reverses_the_rates_to_the_last_bit(z, numbers, boundary):
    reversed_rates = library_slope(np.conj(z), numbers, boundary)
    np.testing.assert_array_equal(reversed_rates, -np.conj(library_slope(z, numbers, boundary)))


def test_a_vector_of_sites_at_a_time_gets_the_bits_of_one_by_one():
    chain = Chain(*CONSTANTS, *choose_ends("dirichlet", WHOLE))
    for sites in range(LANES - 3, 3 * LANES + 1):
        y = pack(random_chain(sites)[:, :sites], WHOLE)
        at_once, one_by_one = np.zeros_like(y), np.zeros_like(y)
        rates(chain, y, at_once)
        for re, j in itertools.product((0, 2), range(1, sites + 1)):
            rates_at_site(chain, (y,), re, j, one_by_one)
        np.testing.assert_array_equal(at_once, one_by_one, err_msg=f"{sites} sites")


@pytest.mark.parametrize("half_width", [3, 7])
@pytest.mark.parametrize("boundary", BOUNDARIES)
def test_midpoint_rates_are_linear_terms_of_the_mean_and_a_mean_square(boundary, half_width):
    old, new = random_chain(half_width, seed=1), random_chain(half_width, seed=2)
    mean = (old + new) / 2
    mean_square = (np.abs(old) ** 2 + np.abs(new) ** 2) / 2
    linear = slope(mean, CONSTANTS, boundary) + 0.5j * np.abs(mean) ** 2 * mean
    chain = Chain(*CONSTANTS, *choose_ends(boundary, WHOLE))
    middle, dy = np.zeros((2, 4, 2 * half_width + 3))
    midpoint_rates(chain, pack(old, WHOLE), pack(new, WHOLE), middle, dy)
    expected = linear - 0.5j * mean_square * mean
    np.testing.assert_allclose(unpack(dy, WHOLE), expected, rtol=1e-13, atol=1e-13)
