"""The states behind the fronts: sums over their sites, means over time, and the law of l2^2."""

import numpy as np
import pytest
from oracle import hamiltonian, random_chain
from pendula.studies.unbounded import bulk
from pendula.studies.unbounded.sums import turned
from problems import constants_of

NUMBERS = (1.2, 0.7, -3.0)
CONSTANTS = constants_of(NUMBERS)


def right_half(half_width):
    """Return an even chain, and the rows of S and D of its sites 0..W."""
    z = random_chain(half_width, even=True)
    a, b = z[:, half_width:]
    return z, turned(np.array([a.real, a.imag, b.real, b.imag]))


def test_energies_of_the_sites_add_up_to_that_of_the_chain():
    z, sites = right_half(9)
    energies = bulk.energies(sites, CONSTANTS)
    a, b = z[:, 9]
    own = 0.25 * (abs(a) ** 4 + abs(b) ** 4) - 3.0 * (abs(a) ** 2 + abs(b) ** 2)
    own -= 0.7 * ((a - b) ** 2).real
    both = 2.0 * energies.sum() - own  # the centre has no twin, each bond has one
    assert both == pytest.approx(hamiltonian(z, NUMBERS, "dirichlet"), rel=1e-12)


def test_means_are_those_of_the_sites_well_behind_and_well_between_the_fronts():
    z, sites = right_half(120)
    powers, sums = (np.abs(z[:, 120:]) ** 2).sum(axis=0), np.abs(z.sum(axis=0)[120:]) ** 2 / 2.0
    behind, between = bulk.region_means(sites, CONSTANTS, 110.9, 20.7)
    assert behind[:2] == pytest.approx([powers[1:18].mean(), sums[1:18].mean()])
    assert between[:2] == pytest.approx([powers[30:70].mean(), sums[30:70].mean()])
    assert between[2] == pytest.approx(bulk.energies(sites, CONSTANTS)[30:70].mean())
    nothing, all_of_it = bulk.region_means(sites, CONSTANTS, 110.9, -1.0)
    assert np.isnan(nothing).all() and all_of_it[0] == pytest.approx(powers[1:70].mean())
    assert np.isnan(bulk.region_means(sites, CONSTANTS, 45.0, 40.0)[1]).all()


def test_cells_are_means_of_ten_sites_from_the_centre_on():
    z, sites = right_half(34)
    a, b = z[:, 34:]
    expected = [np.abs(a + b) ** 2 / 2.0, np.abs(a - b) ** 2 / 2.0]
    found = bulk.cell_means(sites)
    assert found.shape == (2, 3)
    np.testing.assert_allclose(found[:, 1], [one[10:20].mean() for one in expected])


def test_maxima_are_those_of_blocks_on_the_first_half_of_the_way_to_the_front():
    z, sites = right_half(40)
    moduli = np.abs(z).max(axis=0)[41:59]  # the front is at 38.7; its centre is left out
    found = bulk.bulk_maxima(turned(sites), 38.7)
    for i, size in enumerate(bulk.NEIGHBOURS):
        maxima = [max(moduli[end - size : end]) for end in range(size, 19, size)]
        assert found[i] == pytest.approx(np.mean(maxima) if maxima else np.nan, nan_ok=True), size
    assert np.isfinite(found).tolist() == [True] * 5 + [False] * 2
    assert np.isnan(bulk.bulk_maxima(turned(sites), -1.0)).all()
