"""The way from amplitudes to the state of a run and back."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from oracle import chains, random_chain
from pendula.ends import DIRICHLET, FREE, PERIODIC
from pendula.models.chain import MIRROR
from pendula.simulation.lattice import (
    WHOLE,
    Reduction,
    choose_ends,
    find_reduction,
    pack,
    unfold,
    unpack,
)

REDUCTIONS = [Reduction(even, same) for even in (False, True) for same in (False, True)]


@pytest.mark.parametrize("reduction", REDUCTIONS)
def test_symmetries_are_found(reduction):
    assert find_reduction(random_chain(3, **reduction._asdict())) == reduction


@given(st.integers(0, 6), st.integers(0, 1), st.booleans())
def test_the_last_bit_of_any_part_breaks_a_symmetry(site, component, imaginary):
    z = random_chain(3, even=True, synchronised=True)
    part = z.imag if imaginary else z.real
    part[component, site] = np.nextafter(part[component, site], np.inf)
    centre = site == 3  # a change at the centre leaves the data even
    assert find_reduction(z) == Reduction(even=centre, synchronised=False)


def test_a_chain_of_one_pair_has_no_half():
    assert not find_reduction(random_chain(0)).even


def test_the_state_holds_parts_in_rows_between_ghosts():
    z = np.array([[1 + 2j, 3 + 4j, 5 + 6j], [7 + 8j, 9 + 10j, 11 + 12j]])
    y = pack(z, Reduction(even=False, synchronised=False))
    expected = [[0, 1, 3, 5, 0], [0, 2, 4, 6, 0], [0, 7, 9, 11, 0], [0, 8, 10, 12, 0]]
    np.testing.assert_array_equal(y, expected)


def test_half_a_state_starts_at_the_centre():
    z = np.array([[3, 2 + 1j, 1 + 5j, 2 + 1j, 3]] * 2)
    y = pack(z, Reduction(even=True, synchronised=True))
    np.testing.assert_array_equal(y, [[0, 1, 2, 3, 0], [0, 5, 1, 0, 0]])


@given(st.data(), st.sampled_from(REDUCTIONS))
def test_packing_and_unpacking_returns_the_same_amplitudes(data, reduction):
    z = data.draw(chains(widths=(1, 4), **reduction._asdict()))
    np.testing.assert_array_equal(unpack(pack(z, reduction), reduction), z)


@given(st.data(), st.sampled_from(REDUCTIONS))
def test_a_state_is_as_small_as_the_symmetries_allow(data, reduction):
    z = data.draw(chains(widths=(1, 4), **reduction._asdict()))
    sites = z.shape[1] // 2 + 1 if reduction.even else z.shape[1]
    rows = 2 if reduction.synchronised else 4
    assert pack(z, reduction).shape == (rows, sites + 2)


def test_unfolding_mirrors_the_sites_and_keeps_later_axes():
    half = np.arange(6.0).reshape(1, 3, 2)
    whole = unfold(half, Reduction(even=True, synchronised=True))
    assert whole.shape == (2, 5, 2)
    np.testing.assert_array_equal(whole[1, :, 0], [4, 2, 0, 2, 4])
    np.testing.assert_array_equal(whole[0, :, 1], [5, 3, 1, 3, 5])


@pytest.mark.parametrize(
    ("boundary", "whole", "far"),
    [("dirichlet", DIRICHLET, DIRICHLET), ("free", FREE, FREE), ("periodic", PERIODIC, FREE)],
)
def test_ends_of_the_whole_and_of_half_the_chain(boundary, whole, far):
    assert choose_ends(boundary, Reduction(False, False)) == (whole, whole)
    assert choose_ends(boundary, Reduction(True, False)) == (MIRROR, far)


def test_the_whole_is_not_reduced():
    assert WHOLE._asdict() == {"even": False, "synchronised": False}
