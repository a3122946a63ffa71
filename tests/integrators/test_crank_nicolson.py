"""crank_nicolson: the trapezoidal rule, against plain NumPy, the midpoint rule, and the energy."""

import numpy as np
import pytest
import systems
from on_chains import data_of, integrate, numbers_of
from oracle import BOUNDARIES, SOLVERS, hamiltonian, random_chain, slope

NUMBERS = (1.0, 1.0, -4.0)
STEP = 0.0025
"""The step of config.yaml."""


def run(z, end, outputs=1, numbers=NUMBERS, boundary="dirichlet", **controls):
    solver = SOLVERS["crank_nicolson"] | controls
    return integrate(z, solver, end, outputs, numbers=numbers, boundary=boundary)


def follow(z, steps, h, numbers, boundary="dirichlet"):
    """Return z after each step of the trapezoidal rule, iterated until nothing changes."""
    found = [z]
    for _ in range(steps):
        base = z + h / 2 * slope(z, numbers, boundary)
        new, before = z, np.inf
        while (
            change := np.abs((next_ := base + h / 2 * slope(new, numbers, boundary)) - new).max()
        ) < before:
            new, before = next_, change
        z = new
        found.append(z)
    return np.array(found)


@pytest.mark.parametrize("boundary", BOUNDARIES)
def test_one_step_solves_the_implicit_equation(boundary):
    z, h = random_chain(3), 0.05
    new = run(z, h, boundary=boundary, step=h).final
    mean = (slope(z, NUMBERS, boundary) + slope(new, NUMBERS, boundary)) / 2
    np.testing.assert_allclose(new, z + h * mean, atol=1e-13)


@pytest.mark.parametrize("case", ["fig2_large", "fig4_small"])
def test_it_is_the_trapezoidal_rule_as_plain_numpy_has_it(case):
    z, numbers = data_of(case), numbers_of(case)
    expected = follow(z, 200, STEP, numbers)
    trajectory = run(z, 0.5, 20, numbers, step=STEP, tolerance=1e-14)
    np.testing.assert_allclose(trajectory.final, expected[-1], atol=1e-10)
    l2 = np.sqrt((np.abs(expected[::10]) ** 2).sum(axis=2)).T
    np.testing.assert_allclose(trajectory.l2, l2, atol=1e-10)
    energy = [hamiltonian(state, numbers, "dirichlet") for state in expected[::10]]
    np.testing.assert_allclose(trajectory.energy, energy, atol=1e-8)


@pytest.mark.parametrize("h", [0.01, 0.5, 1.9])
def test_a_linear_equation_is_divided_by_a_known_factor(h):
    """Of x' = -x a step leaves (2 - h) / (2 + h)."""
    steps, controls = 7, (h, 1e-14, 1000)
    times = [0.0, steps * h]
    _, final, outcome = systems.run("crank_nicolson", (-1.0, 0.0), times, controls, 1 + 0j)
    assert (outcome.steps, outcome.rejected) == (steps, 0)
    assert final.real == pytest.approx(((2 - h) / (2 + h)) ** steps, rel=1e-11)


def test_half_an_explicit_step_carries_it_into_the_implicit_midpoint_rule():
    """So the two readings of the paper's words differ by a change of variables of order h."""
    z, h, end = random_chain(5), 0.02, 3.0
    shifted = z + h / 2 * slope(z, NUMBERS, "dirichlet")
    midpoint = SOLVERS["implicit_midpoint"] | {"step": h}
    other = integrate(shifted, midpoint, end, numbers=NUMBERS).final
    final = run(z, end, step=h).final
    np.testing.assert_allclose(
        final + h / 2 * slope(final, NUMBERS, "dirichlet"), other, atol=1e-10
    )
    assert np.abs(final - integrate(z, midpoint, end, numbers=NUMBERS).final).max() > 1e-4


@pytest.mark.parametrize(
    ("case", "least", "most"),
    [("fig2_small", 3e-5, 3.5e-5), ("fig3_small", 1.9e-5, 2.2e-5), ("fig2_large", 4e-2, 4.3e-2)],
)
def test_the_energy_drifts_by_the_square_of_the_step_and_comes_back(case, least, most):
    numbers, drifts = numbers_of(case), {}
    for h in (STEP, STEP / 2):
        energy = run(data_of(case), 50.0, 2000, numbers, step=h).energy
        drifts[h] = np.abs(energy - energy[0])
    early, whole = drifts[STEP][:401].max(), drifts[STEP].max()
    assert least < whole < most
    assert whole < 1.1 * early  # what does not grow from tau = 10 to 50 is no secular drift
    assert whole / drifts[STEP / 2].max() == pytest.approx(4.0, rel=0.02)


def test_the_energy_of_a_chaotic_case_drifts_visibly():
    energy = run(data_of("fig4_small"), 20.0, 800, numbers_of("fig4_small"), step=STEP).energy
    assert 0.05 < np.abs(energy - energy[0]).max() < 1.0


@pytest.mark.parametrize("boundary", BOUNDARIES)
def test_one_step_of_the_midpoint_rule_solves_its_equation(boundary):
    z, h = random_chain(3), 0.05
    midpoint = SOLVERS["implicit_midpoint"] | {"step": h}
    new = integrate(z, midpoint, h, numbers=NUMBERS, boundary=boundary).final
    np.testing.assert_allclose(new, z + h * slope((z + new) / 2, NUMBERS, boundary), atol=1e-13)


def test_the_midpoint_rule_keeps_the_norms_without_drive_even_by_long_steps():
    midpoint = SOLVERS["implicit_midpoint"] | {"step": 0.1}
    l2 = integrate(random_chain(5), midpoint, 20.0, 40, numbers=(1.0, 0.0, -4.0)).l2
    np.testing.assert_allclose(l2, np.tile(l2[:, :1], l2.shape[1]), rtol=1e-11)
