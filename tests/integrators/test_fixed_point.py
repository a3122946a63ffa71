"""What the schemes with a fixed-point iteration share: order, reversal, steps that are halved."""

from itertools import pairwise

import numpy as np
import pytest
import systems
from on_chains import data_of, integrate
from oracle import SOLVERS, random_chain
from pendula.integrators import DONE, NO_CONTRACTION, crank_nicolson
from pendula.integrators.fixed_point import PAST, accept, extrapolate, is_finite, size, update
from pendula.simulation.lattice import find_reduction
from pendula.simulation.simulate import IntegrationError

NUMBERS = (1.0, 1.0, -4.0)
SCHEMES = ("crank_nicolson", "implicit_midpoint", "delfour_fortin_payre")
each_scheme = pytest.mark.parametrize("scheme", SCHEMES)


def run(scheme, z, end, outputs=1, numbers=NUMBERS, **controls):
    solver = SOLVERS[scheme] | controls
    return integrate(z, solver, end, outputs, find_reduction(z), numbers=numbers)


def large():
    return data_of("fig3_large")


def exact_final(end):
    """Return what the large data become, by a solver of order eight."""
    return integrate(large(), "dop853", end, numbers=NUMBERS).final


@each_scheme
def test_later_steps_solve_it_too(scheme):
    z, h = random_chain(3), 0.05
    at_once = run(scheme, z, 3 * h, step=h).final
    one_by_one = z
    for _ in range(3):
        one_by_one = run(scheme, one_by_one, h, step=h).final
    np.testing.assert_allclose(at_once, one_by_one, atol=1e-12)


@each_scheme
def test_the_last_two_steps_spare_iterations_in_the_next(scheme):
    z = random_chain(3)
    costs = [run(scheme, z, n * 0.005).outcome.evaluations for n in (1, 40)]
    assert costs[1] / 40 < costs[0] - 0.5


@each_scheme
def test_the_order_is_two(scheme):
    finals = [run(scheme, large(), 2.0, step=h).final for h in (0.01, 0.005, 0.0025, 0.00125)]
    changes = [np.linalg.norm(coarse - fine) for coarse, fine in pairwise(finals)]
    assert changes[0] / changes[1] == pytest.approx(4.0, abs=0.1)
    assert changes[1] / changes[2] == pytest.approx(4.0, abs=0.02)


@each_scheme
def test_halving_the_step_leads_to_the_solution(scheme):
    accurate = exact_final(2.0)
    coarse, fine = (run(scheme, large(), 2.0, step=h).final for h in (0.0025, 0.00125))
    extrapolated = (4 * fine - coarse) / 3
    np.testing.assert_allclose(extrapolated, accurate, atol=1e-5)


@each_scheme
def test_conjugation_reverses_even_inaccurate_steps(scheme):
    z = random_chain(2)
    there = run(scheme, z, 2.0, step=0.02)
    assert there.outcome.rejected == 0
    back = np.conj(run(scheme, np.conj(there.final), 2.0, step=0.02).final)
    np.testing.assert_allclose(back, z, atol=1e-9)


@each_scheme
@pytest.mark.parametrize(
    ("step", "steps"), [(1.0, 3), (0.5, 3), (0.5 / 3, 9), (0.16, 12), (0.5 / 7, 21)]
)
def test_outputs_are_reached_in_equal_steps_none_longer_than_asked(scheme, step, steps):
    outcome = run(scheme, 0.1 * random_chain(1), 1.5, 3, (0.1, 0.1, 0.1), step=step).outcome
    assert (outcome.steps, outcome.rejected) == (steps, 0)


@each_scheme
def test_unequal_outputs_do_not_disturb_the_scheme(scheme):
    system, controls = (-1.0, 0.2), (0.1, 1e-14, 50)
    finals = [
        systems.run(scheme, system, times, controls, 1 + 0j)[1]
        for times in ([0.0, 0.1, 0.4, 0.5], [0.0, 0.5])
    ]
    assert finals[0] == pytest.approx(finals[1], rel=1e-13)


@each_scheme
@pytest.mark.parametrize(("step", "halvings"), [(1.5, 0), (3.0, 1), (6.0, 2), (13.0, 3)])
def test_a_step_that_does_not_contract_is_halved_and_reported(scheme, step, halvings):
    """For x' = -x the iteration contracts below h = 2, and a step divides by (2 + h) / (2 - h)."""
    factors, times, controls = (-1.0, 0.0), [0.0, 2 * step], (step, 1e-13, 500)
    _, final, outcome = systems.run(scheme, factors, times, controls, 1 + 0j)
    h = step / 2**halvings
    assert (outcome.steps, outcome.rejected) == (2, 2 * halvings)
    assert final.real == pytest.approx(((2 - h) / (2 + h)) ** (2 * 2**halvings), abs=1e-12)


@each_scheme
def test_too_few_iterations_halve_the_step_as_well(scheme):
    accurate = exact_final(1.0)
    halved = run(scheme, large(), 1.0, step=0.002, iterations=5)
    whole = run(scheme, large(), 1.0, step=0.002)
    assert halved.outcome.rejected > whole.outcome.rejected == 0
    error, usual = (np.abs(r.final - accurate).max() for r in (halved, whole))
    assert error <= usual


@each_scheme
@pytest.mark.parametrize(("amplitude", "iterations"), [(1e6, 50), (1.0, 1)])
def test_where_halving_does_not_help_the_run_ends(scheme, amplitude, iterations):
    with pytest.raises(IntegrationError, match=rf"^{scheme} stopped at tau = 0: .* contract"):
        run(scheme, amplitude * random_chain(1), 1e-4, iterations=iterations)


@each_scheme
def test_a_solution_that_blows_up_is_reported_where_it_does(scheme):
    """x' = x^2 from 1 ends at t = 1."""
    times = np.linspace(0.0, 2.0, 41)
    controls = 0.01, 1e-12, 50
    values, _, outcome = systems.run(scheme, (0.0, 1.0), times, controls, 1 + 0j)
    assert outcome.status != DONE
    assert outcome.time == pytest.approx(1.0, abs=0.02)
    assert outcome.rejected > 0
    np.testing.assert_array_equal(np.isfinite(values), times <= outcome.time)


@each_scheme
def test_spans_that_round_above_a_whole_number_of_steps_take_no_further_one(scheme):
    """In doubles 1.1 / 0.1 is above 11, and 0.3 / 0.1 below 3."""
    z = 0.1 * random_chain(1)
    assert [run(scheme, z, end, step=0.1).outcome.steps for end in (0.3, 1.1)] == [3, 11]


BEGINNING = {"crank_nicolson": 1, "implicit_midpoint": 0, "delfour_fortin_payre": 0}
"""Right-hand sides that a first step takes before its iteration."""


@each_scheme
def test_an_iteration_that_grows_is_given_up_at_its_third_change(scheme):
    """The first change is that of the guess, the second may be larger by accident.

    For x' = -x the iteration grows above h = 2, here even after all halvings.
    """
    _, _, outcome = systems.run(scheme, (-1.0, 0.0), [0.0, 2.0**23], (2.0**23, 1e-13, 50), 1 + 0j)
    assert outcome.status == NO_CONTRACTION
    assert outcome.rejected == 21
    assert outcome.evaluations == 21 * (3 + BEGINNING[scheme])


@each_scheme
def test_an_iteration_that_goes_to_and_fro_is_given_up_as_well(scheme):
    """For x' = -x and h = 2 it jumps between two values; h = 1 then halves each change."""
    _, _, outcome = systems.run(scheme, (-1.0, 0.0), [0.0, 2.0], (2.0, 1e-13, 200), 1 + 0j)
    assert (outcome.status, outcome.rejected) == (DONE, 1)
    assert 3 + 2 * 40 < outcome.evaluations < 3 + 2 * 50


@each_scheme
def test_an_iteration_that_leaves_the_doubles_is_given_up_at_once(scheme):
    """For x' = x^2 from 1e200 the first change is infinite, however short the step."""
    _, _, outcome = systems.run(scheme, (0.0, 1.0), [0.0, 1.0], (1.0, 1e-12, 50), 1e200 + 0j)
    assert (outcome.status, outcome.rejected) == (NO_CONTRACTION, 21)
    assert outcome.evaluations == 21 * (1 + BEGINNING[scheme])


@each_scheme
def test_a_run_ends_at_its_last_output(scheme):
    _, _, outcome = systems.run(scheme, (-1.0, 0.2), [0.0, 0.1, 0.4, 0.5], (0.1, 1e-14, 50), 1 + 0j)
    assert (outcome.status, outcome.time) == (DONE, 0.5)


def test_a_guess_is_exact_where_increments_are_a_polynomial_of_degree_five():
    places = np.arange(6.0).reshape(2, 3)
    past, new = np.full((PAST, 2, 3), np.nan), np.zeros((2, 3))

    def state(t):
        return (0.1 * t + places) ** 6

    for t in range(15):
        latest = t % PAST
        past[latest] = state(t + 1) - state(t)
        if t >= 5:
            extrapolate(state(t + 1), past, latest, new)
            np.testing.assert_allclose(new, state(t + 2), rtol=1e-11)


@each_scheme
@pytest.mark.parametrize("outputs", [1, 8])
def test_after_six_steps_of_a_smooth_solution_one_iteration_does(scheme, outputs):
    """The guess then errs by the seventh power of the step, which is below the tolerance."""
    costs = [
        systems.run(scheme, (-1.0, 0.0), np.linspace(0.0, 0.01 * n, outputs + 1),
                    (0.01, 1e-9, 50), 1 + 0j)[2].evaluations
        for n in (8, 48)
    ]  # fmt: skip
    assert costs[1] - costs[0] == 40


@each_scheme
@pytest.mark.parametrize(
    ("rate", "times", "lengths"),
    [
        (-1.0, [0.0, 4.0, 5.0], [1.0] * 5),  # a step of 4 is halved twice
        (-1.0, [0.0, 3.0, 4.0], [1.5, 1.5, 1.0]),
        (-1.0, [0.0, 1.0, 1.25], [1.0, 0.25]),
        (-1e6, [0.0, 1e-6, 1.8e-6], [1e-6, 0.8e-6]),
    ],
)
def test_steps_of_other_lengths_begin_anew(scheme, rate, times, lengths):
    controls = (times[1], 1e-13, 500)
    _, final, _ = systems.run(scheme, (rate, 0.0), times, controls, 1 + 0j)
    turns = -rate * np.array(lengths)
    assert final.real == pytest.approx(np.prod((2 - turns) / (2 + turns)), rel=1e-10)


@each_scheme
def test_small_data_are_iterated_as_far_as_large_ones(scheme):
    runs = [
        systems.run(scheme, (-1.0, 0.0), [0.0, 0.1, 0.4], (0.1, 1e-10, 50), scale + 0j)
        for scale in (1.0, 2.0**-40)
    ]
    assert runs[1][1] * 2.0**40 == runs[0][1]
    assert runs[1][2] == runs[0][2]


@each_scheme
@pytest.mark.parametrize(("most", "halvings", "iterations"), [(6, 0, 6), (5, 1, 5 + 4 + 4)])
def test_as_many_iterations_are_made_as_are_allowed(scheme, most, halvings, iterations):
    """For x' = -x changes shrink by h / 2: from 1 / 2 below 1e-3 in six, with halves in four."""
    controls = (0.5, 1e-3, most)
    _, _, outcome = systems.run(scheme, (-1.0, 0.0), [0.0, 0.5], controls, 1 + 0j)
    begun = BEGINNING[scheme] * (1 + 2 * halvings)
    assert outcome == (DONE, 0.5, 1, halvings, iterations + begun)


@each_scheme
def test_at_rest_each_step_takes_one_iteration(scheme):
    _, final, outcome = systems.run(scheme, (-1.0, 0.0), [0.0, 1.0], (0.5, 1e-3, 5), 0j)
    assert (final, outcome) == (0j, (DONE, 1.0, 2, 0, 2 + BEGINNING[scheme]))


@each_scheme
@pytest.mark.parametrize("times", [[0.0, 2.0], [0.0, 0.5, 2.0]])
def test_the_time_of_a_fault_is_that_of_the_steps_before_it(scheme, times):
    _, _, outcome = systems.run(scheme, (0.0, 1.0), times, (0.01, 1e-12, 50), 1 + 0j)
    assert outcome.status != DONE and outcome.steps > 60
    assert outcome.time == pytest.approx(0.01 * outcome.steps, rel=1e-12)


@pytest.mark.parametrize("place", [(0, 1), (0, 3), (1, 1), (1, 3)])
def test_the_size_of_a_state_is_that_of_its_largest_part_but_for_ghosts(place):
    y = np.full((2, 5), 0.5)
    y[:, [0, -1]] = 9.0
    y[place] = -2.0
    assert size(y) == 2.0


@pytest.mark.parametrize("value", [np.nan, np.inf, -np.inf])
@pytest.mark.parametrize("place", [(0, 0), (1, 2), (1, 4)])
def test_a_state_with_one_part_that_is_no_number_is_not_finite(place, value):
    y = np.full((2, 5), 1e300)
    assert is_finite(y)
    y[place] = value
    assert not is_finite(y)


def test_sums_leave_ghosts_alone():
    old, slope_, new = np.full((3, 2, 5), 2.0)
    new[:, [0, -1]] = 7.0
    update(old, 0.5, slope_.copy(), new)
    np.testing.assert_array_equal(new, [[7.0, 3.0, 3.0, 3.0, 7.0]] * 2)
    crank_nicolson.advance(old, 0.25, slope_, new)
    np.testing.assert_array_equal(new, [[7.0, 2.5, 2.5, 2.5, 7.0]] * 2)
    crank_nicolson.reflect(old, new)
    np.testing.assert_array_equal(new, [[7.0, 1.5, 1.5, 1.5, 7.0]] * 2)


def test_a_step_that_is_accepted_leaves_its_increment():
    old, new, increment = np.arange(30.0).reshape(3, 2, 5) ** 2
    expected, end = new - old, new.copy()
    accept(old, new, increment)
    np.testing.assert_array_equal(increment, expected)
    np.testing.assert_array_equal(old, end)
