"""The thermal state of zero energy: its energy is (8), its temperature that of equipartition."""

import numpy as np
import pytest
from oracle import hamiltonian
from pendula.studies.unbounded.bulk import ring_energies, sample, site_energy, zero_energy
from problems import constants_of

NUMBERS = (0.8, 0.6, -1.5)  # epsilon, gamma, Omega
CONSTANTS = constants_of(NUMBERS)


def random_ring(sites=7):
    return np.random.default_rng(3).normal(scale=2.0, size=(4, sites))


def as_amplitudes(state):
    return np.array([state[0] + 1j * state[1], state[2] + 1j * state[3]])


def test_the_energy_of_a_ring_is_that_of_the_paper():
    state = random_ring()
    expected = hamiltonian(as_amplitudes(state), NUMBERS, "periodic")
    assert 7 * ring_energies(state[None], CONSTANTS)[0] == pytest.approx(expected, rel=1e-12)


def test_a_change_of_one_site_changes_the_energy_by_its_terms():
    old = random_ring()
    new = old.copy()
    new[:, 2] += [0.3, -0.2, 0.5, 0.1]
    left, right = old[:, 1], old[:, 3]
    change = site_energy(NUMBERS, *new[:, 2], left, right)
    change -= site_energy(NUMBERS, *old[:, 2], left, right)
    energies = [hamiltonian(as_amplitudes(state), NUMBERS, "periodic") for state in (old, new)]
    assert change == pytest.approx(energies[1] - energies[0], rel=1e-9)


def test_the_sampled_temperature_obeys_equipartition():
    """<y dH/dy> is four over beta a site: four times the cubic energy, twice the rest."""
    found = sample(CONSTANTS, 0.2)
    density = np.abs(found.states[:, 0::2] + 1j * found.states[:, 1::2]) ** 2
    cubic = 0.25 * (density**2).sum(axis=1).mean()
    assert 4.0 * cubic + 2.0 * (found.energies.mean() - cubic) == pytest.approx(4.0 / 0.2, rel=0.05)


def test_no_energy_and_the_same_numbers_every_time():
    found, again = (zero_energy(constants_of((1.0, 1.0, 2.0)), halvings=7) for _ in range(2))
    assert np.array_equal(found.states, again.states)
    assert abs(found.energies.mean()) < 1.5  # of cubic energies of twenty
    power = found.at_zero_energy((found.states**2).sum(axis=1).mean(axis=1))
    assert power == pytest.approx(11.3, rel=0.02)


def test_where_every_state_has_energy_there_is_none():
    with pytest.raises(ValueError, match="without energy"):
        zero_energy(constants_of((1.0, 1.0, 8.0)))


def test_the_error_of_a_mean_is_that_of_other_seeds():
    """Their scatter is known to a quarter or so from eight seeds."""
    drawn = [sample(CONSTANTS, 0.2, seed) for seed in range(8)]
    powers = [(one.states**2).sum(axis=1).mean(axis=1) for one in drawn]
    means = [one.at_zero_energy(power) for one, power in zip(drawn, powers, strict=True)]
    errors = [one.error_at_zero_energy(power) for one, power in zip(drawn, powers, strict=True)]
    assert 0.5 < np.std(means, ddof=1) / np.mean(errors) < 2.0
