"""Rates and power series of a chain of pairs against its equations, and the laws of their bits."""

from itertools import product

import numpy as np
import pytest
from dimers import DIMERS, Pairs, rates, rates_at_site
from hypothesis import given, settings
from latticode.generation.modules import load_series
from latticode.generation.series import SHORT
from latticode.integrators.taylor import BLOCK_SIZE, ORDER, WORK, lay_out, write_state
from latticode.kernels.compiled import kernel
from latticode.kernels.simd import LANES
from latticode.simulation.lattice import Reduction, choose_ends, find_reduction, pack, unpack
from oracle import BOUNDARIES, boundaries, chains, constants, power_series, random_chain, slope

WHOLE = Reduction(even=False, synchronised=False)
CONSTANTS = (0.7, 1.3, -2.1)
REDUCTIONS = [Reduction(even, same) for even in (False, True) for same in (False, True)]
continue_series = load_series(DIMERS).continue_in_waves


def slope_of(z, numbers, boundary, reduction=WHOLE):
    """Return dz/dtau by the library on what `reduction` leaves of the chain."""
    chain = Pairs(*numbers, *choose_ends(boundary, reduction))
    y = pack(z, reduction)
    dy = np.zeros_like(y)
    rates(chain, y, dy)
    return unpack(dy, reduction)


@pytest.mark.parametrize("boundary", BOUNDARIES)
def test_rates_are_those_of_the_equations(boundary):
    cases = product([1, 2, 4, 5, 7, 8], REDUCTIONS)
    for half_width, reduction in [(0, WHOLE), *cases]:
        z = random_chain(half_width, **reduction._asdict())
        found, expected = slope_of(z, CONSTANTS, boundary, reduction), slope(z, CONSTANTS, boundary)
        np.testing.assert_allclose(found, expected, 1e-13, 1e-13, err_msg=f"{half_width}")


@given(chains(), constants, boundaries)
def test_conjugation_reverses_the_rates_to_the_last_bit(z, numbers, boundary):
    reversed_rates = slope_of(np.conj(z), numbers, boundary)
    np.testing.assert_array_equal(reversed_rates, -np.conj(slope_of(z, numbers, boundary)))


@kernel
def write_site(chain, y, re, j, dy):
    rates_at_site(chain, (y,), re, j, dy)


def test_a_vector_of_sites_at_a_time_gets_the_bits_of_one_by_one():
    chain = Pairs(*CONSTANTS, *choose_ends("dirichlet", WHOLE))
    for sites in range(LANES - 3, 3 * LANES + 1):
        y = pack(random_chain(sites)[:, :sites], WHOLE)
        at_once, one_by_one = np.zeros_like(y), np.zeros_like(y)
        rates(chain, y, at_once)
        for re, j in product((0, 2), range(1, sites + 1)):
            write_site(chain, y, re, j, one_by_one)
        np.testing.assert_array_equal(at_once, one_by_one, err_msg=f"{sites} sites")


@kernel
def fill(chain, y, work):
    series = lay_out(work, y)
    write_state(y, series)
    continue_series(chain, series)


def coefficients(z, numbers, boundary, reduction):
    """Return the coefficients (order + 1, 2, N) by the library, complex."""
    y = pack(z, reduction)
    work = np.full((WORK, *y.shape), np.nan)
    fill(Pairs(*numbers, *choose_ends(boundary, reduction)), y, work)
    components, blocks = y.shape[0] // 2, -(-(y.shape[1] - 2) // LANES)
    c = work.reshape(-1)[: components * blocks * BLOCK_SIZE]
    c = c.reshape(components, blocks, ORDER + 1, 3, LANES)[:, :, :, :2]
    c = c.transpose(2, 0, 3, 1, 4).reshape(ORDER + 1, y.shape[0], blocks * LANES)
    c = np.pad(c, ((0, 0), (0, 0), (1, 1)))[:, :, : y.shape[1]]
    return np.array([unpack(state, reduction) for state in c])


@pytest.mark.parametrize(("even", "synchronised"), [(0, 0), (1, 0), (0, 1), (1, 1)])
def test_each_kind_of_half_continues_the_series(even, synchronised):
    @given(z=chains(even=even, synchronised=synchronised), numbers=constants, boundary=boundaries)
    @settings(max_examples=30)
    def check(z, numbers, boundary):
        z = 0.5 * z  # larger data cancel: the oracle itself then loses digits in its high orders
        expected = power_series(z, numbers, boundary, ORDER)
        for reduction in (WHOLE, find_reduction(z)):
            actual = coefficients(z, numbers, boundary, reduction)
            size = np.abs(expected).max(axis=(1, 2), keepdims=True)
            np.testing.assert_allclose(actual / (size + 1), expected / (size + 1), atol=1e-13)

    check()


@pytest.mark.parametrize("boundary", ["dirichlet", "free"])
def test_waves_along_a_long_chain_give_the_bits_of_its_half_order_by_order(boundary):
    half = np.random.default_rng(1).normal(size=(2, 2 * LANES * SHORT // 3, 2)) @ (1.0, 1j)
    z = np.concatenate([half[:, :0:-1], half], axis=1)
    assert half.shape[1] <= LANES * SHORT < z.shape[1]
    runs = [
        coefficients(z, (1.0, 0.7, -4.0), boundary, kept) for kept in (WHOLE, find_reduction(z))
    ]
    np.testing.assert_array_equal(*runs)


@pytest.mark.parametrize("boundary", BOUNDARIES)
def test_halves_and_single_components_have_the_bits_of_the_whole_wherever_blocks_end(boundary):
    for sites in (1, 3, 5, 7, 9, 11, 13, 15, 17):
        half = np.random.default_rng(sites).normal(size=(1, (sites + 1) // 2, 2)) @ (1.0, 1j)
        z = np.repeat(np.concatenate([half[:, :0:-1], half], axis=1), 2, axis=0)
        whole = coefficients(z, (1.0, 0.7, -4.0), boundary, WHOLE)
        for even, synchronised in [(sites > 1, False), (False, True), (sites > 1, True)]:
            kept = Reduction(even=even, synchronised=synchronised)
            found = coefficients(z, (1.0, 0.7, -4.0), boundary, kept)
            np.testing.assert_array_equal(found, whole, err_msg=f"{sites} sites, {kept}")


@pytest.mark.parametrize("sites", [LANES * SHORT - 7, LANES * SHORT + 45])
def test_a_ring_of_any_length_has_no_first_site(sites):
    """A ring that is turned has the turned coefficients, to the last bit, in waves or not.

    In `continue_series`, `first == 0` and `last == blocks` may hold too often without any harm: an
    end that is closed early is closed again when the order of its own block is known.
    """
    z = np.random.default_rng(7).normal(size=(2, sites, 2)) @ (1.0, 1j)
    found = coefficients(z, (1.0, 0.7, -4.0), "periodic", WHOLE)
    for turn in (1, LANES, sites // 2):
        turned = coefficients(np.roll(z, turn, axis=1), (1.0, 0.7, -4.0), "periodic", WHOLE)
        np.testing.assert_array_equal(turned, np.roll(found, turn, axis=2))
