"""Lemma 1's thresholds, the windows of finite chains, and the charts' numbers."""

import numpy as np
import pytest
import xarray as xr
from pendula.models.linear_chain import (
    finite_rate,
    gamma_0,
    growth_rate,
    infinite_rate,
    stable_windows,
    widest_gamma,
)
from pendula.studies.theory.claims_linear import misclassified
from pendula.studies.theory.stability_chart import resolution
from pendula.studies.theory.threshold import exponents


@pytest.mark.parametrize("gamma", [0.3, 1.0, 2.5])
def test_infinite_rate_is_the_largest_over_all_waves(gamma):
    omegas = np.array([-4.0, -1.0, 0.5, 3.0, 8.0])
    kappa = 4.0 * np.sin(np.linspace(0.0, np.pi, 4001) / 2) ** 2
    largest = growth_rate(kappa[:, None] - omegas, gamma).max(axis=0)
    np.testing.assert_allclose(infinite_rate(omegas, gamma, 1.0), largest, atol=1e-5)


@pytest.mark.parametrize("boundary", ["dirichlet", "free", "periodic"])
def test_windows_are_exactly_where_the_finite_chain_is_stable(boundary):
    windows = stable_windows(0.03, 1.0, 9, boundary)
    omegas = np.linspace(0.0, 4.0, 4003)[1:-1]
    inside = ((omegas[:, None] > windows[:, 0]) & (omegas[:, None] < windows[:, 1])).any(axis=1)
    np.testing.assert_array_equal(inside, finite_rate(omegas, 0.03, 1.0, 9, boundary) == 0.0)
    widest = widest_gamma(1.0, 9, boundary)
    assert len(stable_windows(0.999 * widest, 1.0, 9, boundary)) > 0
    assert len(stable_windows(1.001 * widest, 1.0, 9, boundary)) == 0


def test_exponents_of_a_power_beside_a_constant_are_those_of_the_power():
    times, decays = 25.0 * 2.0 ** np.arange(4), np.array([0.6, 2.0])
    growing = np.stack([np.sqrt(times) * (3.0 * times**0.4 - 2.0), times**0.4 + 7.0])
    bounded = np.stack([np.sqrt(times), np.ones(4)])
    found = exponents(np.stack([growing, bounded]), times, decays)
    np.testing.assert_allclose(found, [[0.9, 0.4], [0.5, 0.0]])


def test_cells_are_misclassified_beyond_what_time_resolves():
    """In 60 units of time 6 / 60 = 0.1 is resolved; half of a rate of 0.3 is 0.15."""
    stable, unstable, slow = 0.0, 0.3, 0.2

    def count(measured, finite):
        values = {"measured": ("cell", measured), "finite_rate": ("cell", finite)}
        return misclassified(xr.Dataset(values | {"resolution": resolution(60.0)}))

    for finite, measured, wrong in (
        (stable, 0.1, 0), (stable, 0.11, 1), (stable, 0.16, 1), (unstable, 0.16, 0),
        (unstable, 0.15, 0), (unstable, 0.14, 1), (slow, 0.0, 0), (slow, 0.11, 0),
    ):  # fmt: skip
        assert count([measured], [finite]) == wrong
    assert count([0.2, 0.0, 0.0], [0.0, 0.3, 0.0]) == 2


def test_gamma_0_is_half_of_the_distance_to_the_band():
    """The band of a negative coupling lies below zero."""
    np.testing.assert_array_equal(gamma_0(np.array([-4, 0, 2, 4, 5, 8]), 1.0), [2, 0, 0, 0, 0.5, 2])
    np.testing.assert_array_equal(gamma_0(np.array([-6, -4, -2, 0, 2]), -1.0), [1, 0, 0, 0, 1])
