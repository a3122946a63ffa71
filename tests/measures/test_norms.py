"""What is read off one run: P, drift, and the margin to the bound (19)."""

import numpy as np
import pytest
import xarray as xr
from pendula.measures.norms import drift, growth_margin, largest, total_power


def run(a=3.0, b=4.0, count=11):
    norms = np.repeat([[a], [b]], count, axis=1)
    data = {name: (("component", "tau"), norms.copy()) for name in ("linf", "l2")}
    return xr.Dataset(data, {"tau": np.arange(float(count)), "component": ["A", "B"]})


def test_p_is_the_square_of_both_norms_and_the_pair_is_as_large_as_the_larger():
    assert total_power(run()).tolist() == [25.0] * 11
    assert largest(run()).tolist() == [4.0] * 11


def test_the_drift_is_absolute_and_starts_at_zero():
    assert drift([-2.0, -2.5, -1.0]).tolist() == [0.0, 0.5, 1.0]
    assert drift([[1.0, 1.0], [5.0, 4.0]]).max(axis=1).tolist() == [0.0, 1.0]


def test_growth_at_the_bound_has_no_margin_and_beyond_it_less():
    tau = np.linspace(0.0, 2.0, 21)
    for rate, expected in ((4.0, 1.0), (2.0, 0.5), (8.0, 2.0)):
        l2 = np.array([np.exp(0.5 * rate * tau), 0.0 * tau])
        assert growth_margin(tau, l2, 1.0)["steepest"] == pytest.approx(expected)
    assert growth_margin(tau, np.ones((2, 21)), 0.0)["steepest"] == 0.0
    assert growth_margin(tau, np.array([1.0 + tau, 0.0 * tau]), 0.0)["steepest"] == np.inf


def test_the_bound_is_seen_from_both_ends():
    """P may neither grow nor fall faster than e^(4 gamma tau), whichever end is given."""
    tau, gamma = np.linspace(0.0, 2.0, 21), 0.5
    for rate, forth, back in (
        (2.0, 1.0, np.exp(-0.4)), (-2.0, np.exp(-0.4), 1.0), (0.0, np.exp(-0.2), np.exp(-0.2)),
        (4.0, np.exp(4.0), np.exp(-0.6)), (-4.0, np.exp(-0.6), np.exp(4.0)),
    ):  # fmt: skip
        found = growth_margin(tau, np.sqrt(0.5 * np.exp([rate * tau, rate * tau])), gamma)
        assert found["from_start"] == pytest.approx(forth)
        assert found["backwards"] == pytest.approx(back)
        assert found["steepest"] == pytest.approx(abs(rate) / 2.0)
