"""The error of the expansion: how it is sampled, its orders, and pendula that are lost."""

from math import pi

import numpy as np
import pytest
from latticode.simulation.simulate import simulate
from pendula.problem import PENDULA, Constants, Problem
from pendula.studies.pendula import remainder


def problem(omega=-4.0, pair=(1.0, 0.1), **changes):
    """Return a case on five sites."""
    given = {
        "parameters": {"epsilon": 1.0, "gamma": 1.0, "omega": omega},
        "half_width": 2,
        "boundary": "dirichlet",
        "initial": np.array(pair)[:, None],
        "end_time": 1.0,
        "output_step": 1.0,
        "solver": {"name": "taylor", "rtol": 1e-14, "atol": 1e-14},
    }
    model = {key: changes.pop(key) for key in ("model", "mu", "constants") if key in changes}
    return Problem(**given | changes).changed(**model)


# --- Sampling -------------------------------------------------------------------------------------


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
