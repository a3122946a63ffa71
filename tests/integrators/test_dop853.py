"""dop853: Hairer's coefficients, its order, its step control, and the paper's cases."""

import numpy as np
import plain
import pytest
import systems
from on_chains import data_of, integrate, numbers_of
from oracle import CASES, random_chain, slope
from pendula.integrators import DONE, dop853
from pendula.simulation.lattice import find_reduction
from scipy.integrate import DOP853 as PUBLISHED
from trees import defect


@pytest.fixture(scope="module")
def matrix():
    """Return the coefficients of all 16 stages, read off the compiled code with unit slopes."""
    a = np.zeros((16, 16))
    for stage in range(2, 17):
        dop853.combine(stage, np.zeros(16), 1.0, np.eye(16), a[stage - 1])
    return a


def unit_slopes():
    """Return slopes of 16 stages, each alone in a column of its own."""
    k = np.zeros((16, 2, 18))
    k[:, 0, 1:17] = np.eye(16)
    return k


def interpolation_weights(fraction, solution):
    """Return the weights of the interpolant over a step that ends with the weights `solution`."""
    y, w, out, c = np.zeros((2, 18)), np.zeros((2, 18)), np.zeros((2, 18)), np.zeros((7, 2, 18))
    w[0, 1:17] = solution
    dop853.prepare_interpolant(y, w, 1.0, unit_slopes(), c)
    dop853.interpolate(fraction, y, c, out)
    return out[0, 1:17]


def error_weights(row):
    out = np.zeros(16)
    dop853.weigh_slopes(np.eye(16), row, out)
    return out


def error_of(y, w, h, k, tolerances):
    spare = np.zeros((2, *y.shape))
    found = dop853.error_estimates(y, w, k, spare[0], spare[1], tolerances, (1, y.shape[1] - 1))
    return dop853.step_error(h, *found)


def test_every_stage_has_the_published_coefficients(matrix):
    np.testing.assert_array_equal(matrix[:12, :12], PUBLISHED.A)
    np.testing.assert_array_equal(matrix[12, :12], PUBLISHED.B)
    np.testing.assert_array_equal(matrix[13:], PUBLISHED.A_EXTRA)


@pytest.mark.parametrize(("name", "row"), [("E3", dop853.THIRD), ("E5", dop853.FIFTH)])
def test_error_estimates_have_the_published_coefficients(name, row):
    expected = np.append(getattr(PUBLISHED, name), [0.0, 0.0, 0.0])
    np.testing.assert_array_equal(error_weights(row), expected)


def test_the_interpolant_has_the_published_coefficients():
    c = np.zeros((7, 2, 18))
    dop853.prepare_interpolant(np.zeros((2, 18)), np.zeros((2, 18)), 1.0, unit_slopes(), c)
    np.testing.assert_array_equal(c[3:, 0, 1:17], PUBLISHED.D)


def test_every_stage_stands_where_its_weights_say(matrix):
    nodes = dop853.NODES[1:]
    np.testing.assert_allclose(nodes[1:], matrix.sum(axis=1)[1:], rtol=0, atol=2e-14)
    assert np.array_equal(nodes[:12], PUBLISHED.C)


def test_the_solution_is_of_order_eight(matrix):
    assert defect(matrix, matrix[12], 8) < 1e-13
    assert defect(matrix, matrix[12], 9) > 1e-8


def test_the_error_estimates_are_of_orders_five_and_three(matrix):
    fifth, third = error_weights(dop853.FIFTH), error_weights(dop853.THIRD)
    assert defect(matrix, fifth, 5, expected=0.0) < 1e-13
    assert defect(matrix, third, 3, expected=0.0) < 1e-13


@pytest.mark.parametrize("fraction", [0.0, 0.1, 0.5, 0.9, 1.0])
def test_the_interpolant_is_of_order_seven_everywhere(matrix, fraction):
    b = interpolation_weights(fraction, matrix[12])
    assert defect(matrix, b, 7, fraction) < 1e-13


def test_the_error_combines_two_estimates_in_the_largest_component():
    rng = np.random.default_rng(0)
    k, y, w = rng.normal(size=(16, 4, 5)), rng.normal(size=(4, 5)), rng.normal(size=(4, 5))
    z, new = (u[0::2, 1:-1] + 1j * u[1::2, 1:-1] for u in (y, w))
    stages = k[:13, 0::2, 1:-1] + 1j * k[:13, 1::2, 1:-1]
    scale = 0.3 + 0.2 * plain.larger(z, new)
    e5, e3 = (
        np.max(np.abs(np.tensordot(e, stages, 1)) / scale) for e in (PUBLISHED.E5, PUBLISHED.E3)
    )
    expected = 0.7 * e5**2 / np.sqrt(e5**2 + 0.01 * e3**2)
    assert error_of(y, w, 0.7, k, (0.2, 0.3)) == pytest.approx(expected, rel=1e-12)


@pytest.mark.parametrize("stage", [0, 11])
def test_a_nan_is_never_a_small_error(stage):
    k, y = np.zeros((16, 2, 4)), np.ones((2, 4))
    k[stage, 1, 2] = np.nan
    assert error_of(y, y, 0.1, k, (1e-6, 1e-6)) == np.inf


@pytest.mark.parametrize("rtol", [1e-2, 1e-5, 1e-10])
def test_step_control_is_the_published_one_on_the_chain(rtol):
    z, times, numbers = 2 * random_chain(3), np.linspace(0.0, 4.0, 3), (1.0, 1.0, -4.0)
    solver = {"name": "dop853", "rtol": rtol, "atol": 1e-2 * rtol}
    fast = integrate(z, solver, 4.0, 2, numbers=numbers, boundary="free")
    final, steps, rejected = plain.dop853(
        lambda u: slope(u, numbers, "free"), z, times, rtol, 1e-2 * rtol
    )
    assert (fast.outcome.steps, fast.outcome.rejected) == (steps, rejected)
    assert fast.outcome.evaluations == 2 + 12 * (steps + rejected) + 3 * 2
    np.testing.assert_allclose(fast.final, final, atol=1e-8)


@pytest.mark.parametrize(
    ("mu", "start", "times"),
    [
        (1.0, 2.0 + 0.5j, [0.0, 10.0, 20.0]),
        (30.0, 2.0 + 0.5j, [0.0, 10.0, 20.0]),
        (1.0, 2.0 + 0.5j, [0.0, 1e-9, 5.0]),  # the first steps grow as fast as they may
        (300.0, 2.0 + 0.0j, [0.0, 0.5, 1.0]),  # the first steps are far too long
    ],
)
def test_step_control_is_the_published_one_through_sudden_turns(mu, start, times):
    _, final, outcome = systems.run("dop853", mu, times, (1e-4, 1e-6), start)
    expected, steps, rejected = plain.dop853(
        systems.oscillator(mu), np.array([start]), times, 1e-4, 1e-6
    )
    assert (outcome.steps, outcome.rejected) == (steps, rejected)
    assert rejected > 0
    assert final == pytest.approx(expected[0], rel=1e-8)


def test_a_system_at_rest_lets_the_step_grow_sixfold():
    _, _, outcome = systems.run("dop853", 1.0, [0.0, 10.0], (1e-6, 1e-6), start=0j)
    # 1e-6 (6^n - 1) / 5 first passes 10 at n = 10
    assert (outcome.steps, outcome.rejected) == (10, 0)


@pytest.mark.parametrize(("beyond", "expected"), [(-1e-3, 3), (5e-10, 3), (5e-9, 4)])
def test_no_remnant_of_the_order_of_rounding_is_left(beyond, expected):
    """At rest the third step is 36e-6 long and ends at 43e-6; a step may stretch by 1e-9."""
    times = [0.0, 43e-6 + beyond * 36e-6]
    _, _, outcome = systems.run("dop853", 1.0, times, (1e-6, 1e-6), start=0j)
    assert outcome.steps == expected


def test_a_single_step_errs_by_its_ninth_power_or_less():
    errors = np.zeros(2)
    for i, times in enumerate(([0.0, 0.3], [0.0, 0.15])):
        for start in (2 + 0.5j, 1 - 1j, 0.5 + 2j, -1 + 1.5j):
            _, final, outcome = systems.run("dop853", 1.0, times, (1e3, 1e3), start)
            assert outcome.steps == 1
            errors[i] += abs(final - systems.accurate(1.0, times, start)[-1])
    assert 8.8 < np.log2(errors[0] / errors[1]) < 10.0


def test_outputs_between_steps_are_as_good_as_the_steps():
    times = np.linspace(0.0, 10.0, 1001)
    values, final, outcome = systems.run("dop853", 1.0, times, (1e-10, 1e-10))
    assert outcome.steps < 100  # most outputs are interpolated
    np.testing.assert_allclose(values, systems.accurate(1.0, times), atol=1e-9)
    assert values[-1] == pytest.approx(final, rel=1e-14)


def test_sites_at_rest_do_not_change_the_steps():
    """A root-mean-square norm would be diluted by them; without coupling nothing else could."""
    wide = np.zeros((2, 41), complex)
    wide[:, 20] = 2.0, 1.0
    runs = [
        integrate(z, "dop853", 3.0, 3, numbers=(0.0, 1.0, -4.0), boundary="free")
        for z in (wide[:, 20:21], wide)
    ]
    assert runs[0].outcome == runs[1].outcome
    np.testing.assert_array_equal(runs[0].final[:, 0], runs[1].final[:, 20])


@pytest.mark.parametrize("case", CASES)
def test_the_papers_cases_agree_with_scipy(case, scipy_solution):
    z, solver = data_of(case), {"name": "dop853", "rtol": 1e-13, "atol": 1e-13}
    run = integrate(z, solver, 2.0, 80, find_reduction(z), numbers=numbers_of(case))
    assert np.linalg.norm(run.final - scipy_solution(case, 2.0)) < 1e-9


@pytest.mark.parametrize("case", ["fig2_small", "fig3_small"])
def test_a_tenth_of_the_tolerance_makes_a_tenth_of_the_error(case, scipy_solution):
    errors = []
    for tolerance in (1e-9, 1e-10):
        solver = {"name": "dop853", "rtol": tolerance, "atol": tolerance}
        final = integrate(data_of(case), solver, 2.0, 80, numbers=numbers_of(case)).final
        errors.append(np.abs(final - scipy_solution(case, 2.0)).max())
    assert errors[0] / errors[1] == pytest.approx(10.0, rel=0.3)


def test_a_solution_that_blows_up_is_reported_where_it_does():
    times = np.linspace(0.0, 10.0, 41)
    values, _, outcome = systems.run("dop853", -1.0, times, (1e-7, 1e-9), start=3.0 + 1.0j)
    assert outcome.status != DONE
    np.testing.assert_array_equal(np.isfinite(values), times <= outcome.time)


def test_a_first_guess_of_the_step_is_a_hundredth_of_the_time_scale():
    guesses = [((1.0, 0.5), 0.02), ((2e-5, 1.0), 2e-7), ((1e-6, 1.0), 1e-6), ((1.0, 1e-6), 1e-6)]
    for sizes, expected in guesses:
        assert dop853.euler_step(*sizes) == pytest.approx(expected, rel=1e-15)


def test_a_step_changes_by_the_eighth_root_of_its_error():
    assert [dop853.step_factor(error) for error in (0.0, 2.0**-8, 2.0**8)] == [6.0, 1.8, 0.45]


@pytest.mark.parametrize("estimates", [(np.inf, 1.0), (1.0, np.inf), (np.inf, np.inf)])
def test_an_estimate_that_overflows_is_an_infinite_error(estimates):
    assert dop853.step_error(1.0, *estimates) == np.inf


def test_a_norm_counts_the_columns_that_are_asked_for_and_nothing_else():
    v, y = np.full((4, 6), 1e6), np.ones((4, 6))
    v[:, 2:4] = [[0.3, 0.0], [0.4, 0.0], [0.0, 1.2], [0.0, 0.5]]
    spare = np.full((4, 6), 1e9)
    assert dop853.weighted_norm(v, y, y, spare, (0.0, 2.0), (2, 4)) == pytest.approx(0.65)
    assert dop853.weighted_norm(v[:2], y[:2], y[:2], spare, (0.0, 2.0), (2, 4)) == 0.25


def test_interpolating_leaves_ghosts_alone():
    out = np.full((2, 5), 7.0)
    dop853.interpolate(0.5, np.ones((2, 5)), np.zeros((7, 2, 5)), out)
    np.testing.assert_array_equal(out, [[7.0, 1.0, 1.0, 1.0, 7.0]] * 2)
    c = np.full((7, 2, 5), 7.0)
    dop853.prepare_interpolant(np.ones((2, 5)), np.ones((2, 5)), 0.1, np.zeros((16, 2, 5)), c)
    np.testing.assert_array_equal(c[:3], [[[7.0, 0.0, 0.0, 0.0, 7.0]] * 2] * 3)


def stopped_after_a_step(end, controls, start):
    """Return the outcome of a run that is stopped when its first step is taken."""
    record, stop = systems.stopped_by(1, 3)
    times = np.array([0.0, 1e-15 * end, end])
    return systems.run("dop853", 1.0, times, controls, start, record, stop)[2]


@pytest.mark.parametrize(
    ("start", "controls", "end"),
    [
        (2.0 + 0.5j, (1e-6, 1e-6), 10.0),
        (0.1 + 0.5j, (1e-3, 1e-6), 10.0),
        (1e-9 + 0j, (0.0, 1e-3), 10.0),  # almost at rest: a hundred times the least guess
        (2.0 + 0.5j, (10.0, 10.0), 100.0),  # slow, but not at rest
        (2.0 + 0.5j, (10.0, 10.0), 0.25),
    ],
)
def test_the_first_step_is_the_published_one(start, controls, end):
    f, z = systems.oscillator(1.0), np.array([start])
    expected = plain.dop853_start(f, z, f(z), *controls, end)
    outcome = stopped_after_a_step(end, controls, start)
    assert outcome.rejected == 0
    assert outcome.time == pytest.approx(min(expected, end), rel=1e-9)


def test_data_at_rest_are_not_refused_for_a_first_guess_that_is_too_short():
    """The guess is 1e-6, and twice the shortest step takes its place where that is longer."""
    for first in (0.0, -1e5):
        times = [first, first + 1e5]
        _, _, outcome = systems.run("dop853", 1.0, times, (1e-6, 1e-6), start=0j)
        # 2e-5 (6^n - 1) / 5 first passes 1e5 at n = 14
        assert (outcome.status, outcome.steps, outcome.rejected) == (DONE, 14, 0)
    for end, expected in ((1e5, 2e-5), (1e4, 2e-6), (9e3, 1e-6)):
        assert stopped_after_a_step(end, (0.0, 1e-3), 1e-20 + 0j).time == pytest.approx(expected)


def test_the_first_step_too_leaves_no_remnant_of_the_order_of_rounding():
    times = [0.0, 1e-6 * (1.0 + 1e-9)]
    assert systems.run("dop853", 1.0, times, (1e-6, 1e-6), start=0j)[2].steps == 1


def test_a_run_that_begins_before_zero_is_given_up_where_any_other_is():
    """A solution that blows up is told by steps too short for the run, whatever its first time."""
    (status, *here), (other, *there) = systems.given_up("dop853"), systems.given_up("dop853", -10.0)
    assert status == other != DONE
    assert there == pytest.approx(here, abs=5.0e-2)
