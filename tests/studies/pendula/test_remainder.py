"""The error of the expansion: how it is sampled, its orders, and pendula that are lost."""

from math import pi

import numpy as np
import pytest
from pendula.problem import PENDULA, Constants, Problem
from pendula.simulation.lattice import WHOLE
from pendula.simulation.simulate import simulate
from pendula.studies.pendula import remainder


def problem(omega=-4.0, pair=(1.0, 0.1), **changes):
    """Return a case on five sites."""
    given = {
        "constants": Constants(epsilon=1.0, gamma=1.0, omega=omega),
        "half_width": 2,
        "boundary": "dirichlet",
        "initial": np.array(pair)[:, None],
        "end_time": 1.0,
        "output_step": 1.0,
        "solver": {"name": "taylor", "rtol": 1e-14, "atol": 1e-14},
    }
    return Problem(**given | changes)


# --- Sampling -------------------------------------------------------------------------------------


@pytest.mark.parametrize("mu", [0.4, 0.1, 0.02])
def test_windows_are_half_periods_that_end_at_multiples_of_the_spacing(mu):
    found = remainder.samples(mu, 8.0, 1.0, 0.05)
    half_period = remainder.PHASES * found.step
    assert half_period == pytest.approx(0.5 * mu**2 * pi / np.sqrt(1.0 + 8.0 * mu**2))
    ends = found.steps[:, -1] * found.step
    assert ends[-1] <= 1.0 < ends[-1] + 1.01 * found.step
    assert found.apart == (half_period < 0.05)
    if not found.apart:  # no time is left out
        assert np.array_equal(np.unique(found.steps), np.arange(found.steps.max() + 1))


def test_a_peak_is_the_top_of_a_parabola():
    before, here, after = (2.0 - (x - 0.3) ** 2 for x in (-1.0, 0.0, 1.0))
    assert remainder.peak(before, here, after) == pytest.approx(2.0, rel=1e-15)
    assert remainder.peak(1.0, 2.0, 3.0) == 2.0 and remainder.peak(1.0, np.inf, np.inf) == np.inf
    assert remainder.peak(1.0, 1.0, 1.0) == 1.0


@pytest.mark.parametrize("mu", [0.1, 0.02])
def test_the_maximum_of_a_swing_whose_size_changes_is_found(mu):
    """The error is (2 + sin 9 tau) times a swing of two harmonics; its sup is known."""
    found = remainder.samples(mu, -4.0, 2.0, 0.0125)
    phase, tau = pi / remainder.PHASES * found.steps, found.steps * found.step
    swing = np.cos(phase + 0.3) + 0.1 * np.cos(3.0 * (phase + 0.3))
    tau, size = remainder.window_maxima(found, np.abs((2.0 + np.sin(9.0 * tau)) * swing))
    largest = remainder.up_to(tau, size, np.array([0.1, 2.0]), 2.0)
    expected = 1.1 * np.array([2.0 + np.sin(0.9), 3.0])
    np.testing.assert_allclose(largest, expected, rtol=2e-3 if found.apart else 0.02)
    assert np.isnan(remainder.up_to(tau, size, np.array([0.1, 2.0]), 0.5)).tolist() == [False, True]


def test_orders_are_those_of_the_limit():
    mus = 0.4 * 0.5 ** np.arange(6)
    errors = (7.0 * mus**3 * (1.0 + mus**2))[:, None]
    (order,), (off,) = remainder.orders(errors)
    assert order == pytest.approx(3.0, abs=1e-5)
    assert abs(order - 3.0) < off < 1e-2
    short = np.where(np.arange(6)[:, None] < 3, errors, np.nan)
    assert remainder.orders(short)[0] == pytest.approx([3.0], abs=0.02)
    assert np.isnan(remainder.orders(np.where(np.arange(6)[:, None] < 2, errors, np.nan))).all()


# --- Runs -----------------------------------------------------------------------------------------


def test_without_the_next_order_the_angles_are_those_of_simulated_amplitudes():
    """Only the site that is wrong in the angles is missed, by as much as it is wrong."""
    mu, phases, taus = 0.1, np.array([0.3, 0.7, 2.0]), np.array([0.0, 0.4, 1.0])
    turned = simulate(problem()).final * np.exp(1j * phases[-1])
    angles = np.tile(2.0 * mu * turned.real, (3, 1, 1))
    pendula = problem(model=PENDULA, mu=mu)
    for wrong in (0.0, 0.01):
        angles[-1, 1, 3] -= wrong
        missed = remainder.misses(
            pendula, False, taus, np.exp(1j * phases), angles, [0.0], [3], WHOLE
        )
        assert missed[0, -1] == pytest.approx(wrong, rel=1e-9, abs=1e-11)


def test_sites_that_nothing_has_reached_change_no_error():
    """At the last site the amplitudes are some rounding errors large, and 1e-13 three sites on."""
    given, ends = problem(half_width=24), np.array([0.25, 0.5])
    assert (
        remainder.reach(given, 0.5) == 15
        and remainder.reach(given.changed(initial=np.ones((2, 5))), 0.5) == 17
    )
    shorter = given.changed(half_width=15)
    sizes = np.abs(simulate(given.changed(end_time=0.5, output_step=0.5)).final).max(axis=0)
    assert 0.0 < sizes[24 + 15] < 1e-15 < sizes[24 + 12]
    whole, part = (remainder.measure(one, {0.1: 0.5}, ends, 0.05) for one in (given, shorter))
    np.testing.assert_array_equal(whole.right, part.right)
    run = remainder.follow(given.changed(model=PENDULA, mu=0.1, end_time=0.5), ends, 0.05, 0.25)
    assert run.right == pytest.approx(part.right[0], rel=1e-12)


@pytest.mark.parametrize("omega", [8.0, -4.0])
def test_the_orders_are_three_and_five(omega):
    run_ends = dict.fromkeys((0.1, 0.05, 0.025), 0.5)
    found = remainder.measure(problem(omega), run_ends, np.array([0.5]), 0.025)
    order, off = remainder.orders(found.right)
    assert order[:, 0] == pytest.approx([3.0, 5.0], abs=0.03) and off.max() < 0.03
    wrong, _ = remainder.orders(found.wrong)
    assert wrong == pytest.approx([1.0, 3.0, 3.0], abs=0.2)


def test_pendula_that_are_driven_beyond_all_bounds_are_lost():
    """At mu = 0.4 large data go over the top, and the string then turns them ever faster."""
    driven = Constants(epsilon=1.0, gamma=0.6, omega=-4.0)  # by more drive they turn faster
    pendula = problem(pair=(5.0, 1.0), model=PENDULA, mu=0.4, end_time=7.0, constants=driven)
    run = remainder.follow(pendula, np.array([0.05, 7.0]), 0.05, 1.0)
    assert np.isinf(run.right[:, -1]).all() and np.isfinite(run.right[:, 0]).all()
    assert np.isfinite(run.wrong).all()
