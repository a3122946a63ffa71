"""Many runs of unlike ends: each against a run by another solver, and what a lost one counts as."""

import numpy as np
from oracle import BOUNDARIES, hamiltonian
from pendula.studies.theory.equations import run, run_powers, squared_norm
from problems import constants_of

END, OUTPUTS = 1.0, 2


def draw(runs):
    """Return constants, boundaries in turns, and amplitudes of three sites."""
    rng = np.random.default_rng(0)
    constants = np.column_stack([rng.uniform(0.5, 1.5, (runs, 2)), rng.uniform(-4, 8, runs)])
    boundaries = [BOUNDARIES[i % len(BOUNDARIES)] for i in range(runs)]
    return constants, boundaries, rng.normal(size=(runs, 2, 3, 2)) @ (1.0, 1j)


def test_each_run_keeps_its_place_its_ends_and_its_parameters():
    constants, boundaries, data = draw(7)
    given = list(map(constants_of, constants))
    powers, energies = run_powers(given, boundaries, data, END, OUTPUTS)
    for i, boundary in enumerate(boundaries):
        alone = run(given[i], boundary, data[i], END, OUTPUTS)
        np.testing.assert_allclose(powers[i], squared_norm(alone.l2), rtol=1e-10)
        np.testing.assert_allclose(energies[i], hamiltonian(data[i], constants[i], boundary))


def test_a_run_that_is_refused_has_an_infinite_power_after_its_start():
    constants, boundaries, data = draw(4)
    constants[2, 0] = 1e300
    given = list(map(constants_of, constants))
    powers, energies = run_powers(given, boundaries, data, END, OUTPUTS)
    lost = np.zeros((4, 3), bool)
    lost[2, 1:] = True
    np.testing.assert_array_equal(powers == np.inf, lost)
    np.testing.assert_allclose(powers[2, 0], np.sum(np.abs(data[2]) ** 2))
    np.testing.assert_allclose(energies[2], hamiltonian(data[2], constants[2], boundaries[2]))
