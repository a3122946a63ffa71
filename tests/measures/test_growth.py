"""Exponents of growth laws and of tangent vectors, with their errors; and what is chaotic."""

import numpy as np
import pytest
from pendula.measures.growth import (
    is_chaotic,
    local_exponents,
    mean_rate,
    mean_rate_error,
)


def made_up(exponent, members=6, noise=0.05):
    """Return tau to an exponent, with noise that keeps its memory for ten units of tau."""
    rng = np.random.default_rng(5)
    tau = np.linspace(0.0, 400.0, 1601)
    white = rng.normal(size=(members, tau.size))
    waves = np.array([np.convolve(series, np.ones(40) / 6.3, "same") for series in white])
    return tau, 7.0 * np.maximum(tau, 0.1) ** exponent * np.exp(noise * waves)


@pytest.mark.parametrize("exponent", [0.0, 0.5, 1.0])
def test_the_local_exponents_of_a_made_up_series_are_found_within_their_limits(exponent):
    _, found = local_exponents(*made_up(exponent), 2)
    assert all(limits.half < 0.1 for limits in found)
    assert all(limits.low - 0.03 < exponent < limits.high + 0.03 for limits in found)


def test_local_exponents_see_where_the_law_changes():
    tau, _ = made_up(0.5)
    values = np.where(tau < 100.0, tau, 10.0 * np.sqrt(tau)).clip(0.1)[None]
    middles, found = local_exponents(tau, values, 3)
    np.testing.assert_allclose(middles, [70.7, 141.4, 282.8], rtol=1e-3)
    np.testing.assert_allclose([p.value for p in found], [1.0, 0.5, 0.5], atol=1e-6)


def test_rates_are_slopes_of_the_logarithm_and_their_errors_those_of_its_parts():
    tau = np.arange(0.0, 81.0)
    wiggle = np.where(tau // 10 % 2 == 0, 1.0, -1.0)
    log_growth = 0.5 * tau + np.concatenate([[0.0], np.cumsum(0.1 * wiggle[:-1])])
    assert mean_rate(tau, log_growth[None], 0.0) == pytest.approx([0.5])
    assert mean_rate_error(tau, log_growth[None], 0.0) == pytest.approx([0.1 / np.sqrt(7)])


@pytest.mark.parametrize("end", [30.0, 200.0])
def test_exponential_growth_is_chaos_and_powers_of_time_are_none(end):
    tau = np.arange(0.0, end + 0.25, 0.25)
    still = np.ones_like(tau)
    assert is_chaotic(tau, 1.7 * tau, still)
    for exponent in (0.0, 1.0, 2.0, 6.0):
        assert not is_chaotic(tau, exponent * np.log1p(tau), still)


def test_what_grows_with_the_solution_or_within_its_error_is_no_chaos():
    tau = np.arange(0.0, 60.25, 0.25)
    assert not is_chaotic(tau, 2.0 * tau, np.exp(2.0 * tau))
    jumps = np.where(tau < 50.0, 0.0, 6.0)  # all of the growth lies in one part
    assert not is_chaotic(tau, jumps, np.ones_like(tau))
    assert not is_chaotic(tau, 2.0 * tau, np.zeros_like(tau))
