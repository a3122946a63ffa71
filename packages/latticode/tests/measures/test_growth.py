"""Exponents of growth laws and of tangent vectors, with their errors; and what is chaotic."""

from time import perf_counter

import numpy as np
import pytest
from latticode.measures.growth import (
    amplification,
    is_chaotic,
    mean_rate,
    mean_rate_error,
    predict,
)


def test_rates_are_slopes_of_the_logarithm_and_their_errors_those_of_its_parts():
    tau = np.arange(0.0, 81.0)
    wiggle = np.where(tau // 10 % 2 == 0, 1.0, -1.0)
    log_growth = 0.5 * tau + np.concatenate([[0.0], np.cumsum(0.1 * wiggle[:-1])])
    assert mean_rate(tau, log_growth[None], 0.0) == pytest.approx([0.5])
    assert mean_rate_error(tau, log_growth[None], 0.0) == pytest.approx([0.1 / np.sqrt(7)])


def test_what_grows_with_the_solution_or_within_its_error_is_no_chaos():
    tau = np.arange(0.0, 60.25, 0.25)
    assert not is_chaotic(tau, 2.0 * tau, np.exp(2.0 * tau))
    jumps = np.where(tau < 50.0, 0.0, 6.0)  # all of the growth lies in one part
    assert not is_chaotic(tau, jumps, np.ones_like(tau))
    assert not is_chaotic(tau, 2.0 * tau, np.zeros_like(tau))


def test_a_growth_by_a_hundred_over_half_of_the_run_is_the_limit():
    tau = np.arange(0.0, 80.25, 0.25)
    for factor, chaotic in ((99.0, False), (101.0, True)):
        growth = np.log(factor) / 40.0 * tau
        assert is_chaotic(tau, growth, np.ones_like(tau)) == chaotic
        assert is_chaotic(tau, growth + np.sin(tau), np.exp(np.sin(tau))) == chaotic


def test_a_growth_counts_after_three_standard_errors_are_taken_off():
    """In parts of five units by turns it grows by 0.3 more and less a unit of time."""
    tau = np.arange(0.0, 81.0)
    wiggle = np.where(tau // 5 % 2 == 0, 0.3, -0.3)
    errors = 3.0 * 0.3 / np.sqrt(7.0)
    for factor, chaotic in ((99.0, False), (101.0, True)):
        rate = np.log(factor) / 40.0 + errors
        growth = rate * tau + np.concatenate([[0.0], np.cumsum(wiggle[:-1])])
        assert is_chaotic(tau, growth, np.ones_like(tau)) == chaotic


# --- Divergence -----------------------------------------------------------------------------------

TIMES = np.linspace(0.0, 20.0, 1001)


@pytest.mark.parametrize(
    ("rate", "size", "expected"),
    [
        (1.5, np.ones_like(TIMES), np.log(np.expm1(1.5 * TIMES[5:]) / 1.5)),
        (1.5, np.exp(1.5 * TIMES), np.log(TIMES[5:])),  # the solution grows like its errors
    ],
)
def test_errors_made_all_along_grow_to_their_integral(rate, size, expected):
    log = amplification(TIMES, rate * TIMES, size)
    np.testing.assert_allclose(log[5:], expected, atol=0.02)


def test_the_sum_of_errors_takes_a_time_that_grows_with_the_run_and_no_faster():
    """The sum over all earlier errors, written out, beside the one that is carried along."""
    rng = np.random.default_rng(1)
    tau, growth = np.linspace(0, 500, 2001), np.cumsum(rng.normal(0.02, 0.1, 2001))
    size = 1 + rng.random(2001)
    built = np.log(size[1:] * np.diff(tau)) - growth[1:]
    sums = np.log([np.exp(built[: i + 1] - built[: i + 1].max()).sum() for i in range(2000)])
    sums += np.maximum.accumulate(built) + growth[1:] - np.log(size[1:])
    np.testing.assert_allclose(amplification(tau, growth, size)[1:], sums, rtol=0, atol=1e-13)
    began = perf_counter()
    amplification(np.linspace(0, 8000, 32001), np.zeros(32001), np.ones(32001))
    assert perf_counter() - began < 2.0  # 60 s where each sum begins anew


def test_a_thousandth_of_the_error_diverges_later_by_its_logarithm_over_the_rate():
    log = amplification(TIMES, 2.0 * TIMES, np.ones_like(TIMES))
    early, late = (predict(TIMES, log, error) for error in (1e-6, 1e-9))
    assert late - early == pytest.approx(np.log(1e3) / 2.0, abs=0.02)
    assert predict(TIMES, np.zeros_like(TIMES), 1e-6) == np.inf
