"""Lemma 1's thresholds, the windows of finite chains, and the charts' numbers."""

import numpy as np
import pytest
from pendula.models.linear_chain import (
    finite_rate,
    finite_threshold,
    gamma_0,
    growth_rate,
    infinite_rate,
)
from pendula.studies.theory.stability_chart import stable_windows, widest_gamma


@pytest.mark.parametrize(("omega", "expected"), [(8, 2), (-4, 2), (0, 0), (2, 0), (4, 0), (5, 0.5)])
def test_gamma_0(omega, expected):
    assert gamma_0(omega, 1.0) == expected


def test_infinite_rate_is_the_largest_over_all_waves():
    kappa = 4.0 * np.sin(np.linspace(0.0, np.pi, 4001) / 2) ** 2
    for omega in (-4.0, -1.0, 0.5, 3.0, 8.0):
        for gamma in (0.3, 1.0, 2.5):
            largest = growth_rate(kappa - omega, gamma).max()
            assert infinite_rate(omega, gamma, 1.0) == pytest.approx(largest, abs=1e-5)


def test_finite_threshold_lies_above_and_tends_to_the_infinite_one():
    omegas = np.linspace(-6.0, 10.0, 33)
    gaps = [finite_threshold(omegas, 1.0, n, "dirichlet") - gamma_0(omegas, 1.0) for n in (11, 201)]
    assert (gaps[0] >= -1e-14).all() and (gaps[1] >= -1e-14).all()
    assert gaps[1].max() < 0.02 < gaps[0].max()


@pytest.mark.parametrize("boundary", ["dirichlet", "free", "periodic"])
def test_windows_are_exactly_where_the_finite_chain_is_stable(boundary):
    windows = stable_windows(0.03, 1.0, 9, boundary)
    omegas = np.linspace(0.0, 4.0, 4003)[1:-1]
    inside = ((omegas[:, None] > windows[:, 0]) & (omegas[:, None] < windows[:, 1])).any(axis=1)
    np.testing.assert_array_equal(inside, finite_rate(omegas, 0.03, 1.0, 9, boundary) == 0.0)


def test_no_window_is_left_above_the_widest_gamma():
    widest = widest_gamma(1.0, 61, "dirichlet")
    assert len(stable_windows(0.999 * widest, 1.0, 61, "dirichlet")) > 0
    assert len(stable_windows(1.001 * widest, 1.0, 61, "dirichlet")) == 0


def test_growth_at_the_threshold_is_linear_for_a_wave_and_a_root_for_data_in_l2(numbers):
    in_l2, in_linf = numbers("threshold", "spreading_exponent").T
    np.testing.assert_allclose(in_l2, 0.5, atol=0.01)
    np.testing.assert_allclose(in_linf, 0.0, atol=0.05)
    assert (numbers("threshold", "finite_gap") > 0).all()


def test_measured_rates_tend_to_the_finite_chains_largest(numbers):
    finite, measured = numbers("chart", "finite_rate"), numbers("chart", "measured")
    assert np.abs(measured - finite)[finite > 0.3].max() < 0.1
