"""Periodic breathers: periods by an independent solver, multipliers, laws, and what has none."""

import numpy as np
import pytest
from on_breathers import ABOVE, BELOW, at_twelve, run_from, unfolded
from oracle import slope
from pendula.problem import Constants
from pendula.studies.breathers.multipliers import growth_rate
from pendula.studies.breathers.periodic import (
    FAMILIES,
    find_breather,
    find_soliton,
    highest_wave,
    least_power,
    power,
)
from scipy.integrate import solve_ivp

M = 20
BELOW_AT_4 = Constants(epsilon=1.0, gamma=1.0, omega=-4.0)
"""The detuning of Fig 3."""


def after(breather, quarters, change=0.0, steps=1):
    """Return the run over so many quarters of a period, from the breather with its data changed."""
    end = quarters * breather.quarter
    start = unfolded(breather.data + change)
    return run_from(breather.constants, start, end, end / steps)


@pytest.mark.parametrize("family", FAMILIES)
@pytest.mark.parametrize("constants", [BELOW, ABOVE], ids=["below", "above"])
def test_a_breather_is_periodic_by_the_taylor_method_and_has_its_symmetry(constants, family):
    """P falls from the instant at which all is real to that at which all is imaginary."""
    breather = at_twelve(constants, family, M)
    for quarters, sign in ((2, -1.0), (4, 1.0)):
        assert (
            np.abs(after(breather, quarters).final - sign * unfolded(breather.data)).max() < 1e-11
        )
    both = after(breather, 1, steps=40).l2 ** 2
    assert both[:, 0] == pytest.approx(power(breather.data), rel=1e-12)
    assert both[:, -1].sum() == pytest.approx(least_power(breather), rel=1e-10)
    assert (np.diff(both.sum(axis=0)) < 1e-11 * both.max()).all()
    a, b = breather.data
    if family == "A only":
        assert 0.0 < np.abs(b).max() < 0.3 * np.abs(a).max()
    else:
        assert np.array_equal(a, b if family == "A = B" else -b)


@pytest.mark.parametrize(
    ("constants", "family", "frequency"),
    [
        (BELOW, "A = -B", 3.0),  # in a free interval below the waves
        (BELOW, "A = B", 5.0),  # within them
        (ABOVE, "A only", 8.07),  # it has become A = B
    ],
)
def test_where_a_family_has_no_breather(constants, family, frequency):
    assert find_breather(family, constants, frequency, 40) is None


@pytest.mark.parametrize(("omega", "highest"), [(-4.0, 8.0), (8.0, 8.0), (1.0, 3.0)])
def test_the_highest_linear_wave(omega, highest):
    assert highest_wave(Constants(epsilon=1.0, gamma=1.0, omega=omega)) == highest


@pytest.mark.parametrize("family", FAMILIES)
def test_the_end_of_the_chain_does_not_matter_where_tails_are_longest(family):
    short, long = (find_breather(family, BELOW, 8.5, half_width) for half_width in (24, 40))
    off = np.abs(short.data - long.data[:, :25])
    assert off[:, 0].max() < 1e-12 and off.max() < 1e-6
    assert least_power(short) == pytest.approx(least_power(long), rel=1e-10)


@pytest.mark.parametrize("frequency", [-3.5, -2.0, 1.0])
def test_a_soliton_turns_with_its_frequency_by_the_taylor_method(frequency):
    soliton = find_soliton(BELOW_AT_4, frequency, M)
    a, b = soliton.data
    assert np.array_equal(a, b)
    end = 0.5
    final = run_from(BELOW_AT_4, unfolded(soliton.data), end, end).final
    assert np.abs(final - np.exp(-1j * frequency * end) * unfolded(soliton.data)).max() < 1e-11


def test_the_power_of_a_soliton_vanishes_towards_the_waves_as_that_of_the_continuum():
    """There phi is the soliton 2 sqrt(k) / cosh(sqrt(k) n), k = lambda - Omega: P = 16 sqrt(k)."""
    for k, accuracy in ((0.2, 0.03), (0.1, 0.015)):
        computed = power(find_soliton(BELOW_AT_4, BELOW_AT_4.omega + k, 40).data).sum()
        assert computed == pytest.approx(16.0 * np.sqrt(k), rel=accuracy)


def test_a_difference_of_a_and_b_grows_on_a_soliton_at_the_rate_of_its_multiplier():
    """SciPy's DOP853 follows a small one on plain NumPy for a while, then for two periods."""
    soliton = find_soliton(BELOW_AT_4, -2.0, M)
    start = unfolded(soliton.data).astype(complex)
    start[0, M] += 1e-9
    period = np.pi  # 2 pi / 2
    times = np.array([0.0, period, 2.0 * period])
    run = solve_ivp(
        lambda _, y: slope(y.reshape(2, -1), (1.0, 1.0, -4.0), "dirichlet").ravel(),
        (0.0, times[-1]),
        start.ravel(),
        "DOP853",
        times,
        rtol=1e-13,
        atol=1e-14,
    )
    a, b = run.y.reshape(2, -1, 3)
    difference = np.sqrt((np.abs(a - b) ** 2).sum(axis=0))
    rate = np.log(difference[2] / difference[1]) / period
    assert growth_rate(soliton) == pytest.approx(rate, rel=0.01)
