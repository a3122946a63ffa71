"""crank_nicolson: its scheme, its order, and what happens where the iteration does not contract."""

from itertools import pairwise

import numpy as np
import pytest
import systems
from on_chains import data_of, integrate, numbers_of
from oracle import BOUNDARIES, SOLVERS, random_chain, slope
from pendula.integrators import DONE
from pendula.simulation.lattice import find_reduction
from pendula.simulation.simulate import IntegrationError

NUMBERS = (1.0, 1.0, -4.0)


def run(z, end, outputs=1, numbers=NUMBERS, boundary="dirichlet", **controls):
    solver = SOLVERS["crank_nicolson"] | controls
    reduction = find_reduction(z)
    return integrate(z, solver, end, outputs, reduction, numbers=numbers, boundary=boundary)


def large():
    return data_of("fig3_large")


def exact_final(end):
    """Return what the large data become, by a solver of order eight."""
    return integrate(large(), "dop853", end, numbers=NUMBERS).final


@pytest.mark.parametrize("boundary", BOUNDARIES)
def test_one_step_solves_the_implicit_equation(boundary):
    z, h = random_chain(3), 0.05
    new = run(z, h, boundary=boundary, step=h).final
    mean = (z + new) / 2
    mean_square = (np.abs(z) ** 2 + np.abs(new) ** 2) / 2
    linear = slope(mean, NUMBERS, boundary) + 0.5j * np.abs(mean) ** 2 * mean
    np.testing.assert_allclose(new, z + h * (linear - 0.5j * mean_square * mean), atol=1e-13)


def test_later_steps_solve_it_too():
    z, h = random_chain(3), 0.05
    at_once = run(z, 3 * h, step=h).final
    one_by_one = z
    for _ in range(3):
        one_by_one = run(one_by_one, h, step=h).final
    np.testing.assert_allclose(at_once, one_by_one, atol=1e-12)


def test_the_last_two_steps_spare_iterations_in_the_next():
    z = random_chain(3)
    costs = [run(z, n * 0.005).outcome.evaluations for n in (1, 40)]
    assert costs[1] / 40 < costs[0] - 0.5


def test_the_order_is_two():
    finals = [run(large(), 2.0, step=h).final for h in (0.01, 0.005, 0.0025, 0.00125)]
    changes = [np.linalg.norm(coarse - fine) for coarse, fine in pairwise(finals)]
    assert changes[0] / changes[1] == pytest.approx(4.0, abs=0.05)
    assert changes[1] / changes[2] == pytest.approx(4.0, abs=0.02)


def test_halving_the_step_leads_to_the_solution():
    accurate = exact_final(2.0)
    coarse, fine = (run(large(), 2.0, step=h).final for h in (0.0025, 0.00125))
    extrapolated = (4 * fine - coarse) / 3
    np.testing.assert_allclose(extrapolated, accurate, atol=1e-5)


@pytest.mark.parametrize("tolerance", [1e-10, 1e-12, 1e-14])
def test_the_energy_is_kept_to_the_tolerance_of_the_iteration(tolerance):
    """At most H's slope (below 1e3 here) times the tolerance a step, over 4000 steps of chaos."""
    numbers = numbers_of("fig4_large")
    trajectory = run(large(), 20.0, 40, numbers, step=0.005, tolerance=tolerance)
    drift = np.abs(trajectory.energy - trajectory.energy[0]).max()
    assert drift < 4000 * 1e3 * tolerance
    assert drift < 1e-5


def test_long_steps_keep_the_energy_although_they_lose_the_solution():
    trajectory = run(random_chain(5), 20.0, 40, step=0.1)
    assert np.abs(trajectory.energy - trajectory.energy[0]).max() < 1e-10


def test_conjugation_reverses_even_inaccurate_steps():
    z = random_chain(2)
    there = run(z, 2.0, step=0.02)
    assert there.outcome.rejected == 0
    back = np.conj(run(np.conj(there.final), 2.0, step=0.02).final)
    np.testing.assert_allclose(back, z, atol=1e-9)


@pytest.mark.parametrize(
    ("step", "steps"), [(1.0, 3), (0.5, 3), (0.5 / 3, 9), (0.16, 12), (0.5 / 7, 21)]
)
def test_outputs_are_reached_in_equal_steps_none_longer_than_asked(step, steps):
    outcome = run(0.1 * random_chain(1), 1.5, 3, (0.1, 0.1, 0.1), step=step).outcome
    assert (outcome.steps, outcome.rejected) == (steps, 0)


def test_unequal_outputs_do_not_disturb_the_scheme():
    system, controls = (-1.0, 0.2), (0.1, 1e-14, 50)
    finals = [
        systems.run("crank_nicolson", system, times, controls, 1 + 0j)[1]
        for times in ([0.0, 0.1, 0.4, 0.5], [0.0, 0.5])
    ]
    assert finals[0] == pytest.approx(finals[1], rel=1e-13)


@pytest.mark.parametrize(("step", "halvings"), [(1.5, 0), (3.0, 1), (6.0, 2), (13.0, 3)])
def test_a_step_that_does_not_contract_is_halved_and_reported(step, halvings):
    """For x' = -x the iteration contracts below h = 2, and a step divides by (2 + h) / (2 - h)."""
    factors, times, controls = (-1.0, 0.0), [0.0, 2 * step], (step, 1e-13, 500)
    _, final, outcome = systems.run("crank_nicolson", factors, times, controls, 1 + 0j)
    h = step / 2**halvings
    assert (outcome.steps, outcome.rejected) == (2, 2 * halvings)
    assert final.real == pytest.approx(((2 - h) / (2 + h)) ** (2 * 2**halvings), abs=1e-12)


def test_too_few_iterations_halve_the_step_as_well():
    accurate = exact_final(1.0)
    halved = run(large(), 1.0, step=0.002, iterations=5)
    whole = run(large(), 1.0, step=0.002)
    assert halved.outcome.rejected > whole.outcome.rejected == 0
    error, usual = (np.abs(r.final - accurate).max() for r in (halved, whole))
    assert error <= usual


@pytest.mark.parametrize(("amplitude", "iterations"), [(1e6, 50), (1.0, 1)])
def test_where_halving_does_not_help_the_run_ends(amplitude, iterations):
    with pytest.raises(IntegrationError, match=r"^crank_nicolson stopped at tau = 0: .* contract"):
        run(amplitude * random_chain(1), 1e-4, iterations=iterations)


def test_a_solution_that_blows_up_is_reported_where_it_does():
    """x' = x^2 from 1 ends at t = 1."""
    times = np.linspace(0.0, 2.0, 41)
    controls = 0.01, 1e-12, 50
    values, _, outcome = systems.run("crank_nicolson", (0.0, 1.0), times, controls, 1 + 0j)
    assert outcome.status != DONE
    assert outcome.time == pytest.approx(1.0, abs=0.02)
    assert outcome.rejected > 0
    np.testing.assert_array_equal(np.isfinite(values), times <= outcome.time)
