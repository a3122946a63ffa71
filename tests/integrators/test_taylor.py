"""taylor: its recurrences against plain ones, its order, its step control, the paper's cases."""

import numpy as np
import plain
import pytest
import systems
from hypothesis import given
from hypothesis import strategies as st
from on_chains import data_of, integrate, numbers_of
from oracle import BOUNDARIES, CASES, power_series, random_chain
from pendula.integrators import DONE, INTERRUPTED, NOT_FINITE, STEP_TOO_SMALL, taylor
from pendula.integrators.taylor import BLOCK_SIZE, ORDER, WORK, lay_out, write_state
from pendula.simd import LANES

TIGHT = {"name": "taylor", "rtol": 1e-13, "atol": 1e-13}


def describe(y, work):
    """Return the series of states like `y`, laid out by Python: no kernel returns a view."""
    return lay_out.py_func(work, y)


@given(st.floats(1e-300, 1e300))
def test_the_roots_have_four_digits(x):
    assert taylor.sixteenth_root(x) == pytest.approx(x ** (1 / 16), rel=1e-14)
    assert taylor.fifteenth_root(x) == pytest.approx(x ** (1 / 15), rel=1e-4)


@pytest.mark.parametrize("x", [0.0, np.inf])
def test_the_roots_of_nothing_and_of_infinity(x):
    assert taylor.sixteenth_root(x) == taylor.fifteenth_root(x) == x


@pytest.mark.parametrize("sites", [1, 3, LANES, LANES + 1, 2 * LANES])
def test_the_sum_of_a_series_is_numpys(sites):
    y = np.zeros((4, sites + 2))
    memory = np.random.default_rng(sites).normal(size=(WORK, *y.shape))
    series = describe(y, memory)
    c = series.memory[: 2 * series.blocks * BLOCK_SIZE].reshape(
        2, series.blocks, ORDER + 1, 3, LANES
    )
    expected = np.polynomial.polynomial.polyval(-0.7, np.moveaxis(c, 2, 0)[:, :, :, :2])
    expected = expected.transpose(0, 2, 1, 3).reshape(4, -1)[:, :sites]
    taylor.evaluate(series, -0.7, y)
    np.testing.assert_allclose(y[:, 1:-1], expected, rtol=1e-13, atol=1e-13)
    taylor.advance(series, -0.7)
    at_start = c[:, :, 0, :2].transpose(0, 2, 1, 3).reshape(4, -1)[:, :sites]
    np.testing.assert_array_equal(at_start, y[:, 1:-1])


@pytest.mark.parametrize("largest", [0.0, 1e-300, 1e-150, 2.0, np.inf, np.nan])
@pytest.mark.parametrize("place", [0, 5, 11])
def test_the_largest_modulus_counts_nan_as_larger_than_infinity(largest, place):
    y = np.zeros((2, 14))
    y[:, 1:-1] = 0.3 * largest
    y[1, 1 + place] = -largest
    y[0, 1 + place] = 0.0
    y[:, 1 + (place + 1) % 12] = 0.1 if np.isnan(largest) else 0.0
    series = describe(y, np.zeros((WORK, *y.shape)))
    write_state(y, series)
    assert taylor.largest_modulus(series, 0) == pytest.approx(
        largest, rel=1e-15, abs=0.0, nan_ok=True
    )


def test_a_single_step_errs_by_one_power_more_than_its_order():
    errors = np.zeros(2)
    for i, times in enumerate(([0.0, 0.5], [0.0, 0.4])):
        for start in (2 + 0.5j, 1 - 1j, 0.5 + 2j, -1 + 1.5j):
            _, final, outcome = systems.run("taylor", 1.0, times, (1e9, 1e9), start)
            assert outcome.steps == 1
            errors[i] += abs(final - systems.accurate(1.0, times, start)[-1])
    order = np.log(errors[0] / errors[1]) / np.log(0.5 / 0.4)
    assert taylor.ORDER + 0.5 < order < taylor.ORDER + 2.5


@pytest.mark.parametrize("boundary", BOUNDARIES)
@pytest.mark.parametrize("rtol", [1e-4, 1e-8, 1e-12])
def test_step_control_is_that_of_jorba_and_zou(boundary, rtol):
    z, times, numbers = 2 * random_chain(3), np.linspace(0.0, 3.0, 3), (0.7, 1.3, -4.0)
    solver = {"name": "taylor", "rtol": rtol, "atol": 1e-2 * rtol}
    fast = integrate(z, solver, 3.0, 2, numbers=numbers, boundary=boundary)
    final, steps = plain.taylor(
        lambda u, order: power_series(u, numbers, boundary, order),
        z, times, rtol, 1e-2 * rtol, taylor.ORDER,
    )  # fmt: skip
    assert fast.outcome == (DONE, 3.0, steps, 0, taylor.ORDER * steps)
    np.testing.assert_allclose(fast.final, final, atol=1e-11 + rtol)


def test_outputs_between_steps_are_as_good_as_the_steps():
    times = np.linspace(0.0, 10.0, 1001)
    values, final, outcome = systems.run("taylor", 1.0, times, (1e-12, 1e-12))
    assert outcome.steps < 100  # most outputs lie between steps
    np.testing.assert_allclose(values, systems.accurate(1.0, times), atol=1e-11)
    assert values[-1] == final


@pytest.mark.parametrize("outputs", [3, 7, 1001])
def test_outputs_do_not_change_the_steps(outputs):
    _, final, _ = systems.run("taylor", 1.0, np.linspace(0.0, 10.0, outputs), (1e-9, 1e-9))
    assert final == systems.run("taylor", 1.0, [0.0, 10.0], (1e-9, 1e-9))[1]


def test_sites_at_rest_do_not_change_the_steps():
    wide = np.zeros((2, 41), complex)
    wide[:, 20] = 2.0, 1.0
    runs = [
        integrate(z, "taylor", 3.0, 3, numbers=(0.0, 1.0, -4.0), boundary="free")
        for z in (wide[:, 20:21], wide)
    ]
    assert runs[0].outcome == runs[1].outcome
    np.testing.assert_array_equal(runs[0].final[:, 0], runs[1].final[:, 20])


def test_a_system_at_rest_is_done_in_one_step():
    _, final, outcome = systems.run("taylor", 1.0, [0.0, 10.0], (1e-6, 1e-6), start=0j)
    assert (outcome.status, outcome.steps, final) == (DONE, 1, 0j)


@pytest.mark.parametrize("case", CASES)
def test_the_papers_cases_agree_with_scipy(case, scipy_solution):
    final = integrate(data_of(case), TIGHT, 2.0, 80, numbers=numbers_of(case)).final
    assert np.linalg.norm(final - scipy_solution(case, 2.0)) < 1e-9


@pytest.mark.parametrize("case", ["fig2_small", "fig3_small"])
def test_the_error_follows_the_tolerance(case, scipy_solution):
    tolerances, errors = 10.0 ** -np.arange(4.0, 11.0), []
    for tolerance in tolerances:
        solver = {"name": "taylor", "rtol": tolerance, "atol": tolerance}
        final = integrate(data_of(case), solver, 3.0, numbers=numbers_of(case)).final
        errors.append(np.abs(final - scipy_solution(case, 3.0)).max())
    slope, _ = np.polyfit(np.log(tolerances), np.log(errors), 1)
    assert slope == pytest.approx(1.0, abs=0.25)
    assert np.all(errors < 2 * tolerances)


def test_a_solution_that_blows_up_is_reported_where_it_does():
    times = np.linspace(0.0, 10.0, 41)
    values, _, outcome = systems.run("taylor", -1.0, times, (1e-7, 1e-9), start=3.0 + 1.0j)
    assert outcome.status != DONE
    np.testing.assert_array_equal(np.isfinite(values), times <= outcome.time)


def test_a_run_that_is_stopped_at_once_has_taken_no_step():
    stop = np.ones(1, np.bool_)
    _, _, outcome = systems.run("taylor", 1.0, [0.0, 1.0], (1e-6, 1e-9), stop=stop)
    assert outcome == (INTERRUPTED, 0.0, 0, 0, 0)


def test_work_arrays_hold_the_smallest_component_and_no_more():
    """A single site of one component has two rows of three numbers in each array."""
    assert 6 * (WORK - 1) < BLOCK_SIZE + taylor.GHOSTS_SIZE <= 6 * WORK
    assert taylor.RIGHT + taylor.ORDER_STRIDE == taylor.GHOSTS_SIZE


@pytest.mark.parametrize(
    ("last_but_one", "last"), [(1.0, 1e-3), (1e-3, 1.0), (np.inf, 1.0), (1.0, np.inf)]
)
def test_a_step_is_allowed_by_the_last_two_orders(last_but_one, last):
    """The tolerance is 0.35: 0.2, and 0.3 of the modulus 0.5."""
    series = describe(np.zeros((2, 3)), np.zeros((WORK, 2, 3)))
    c = series.memory[:BLOCK_SIZE].reshape(ORDER + 1, 3, LANES)
    c[0, :2, 0], c[ORDER - 1, 0, 0], c[ORDER, 1, 0] = (0.3, 0.4), last_but_one, -last
    step = taylor.allowed_step(series, 0.3, 0.2)
    expected = min((0.35 / last) ** (1 / ORDER), (0.35 / last_but_one) ** (1 / (ORDER - 1)))
    expected = expected if last + last_but_one < np.inf else np.nan
    assert step == pytest.approx(expected, rel=1e-3, nan_ok=True)


def stopped_after_a_step(end, first=0.0):
    """Return the outcome of a run that is stopped when its first step is taken."""
    record, stop = systems.stopped_by(1, 3)
    times = np.array([first, first + 1e-9, end])
    return systems.run("taylor", 1.0, times, (1e-6, 1e-6), record=record, stop=stop)[2]


def test_a_step_of_a_ten_milliardth_of_the_run_is_refused():
    h = stopped_after_a_step(10.0).time
    assert 0.01 < h < 1.0
    assert stopped_after_a_step(0.99e10 * h) == (INTERRUPTED, h, 1, 0, ORDER)
    assert stopped_after_a_step(1.01e10 * h) == (STEP_TOO_SMALL, 0.0, 1, 0, ORDER)


def test_no_remnant_of_the_order_of_rounding_is_left():
    """A step may stretch by 1e-9 to reach the end."""
    h = stopped_after_a_step(10.0).time
    ends = (h * (1 - 1e-3), h * (1 + 5e-10), h * (1.0 + 1e-9), h * (1 + 5e-9))
    steps = [systems.run("taylor", 1.0, [0.0, end], (1e-6, 1e-6))[2].steps for end in ends]
    assert steps == [1, 1, 1, 2]


def test_a_run_that_begins_before_zero_is_given_up_where_any_other_is():
    times = np.linspace(0.0, 10.0, 41)
    here, there = (
        systems.run("taylor", -1.0, times - first, (1e-7, 1e-9), start=3.0 + 1.0j)[2]
        for first in (0.0, 10.0)
    )
    assert here.status == there.status == STEP_TOO_SMALL
    assert (there.time + 10.0, there.steps) == pytest.approx((here.time, here.steps), abs=1e-6)
    assert here.evaluations == ORDER * here.steps and here.rejected == 0


def test_a_series_beyond_the_doubles_is_told_from_a_step_too_short():
    _, _, outcome = systems.run("taylor", 1.0, [0.0, 1.0], (1e-6, 1e-6), start=1e200 + 1e200j)
    assert outcome == (NOT_FINITE, 0.0, 1, 0, ORDER)
