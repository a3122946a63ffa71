"""The schemes with a fixed-point iteration: their equations, order, energy, and halved steps."""

from itertools import pairwise

import numpy as np
import pytest
import systems
from dimers import SOLVERS, case_of, integrate
from latticode.integrators import DONE, NO_CONTRACTION
from latticode.simulation.simulate import IntegrationError
from oracle import BOUNDARIES, random_chain, slope

SCHEMES = ("crank_nicolson", "delfour_fortin_payre")
BEGINNING = {"crank_nicolson": 1, "delfour_fortin_payre": 0}
"""Right-hand sides that a first step takes before its iteration."""
each_scheme = pytest.mark.parametrize("scheme", SCHEMES)


def run(z, end, outputs=1, numbers=(1.0, 1.0, -4.0), boundary="dirichlet", **controls):
    settings = {"numbers": numbers, "boundary": boundary}
    return integrate(z, SOLVERS["crank_nicolson"] | controls, end, outputs, None, **settings)


# --- What the scheme is -------------------------------------------------------------------------


@pytest.mark.parametrize("boundary", BOUNDARIES)
def test_a_step_solves_the_implicit_equation(boundary):
    z, h, numbers = random_chain(3), 0.05, (1.0, 1.0, -4.0)
    new = run(z, h, boundary=boundary, step=h).final
    mean = (slope(z, numbers, boundary) + slope(new, numbers, boundary)) / 2
    np.testing.assert_allclose(new, z + h * mean, atol=1e-13)
    third = run(run(new, h, boundary=boundary, step=h).final, h, boundary=boundary, step=h).final
    at_once = run(z, 3 * h, boundary=boundary, step=h).final
    np.testing.assert_allclose(at_once, third, atol=1e-12)


def test_the_order_is_two_and_leads_to_the_solution():
    large = case_of("fig3_large").amplitudes
    finals = [run(large, 2.0, step=h).final for h in (0.01, 0.005, 0.0025, 0.00125)]
    changes = [np.linalg.norm(coarse - fine) for coarse, fine in pairwise(finals)]
    assert changes[0] / changes[1] == pytest.approx(4.0, abs=0.1)
    assert changes[1] / changes[2] == pytest.approx(4.0, abs=0.02)
    accurate = integrate(large, "dop853", 2.0).final
    np.testing.assert_allclose((4 * finals[3] - finals[2]) / 3, accurate, atol=1e-5)


# --- Steps between outputs ----------------------------------------------------------------------


@pytest.mark.parametrize(
    ("step", "steps"), [(1.0, 3), (0.5, 3), (0.5 / 3, 9), (0.16, 12), (0.5 / 7, 21)]
)
def test_outputs_are_reached_in_equal_steps_none_longer_than_asked(step, steps):
    outcome = run(0.1 * random_chain(1), 1.5, 3, (0.1, 0.1, 0.1), step=step).outcome
    assert (outcome.status, outcome.time) == (DONE, 1.5)
    assert (outcome.steps, outcome.rejected) == (steps, 0)


def test_spans_that_round_above_a_whole_number_of_steps_take_no_further_one():
    """In doubles 1.1 / 0.1 is above 11, and 0.3 / 0.1 below 3."""
    z = 0.1 * random_chain(1)
    assert [run(z, end, step=0.1).outcome.steps for end in (0.3, 1.1)] == [3, 11]


# --- The iteration, for x' = rate x -------------------------------------------------------------


def linear(scheme, times, controls, rate=-1.0, start=1 + 0j):
    """Return the final x of x' = rate x, and the outcome."""
    return systems.run(scheme, (rate, 0.0), times, controls, start)[1:]


@each_scheme
@pytest.mark.parametrize(
    ("rate", "times", "lengths"),
    [
        (-1.0, [0.0, 0.07], [0.07]),
        (-1.0, [0.0, 1.5, 3.0], [1.5] * 2),
        (-1.0, [0.0, 4.0, 5.0], [1.0] * 5),  # a step of 4 is halved twice
        (-1.0, [0.0, 3.0, 4.0], [1.5, 1.5, 1.0]),
        (-1.0, [0.0, 1.0, 1.25], [1.0, 0.25]),
        (-1e6, [0.0, 1e-6, 1.8e-6], [1e-6, 0.8e-6]),
    ],
)
def test_each_step_divides_by_a_known_factor_whatever_the_lengths_before(
    scheme, rate, times, lengths
):
    final, _ = linear(scheme, times, (times[1], 1e-13, 500), rate)
    turns = -rate * np.array(lengths)
    assert final.real == pytest.approx(np.prod((2 - turns) / (2 + turns)), rel=1e-10)


@each_scheme
@pytest.mark.parametrize(("step", "halvings"), [(1.5, 0), (3.0, 1), (6.0, 2), (13.0, 3)])
def test_a_step_that_does_not_contract_is_halved_and_reported(scheme, step, halvings):
    """The iteration contracts below h = 2."""
    _, outcome = linear(scheme, [0.0, 2 * step], (step, 1e-13, 500))
    assert (outcome.steps, outcome.rejected) == (2, 2 * halvings)


@pytest.mark.parametrize(("amplitude", "iterations"), [(5e5, 50), (1.0, 1)])
def test_where_halving_does_not_help_the_run_ends(amplitude, iterations):
    with pytest.raises(IntegrationError, match=r"^crank_nicolson stopped at t = 0: .* contract"):
        run(amplitude * random_chain(1), 1e-4, iterations=iterations)


@each_scheme
@pytest.mark.parametrize("times", [np.linspace(0.0, 2.0, 41), [0.0, 0.5, 2.0]])
def test_a_solution_that_blows_up_is_reported_where_it_does(scheme, times):
    """x' = x^2 from 1 ends at t = 1."""
    values, _, outcome = systems.run(scheme, (0.0, 1.0), times, (0.01, 1e-12, 50), 1 + 0j)
    assert outcome.status != DONE and outcome.rejected > 0
    assert outcome.time == pytest.approx(1.0, abs=0.02)
    assert outcome.time == pytest.approx(0.01 * outcome.steps, rel=1e-12)
    np.testing.assert_array_equal(np.isfinite(values), np.asarray(times) <= outcome.time)


@each_scheme
def test_an_iteration_that_grows_is_given_up_at_its_third_change(scheme):
    """The first change is that of the guess, the second may be larger by accident.

    The iteration grows above h = 2, here even after all halvings.
    """
    _, outcome = linear(scheme, [0.0, 2.0**23], (2.0**23, 1e-13, 50))
    assert (outcome.status, outcome.rejected) == (NO_CONTRACTION, 21)
    assert outcome.evaluations == 21 * (3 + BEGINNING[scheme])


@each_scheme
def test_an_iteration_that_goes_to_and_fro_is_given_up_as_well(scheme):
    """For h = 2 it jumps between two values; h = 1 then halves each change."""
    _, outcome = linear(scheme, [0.0, 2.0], (2.0, 1e-13, 200))
    assert (outcome.status, outcome.rejected) == (DONE, 1)
    assert 3 + 2 * 40 < outcome.evaluations < 3 + 2 * 50


@each_scheme
def test_an_iteration_that_leaves_the_doubles_is_given_up_at_once(scheme):
    """For x' = x^2 from 1e200 the first change is infinite, however short the step."""
    _, _, outcome = systems.run(scheme, (0.0, 1.0), [0.0, 1.0], (1.0, 1e-12, 50), 1e200 + 0j)
    assert (outcome.status, outcome.rejected) == (NO_CONTRACTION, 21)
    assert outcome.evaluations == 21 * (1 + BEGINNING[scheme])


@each_scheme
@pytest.mark.parametrize(("most", "halvings", "iterations"), [(6, 0, 6), (5, 1, 5 + 4 + 4)])
def test_as_many_iterations_are_made_as_are_allowed(scheme, most, halvings, iterations):
    """Changes shrink by h / 2: from 1 / 2 below 1e-3 in six, with halves in four."""
    _, outcome = linear(scheme, [0.0, 0.5], (0.5, 1e-3, most))
    begun = BEGINNING[scheme] * (1 + 2 * halvings)
    assert outcome == (DONE, 0.5, 1, halvings, iterations + begun)


@each_scheme
@pytest.mark.parametrize("outputs", [1, 8])
def test_after_six_steps_of_a_smooth_solution_one_iteration_does(scheme, outputs):
    """The guess then errs by the seventh power of the step, which is below the tolerance."""
    costs = [
        linear(scheme, np.linspace(0.0, 0.01 * n, outputs + 1), (0.01, 1e-9, 50))[1].evaluations
        for n in (8, 48)
    ]
    assert costs[1] - costs[0] == 40


@each_scheme
def test_the_tolerance_is_relative_and_a_chain_at_rest_takes_one_iteration_a_step(scheme):
    arguments = [0.0, 0.1, 0.4], (0.1, 1e-10, 50)
    large, small = (linear(scheme, *arguments, start=scale + 0j) for scale in (1.0, 2.0**-40))
    assert small[0] * 2.0**40 == large[0] and small[1] == large[1]
    final, outcome = linear(scheme, [0.0, 1.0], (0.5, 1e-3, 5), start=0j)
    assert (final, outcome) == (0j, (DONE, 1.0, 2, 0, 2 + BEGINNING[scheme]))
