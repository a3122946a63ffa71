"""Random data of unlike ends in one call."""

import numpy as np
from oracle import BOUNDARIES, hamiltonian
from pendula.studies.theory.batch import run_powers
from pendula.studies.theory.runs import run, squared_norm

TIMES = [0.0, 0.5, 1.0]


def draw(runs):
    """Return constants, boundaries in turns, and amplitudes of three sites."""
    rng = np.random.default_rng(0)
    constants = np.column_stack([rng.uniform(0.5, 1.5, (runs, 2)), rng.uniform(-4, 8, runs)])
    boundaries = [BOUNDARIES[i % len(BOUNDARIES)] for i in range(runs)]
    return constants, boundaries, rng.normal(size=(runs, 2, 3, 2)) @ (1.0, 1j)


def test_each_run_keeps_its_place_its_ends_and_its_parameters():
    constants, boundaries, data = draw(7)
    powers, energies = run_powers(constants, boundaries, data, TIMES)
    for i, boundary in enumerate(boundaries):
        alone = run(constants[i], boundary, data[i], TIMES)
        np.testing.assert_allclose(powers[i], squared_norm(alone.l2), rtol=1e-10)
        np.testing.assert_allclose(energies[i], hamiltonian(data[i], constants[i], boundary))


def test_a_run_that_is_given_up_has_an_infinite_power_from_then_on():
    constants, boundaries, data = draw(4)
    constants[2, 0] = 1e300
    powers, _ = run_powers(constants, boundaries, data, TIMES)
    lost = np.zeros((4, 3), bool)
    lost[2, 1:] = True
    np.testing.assert_array_equal(powers == np.inf, lost)
