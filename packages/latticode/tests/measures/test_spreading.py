"""Lines through l2^2, exponents with an offset, and the limits of both."""

import numpy as np
import pytest
from latticode.measures.spreading import exponent_with_offset, fit_exponent, fit_line

TAU = np.linspace(0.0, 400.0, 1601)
START = 50.0


def remembering(members, memory=40, seed=5):
    """Return noise (member, tau) of unit size that remembers itself for ten units of tau."""
    white = np.random.default_rng(seed).normal(size=(members, TAU.size + memory - 1))
    window = np.ones(memory) / np.sqrt(memory)
    return np.array([np.convolve(series, window, "valid") for series in white])


@pytest.mark.parametrize("q", [-0.5, 0.1, 0.25, 0.5, 0.9])
def test_an_exponent_is_found_whatever_the_offset(q):
    tau = TAU[TAU >= START]
    for offset in (-3.0, 0.0, 70.0):
        assert exponent_with_offset(tau, 5.0 * tau ** (2.0 * q) + offset) == pytest.approx(q, 1e-6)


@pytest.mark.parametrize("members", [1, 4])
def test_limits_hold_the_true_slope_in_as_many_draws_as_they_say(members):
    """Noise that remembers itself would fool an error that takes all points as independent."""
    held, draws = 0, 200
    for draw in range(draws):
        values = 3.0 * TAU + 7.0 + 40.0 * remembering(members, seed=draw)
        slope = fit_line(TAU, values, START).slope
        held += slope.low < 3.0 < slope.high
    assert 0.87 < held / draws < 0.995


def test_the_relative_growth_of_a_line():
    computed = fit_line(TAU, np.array([TAU, TAU]), 100.0)
    assert computed.relative.value == pytest.approx(300.0 / 250.0)
    assert computed.offset == pytest.approx(0.0, abs=1e-9)
    unchanged = fit_line(TAU, 5.0 + 0.01 * remembering(4), 100.0).relative
    assert unchanged.low < 0.0 < unchanged.high < 0.01


def test_limits_of_a_single_curve_are_those_of_ten_stretches_of_its_residuals():
    x = TAU[TAU >= START]
    y = 3.0 * TAU + 7.0 + 40.0 * remembering(1)[0]
    computed = fit_line(TAU, y[None], START).slope
    slope, offset = np.polyfit(x, y[TAU >= START], 1)
    off = x - x.mean()
    components = np.array_split(off * (y[TAU >= START] - slope * x - offset), 10)
    variance = sum(component.sum() ** 2 for component in components) * 10 / 8
    half = 2.306 * np.sqrt(variance) / np.sum(off**2)  # Student's t of eight degrees of freedom
    assert tuple(computed) == pytest.approx((slope, slope - half, slope + half), rel=1e-5)


def test_a_line_starts_at_its_first_time_and_another_confidence_has_other_limits():
    values = np.array([np.where(TAU < START, 0.0, slope * TAU) for slope in (2.0, 4.0)])
    assert fit_line(TAU, values, START).slope.value == pytest.approx(3.0, abs=1e-12)
    assert fit_line(TAU, values, START - 0.25).slope.value > 3.0
    assert fit_line(TAU, values, START, 0.5).slope.half == pytest.approx(1.0)  # t = 1 at 50 %


def test_no_exponent_above_three_or_below_minus_one_is_found():
    tau = TAU[TAU >= START]
    assert exponent_with_offset(tau, (tau / 400.0) ** 8.0) == 3.0
    assert -1.0 <= exponent_with_offset(tau, (tau / 400.0) ** -4.0) < -0.9


def test_an_exponent_is_that_from_its_first_time_on_with_that_time_itself():
    for spoilt, right in ((TAU < START, True), (TAU <= START, False)):
        l2 = np.where(spoilt, 1.0, np.sqrt(100.0 * TAU + 5000.0))
        assert (abs(fit_exponent(TAU, l2[None], START).value - 0.5) < 1e-6) == right


KINKED = np.interp(TAU, [50.0, 120.0, 190.0, 260.0, 330.0, 400.0], [4, 1, 5, 5, 2, 8])


@pytest.mark.parametrize("squares", [100.0 * TAU + 3000.0 * np.sin(TAU / 40.0), 1e3 * KINKED])
def test_the_exponent_of_a_curve_that_is_no_law_is_that_of_least_squares(squares):
    """The second one has two minima, and a coarse search takes the wrong one."""
    tau, squares = TAU[TAU >= START], squares[TAU >= START]

    def left(q):
        columns = np.stack([(tau / 400.0) ** (2.0 * q), np.ones_like(tau)], axis=1)
        return np.linalg.lstsq(columns, squares)[1][0]

    computed = exponent_with_offset(tau, squares)
    assert left(computed) < min(left(computed - 1e-4), left(computed + 1e-4))
    assert all(left(computed) < left(q) for q in np.arange(-0.975, 3.0, 0.05) if q)


def test_a_curve_that_stays_zero_has_some_exponent_and_no_quotient_of_zeros():
    with np.errstate(all="raise"):
        assert -1.0 <= exponent_with_offset(TAU[1:], np.zeros(1600)) <= 3.0
