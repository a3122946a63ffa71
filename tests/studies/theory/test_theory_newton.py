"""Newton's equations beside an independent solver, their resonance, and the energy behind H."""

import numpy as np
import pytest
from pendula.problem import Constants
from pendula.studies.theory.equations import one_pair, total_energy
from pendula.studies.theory.newton import averaged_energy, driven_growth, pendula_run
from scipy.integrate import solve_ivp

CONSTANTS = Constants(epsilon=0.7, gamma=1.3, omega=-2.0)


def newton(t, flat, constants, mu):
    """Return the rates of (1), written pendulum by pendulum."""
    x, velocity = flat.reshape(2, 2, -1)
    frequency = np.sqrt(1.0 + mu**2 * constants.omega)
    drive = 2.0 * constants.gamma * mu**2 * np.cos(2.0 * frequency * t)
    force = -np.sin(x)
    for own in range(2):
        for n in range(x.shape[1]):
            left = x[own, n - 1] if n > 0 else 0.0
            right = x[own, n + 1] if n + 1 < x.shape[1] else 0.0
            force[own, n] += constants.epsilon * mu**2 * (left - 2.0 * x[own, n] + right)
            force[own, n] += drive * (x[1 - own, n] - x[own, n])
    return np.concatenate([velocity.ravel(), force.ravel()])


def test_the_pendula_follow_an_independent_solver():
    mu, times = 0.2, np.linspace(0.0, 40.0, 5)
    angles, velocities = pendula_run(CONSTANTS, mu, one_pair(3, (1.0, 0.4 - 0.3j)), times)
    start = np.concatenate([angles[0].ravel(), velocities[0].ravel()])
    controls = {"method": "DOP853", "rtol": 1e-11, "atol": 1e-12}
    found = solve_ivp(newton, (0.0, times[-1]), start, args=(CONSTANTS, mu), **controls).y[:, -1]
    np.testing.assert_allclose(angles[-1].ravel(), found[:6], atol=1e-9)
    np.testing.assert_allclose(velocities[-1].ravel(), found[6:], atol=1e-9)


def test_a_pair_grows_at_twice_gamma_at_one_to_two_and_nowhere_else():
    assert driven_growth(0.8, 0.05, 2.0) == pytest.approx(1.6, rel=1e-3)
    assert driven_growth(0.8, 0.05, 1.3) == 0.0
    assert driven_growth(0.0, 0.05, 2.0) == pytest.approx(0.0, abs=1e-3)


def test_averaged_energy_tends_to_the_energy_of_the_amplitudes():
    data = one_pair(3, (1.0, 0.5j))
    energy = total_energy(CONSTANTS, "dirichlet", data)
    coarse, fine = (averaged_energy(CONSTANTS, mu, data) - energy for mu in (0.2, 0.1))
    assert coarse / fine == pytest.approx(4.0, rel=0.02)
