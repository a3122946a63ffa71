"""splitting: its order, its symmetry in time, and flows that are exact."""

import re
from math import factorial

import numpy as np
import pytest
import systems
from on_chains import WHOLE, data_of, integrate, numbers_of
from oracle import laplacian, random_chain, slope
from pendula.compiled import kernel, uncached
from pendula.integrators import DONE, INTERRUPTED, splitting
from pendula.models.amplitudes import Chain, linear_radius, linear_rates, nonlinear_flow
from pendula.simulation.lattice import choose_ends, pack, unpack
from pendula.simulation.simulate import IntegrationError
from scipy.linalg import expm

NUMBERS = (0.7, 1.3, -4.0)


def run(z, step, end=1.0, outputs=1, numbers=NUMBERS):
    solver = {"name": "splitting", "step": step}
    return integrate(z, solver, end, outputs, numbers=numbers)


def test_the_parts_of_a_step_add_up_and_read_the_same_backwards():
    assert 2 * splitting.LINEAR_PARTS[0] + splitting.LINEAR_PARTS[1:].sum() == pytest.approx(
        1.0, abs=1e-15
    )
    assert splitting.NONLINEAR_PARTS.sum() == pytest.approx(1.0, abs=1e-15)
    np.testing.assert_array_equal(splitting.NONLINEAR_PARTS, splitting.NONLINEAR_PARTS[::-1])
    np.testing.assert_array_equal(splitting.LINEAR_PARTS[1:], splitting.LINEAR_PARTS[:0:-1])


def test_the_error_falls_with_the_sixth_power_of_the_step():
    z = random_chain(3)
    tight = {"name": "dop853", "rtol": 1e-14, "atol": 1e-14}
    exact = integrate(z, tight, numbers=NUMBERS).final
    errors = [np.abs(run(z, 1 / n).final - exact).max() for n in (20, 40, 80)]
    orders = np.log2(np.divide(errors[:-1], errors[1:]))
    assert np.all((orders > 5.7) & (orders < 6.6))


def test_a_step_is_undone_by_the_step_of_the_conjugate():
    z = 2 * random_chain(3)
    there = run(z, 0.1).final  # far from accurate, but symmetric in time
    np.testing.assert_allclose(np.conj(run(np.conj(there), 0.1).final), z, atol=1e-12)


@pytest.mark.parametrize("boundary", ["dirichlet", "free", "periodic"])
@pytest.mark.parametrize("step", [0.01, 1.0])
def test_the_linear_flow_is_exact(boundary, step):
    """Tiny data move by the linear terms alone; in real parts, by a matrix exponential."""
    z = 1e-9 * random_chain(2)
    epsilon, gamma, omega = NUMBERS
    lattice = np.kron(np.eye(2), epsilon * laplacian(5, boundary) + omega * np.eye(5))
    drive = gamma * np.kron([[-1, 1], [1, -1]], np.eye(5))
    # i z' = (lattice) z + (drive) conj(z)
    matrix = np.block(
        [[np.zeros((10, 10)), lattice - drive], [-lattice - drive, np.zeros((10, 10))]]
    )
    parts = expm(matrix) @ np.concatenate([z.ravel().real, z.ravel().imag])
    solver = {"name": "splitting", "step": step}
    final = integrate(z, solver, numbers=NUMBERS, boundary=boundary).final
    np.testing.assert_allclose(final.ravel(), parts[:10] + 1j * parts[10:], atol=1e-22)


def test_the_nonlinear_flow_is_the_exact_one_of_the_cubic_terms():
    z = random_chain(2)
    y = pack(z, WHOLE)
    nonlinear_flow(y, 0.3)
    np.testing.assert_allclose(unpack(y, WHOLE), z * np.exp(-0.15j * np.abs(z) ** 2), rtol=1e-14)


def test_linear_rates_are_the_equations_at_vanishing_data():
    z = random_chain(2)
    chain = Chain(*NUMBERS, *choose_ends("free", WHOLE))
    y = pack(z, WHOLE)
    dy = np.zeros_like(y)
    linear_rates(chain, y, dy)
    expected = slope(1e-9 * z, NUMBERS, "free") / 1e-9
    np.testing.assert_allclose(unpack(dy, WHOLE), expected, rtol=1e-12, atol=1e-12)
    assert np.abs(expected).max() <= linear_radius(chain) * np.abs(z).max()


@pytest.mark.parametrize("x", [1e-3, 0.1, 1.0, 10.0])
def test_terms_left_out_of_the_exponential_do_not_matter(x):
    terms = splitting.count_terms(x)
    kept = np.cumprod(np.concatenate([[1.0], x / np.arange(1.0, terms + 1)])).sum()
    assert kept == pytest.approx(np.exp(x), rel=1e-15)


def test_outputs_inside_a_step_shorten_it():
    z = random_chain(2)
    assert run(z, 0.3, end=1.0, outputs=1).outcome.steps == 4
    assert run(z, 0.3, end=1.0, outputs=5).outcome.steps == 5
    assert run(z, 0.1, end=1.0, outputs=10).outcome.steps == 10


def test_the_energy_of_a_regular_case_errs_but_does_not_drift():
    z = data_of("fig3_small", half_width=8)
    energy = run(z, 0.05, 400.0, 4000, numbers_of("fig3_small")).energy
    error = np.abs(energy - energy[0])
    assert error.max() < 1e-7
    assert error[2000:].max() < 1.5 * error[:2000].max()


@pytest.mark.parametrize("size", [20.0, 1e4])
def test_amplitudes_too_large_for_the_step_are_reported(size):
    with pytest.raises(IntegrationError, match="step is too long"):
        run(size * random_chain(2), 0.1)
    assert run(random_chain(2), 0.1).outcome.status == DONE


def test_a_step_that_becomes_too_long_is_reported_where_it_begins():
    """A run up to the time that is told succeeds, and fails if it takes one step more."""
    z, numbers = data_of("fig4_small", half_width=2), numbers_of("fig4_small")
    with pytest.raises(IntegrationError) as fault:
        run(z, 0.25, 40.0, 20, numbers)
    tau = float(re.search(r"tau = ([\d.]+)", str(fault.value))[1])
    assert 2.0 < tau < 40.0 and tau % 2.0 > 0.0
    assert run(z, 0.25, tau, 1, numbers).outcome.status == DONE
    with pytest.raises(IntegrationError, match="step is too long"):
        run(z, 0.25, tau + 0.25, 1, numbers)


@pytest.mark.parametrize("numbers", [(0.7, 1.3, -4.0), (-0.7, 1.3, 4.0), (0.7, -1.3, -4.0)])
def test_the_bound_of_the_linear_rates_is_reached_by_the_shortest_wave(numbers):
    """On a ring A_n = -B_n = (-1)^n, times i where the drive would not add up otherwise."""
    wave = (1.0 if numbers[1] * numbers[2] < 0 else 1j) * (-1.0) ** np.arange(4)
    chain = Chain(*numbers, *choose_ends("periodic", WHOLE))
    y = pack(np.array([wave, -wave]), WHOLE)
    dy = np.zeros_like(y)
    linear_rates(chain, y, dy)
    assert np.abs(unpack(dy, WHOLE)).max() == pytest.approx(linear_radius(chain), rel=1e-15)


@pytest.mark.parametrize("back", [1.0, -1.0])
def test_a_nonlinear_flow_is_refused_from_a_turn_by_one_radian_on(back):
    """An amplitude with |A|^2 = 2 turns by h. One such site is enough, wherever it stands."""
    for place in ((0, 0), (1, 2)):
        z = np.zeros((2, 3), complex)
        z[place] = 1.0 - 1.0j
        for h, resolved in ((0.999, True), (1.0, False), (1.5, False)):
            assert nonlinear_flow(pack(z, WHOLE), back * h) == resolved


def test_spans_that_round_above_a_whole_number_of_steps_take_no_further_one():
    """In doubles 1.1 / 0.1 is above 11, and 0.3 / 0.1 below 3."""
    z = 0.1 * random_chain(1)
    assert [run(z, 0.1, end=end).outcome.steps for end in (0.3, 1.1)] == [3, 11]


@pytest.mark.parametrize("x", [1e-3, 0.1, 1.0, 10.0])
def test_terms_are_counted_up_to_the_first_that_does_not_matter(x):
    n = splitting.count_terms(x)
    assert x**n / factorial(n) <= 1e-17 < x ** (n - 1) / factorial(n - 1)


@uncached
def spin(calls, y, dy):
    calls[0] += 1
    dy[0, 1] = y[1, 1]
    dy[1, 1] = -y[0, 1]


@uncached
def unit_radius(calls):
    return 1.0


@uncached
def stand_still(y, h):
    return True


solve_spin = splitting.build(spin, unit_radius, stand_still, systems.keep)


@kernel
def run_spin(calls, y, times, controls, work, record, stop):
    return solve_spin(calls, y, times, controls, work, record, stop)


def spun(times, step, calls, stop):
    y, work, record = np.zeros((2, 3)), np.zeros((2, 2, 3)), np.zeros((2, len(times)))
    y[0, 1] = 1.0
    outcome = run_spin(calls, y, np.array(times), (step,), work, record, stop)
    return complex(y[0, 1], y[1, 1]), outcome


def test_the_evaluations_are_those_that_were_made():
    """Three steps and a single one: the last linear flow of a step joins the first of the next."""
    calls, first, inner = np.zeros(1, int), *np.split(np.abs(splitting.LINEAR_PARTS), [1])
    final, outcome = spun([0.0, 0.3, 0.4], 0.1, calls, np.zeros(1, np.bool_))
    flows = [*inner] * 4 + [*first] * 4 + [2.0 * first[0]] * 2
    expected = sum(splitting.count_terms(0.1 * part) for part in flows)
    assert outcome == (DONE, 0.4, 4, 0, expected)
    assert calls[0] == expected
    assert final == pytest.approx(np.exp(-0.4j), rel=1e-14)


def test_a_run_that_is_stopped_says_how_far_it_came():
    calls = np.zeros(1, int)
    stop = calls.view(np.bool_)[1:2]  # raised by the call number 256
    _, outcome = spun([0.0, 0.05, 10.0], 0.05, calls, stop)
    assert outcome.status == INTERRUPTED and outcome.rejected == 0
    assert outcome.steps > 1
    assert outcome.time == pytest.approx(0.05 * outcome.steps, rel=1e-12)


def test_scaled_slopes_are_added_at_sites_alone():
    slope_, term, y = np.full((3, 2, 4), 2.0)
    splitting.add_scaled(slope_, 0.25, term, y)
    np.testing.assert_array_equal(term, [[2.0, 0.5, 0.5, 2.0]] * 2)
    np.testing.assert_array_equal(y, [[2.0, 2.5, 2.5, 2.0]] * 2)
