"""delfour_fortin_payre: its implicit equation, and the energy that it keeps."""

import numpy as np
import pytest
from on_chains import data_of, integrate, numbers_of
from oracle import BOUNDARIES, SOLVERS, random_chain, slope

NUMBERS = (1.0, 1.0, -4.0)


def run(z, end, outputs=1, numbers=NUMBERS, boundary="dirichlet", **controls):
    solver = SOLVERS["delfour_fortin_payre"] | controls
    return integrate(z, solver, end, outputs, numbers=numbers, boundary=boundary)


@pytest.mark.parametrize("boundary", BOUNDARIES)
def test_one_step_solves_the_implicit_equation(boundary):
    z, h = random_chain(3), 0.05
    new = run(z, h, boundary=boundary, step=h).final
    mean = (z + new) / 2
    mean_square = (np.abs(z) ** 2 + np.abs(new) ** 2) / 2
    linear = slope(mean, NUMBERS, boundary) + 0.5j * np.abs(mean) ** 2 * mean
    np.testing.assert_allclose(new, z + h * (linear - 0.5j * mean_square * mean), atol=1e-13)


@pytest.mark.parametrize("tolerance", [1e-10, 1e-12, 1e-14])
def test_the_energy_is_kept_to_the_tolerance_of_the_iteration(tolerance):
    """At most H's slope (below 1e3 here) times the tolerance a step, over 4000 steps of chaos."""
    numbers = numbers_of("fig4_large")
    trajectory = run(data_of("fig3_large"), 20.0, 40, numbers, step=0.005, tolerance=tolerance)
    drift = np.abs(trajectory.energy - trajectory.energy[0]).max()
    assert drift < 4000 * 1e3 * tolerance
    assert drift < 1e-5


def test_long_steps_keep_the_energy_although_they_lose_the_solution():
    trajectory = run(random_chain(5), 20.0, 40, step=0.1)
    assert np.abs(trajectory.energy - trajectory.energy[0]).max() < 1e-10
