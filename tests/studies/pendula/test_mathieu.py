"""Curves of Mathieu's equation and rates of growth, against SciPy and against 40 digits."""

import numpy as np
import pytest
from hill_series import distance_to_edge, growth_over_period
from pendula.configuration.paper import paper
from pendula.problem import Constants
from pendula.studies.pendula import mathieu
from pendula.studies.pendula.mathieu import (
    band_threshold,
    first_tongue,
    growth,
    second_tongue,
    strings_grow,
    wave_threshold,
)
from scipy.special import mathieu_a, mathieu_b

OFFSETS = np.array([-0.9, -0.5, -0.1, -1e-3, 1e-3, 0.1, 0.5, 1.0, 1.4])


@pytest.mark.parametrize("offset", OFFSETS)
def test_the_first_tongue_has_thirteen_digits(offset):
    assert abs(distance_to_edge(offset, float(first_tongue(offset)), -2)) < 1e-13


@pytest.mark.parametrize("offset", [-0.9, 0.5, 2.0, 2.9])
def test_the_second_tongue_has_thirteen_digits(offset):
    assert abs(distance_to_edge(offset, float(second_tongue(offset)), 2)) < 1e-13


def test_curves_are_those_of_scipy():
    above, below = OFFSETS[OFFSETS > 0], OFFSETS[OFFSETS < 0]
    assert mathieu_a(1, first_tongue(above)) - 1 == pytest.approx(above, rel=1e-12)
    assert mathieu_b(1, first_tongue(below)) - 1 == pytest.approx(below, rel=1e-12)
    assert mathieu_b(2, second_tongue(OFFSETS)) - 1 == pytest.approx(OFFSETS, rel=1e-11)


def test_what_the_first_tongue_does_not_reach_is_infinite():
    highest = mathieu_a(1, np.linspace(0.0, mathieu.BEYOND, 4001)).max() - 1.0
    assert np.isfinite(first_tongue(highest - 1e-3))
    assert first_tongue(highest + 1e-3) == np.inf
    assert wave_threshold(highest + 1e-3) == second_tongue(highest + 1e-3)


@pytest.mark.parametrize("of", [first_tongue, second_tongue, lambda offset: growth(offset, 1.1)])
def test_deeper_fractions_change_no_bit(of, monkeypatch):
    found = of(OFFSETS)
    monkeypatch.setattr(mathieu, "DEPTH", 2 * mathieu.DEPTH)
    assert np.array_equal(of(OFFSETS), found)


def test_growth_is_that_of_the_monodromy():
    at = (-0.1, 0.3), (0.0, 1e-3), (0.02, 0.02006), (0.5, 1.0), (0.56, 1.1), (1.2, 3.0), (-0.5, 4.0)
    for offset, q in at:
        exact = growth_over_period(offset, q) / np.pi
        assert float(growth(offset, q)) == pytest.approx(exact, rel=1e-12)


def test_growth_starts_at_the_threshold():
    q = first_tongue(OFFSETS)
    assert np.all(growth(OFFSETS, q * (1 - 1e-9)) == 0.0)
    assert np.all(growth(OFFSETS, q * (1 + 1e-9)) > 0.0)


def test_a_band_is_as_stable_as_its_weakest_wave():
    rng = np.random.default_rng(5)
    for _ in range(30):
        low, high = np.sort(rng.uniform(-0.9, 2.9, 2))
        within = wave_threshold(np.linspace(low, high, 400))
        assert band_threshold(low, high) <= within.min()
        edges = wave_threshold(np.array([low, high])).min() if low > 0 or high < 0 else 0.0
        assert band_threshold(low, high) == pytest.approx(edges, rel=1e-14)


def test_a_band_at_a_resonance_bears_no_drive():
    found = band_threshold(np.array([-0.2, 2.5, 3.5, 0.5]), np.array([0.1, 3.1, 3.9, 2.0]))
    assert found[:2].tolist() == [0.0, 0.0] and np.isnan(found[2]) and found[3] > 0.0


def test_only_a_drive_that_beats_the_strings_loses_pendula():
    """By Mathieu's equation: a <= 4 epsilon mu^2 / omega^2 is stable up to q = b_1(a)."""
    of_paper = [Constants.of(one) for one in paper()["cases"].values()]
    assert not any(strings_grow(one, mu) for one in of_paper for mu in (0.05, 0.15, 0.3))
    plain = {"epsilon": 1.0, "gamma": 1.0, "omega": -4.0}
    for changes in ({"gamma": 3.0}, {"epsilon": 2.0}, {"epsilon": -0.1, "gamma": 0.0}):
        assert strings_grow(Constants(**plain | changes), 0.3)
    free = Constants(epsilon=0.0, gamma=1.0, omega=0.0)
    assert not strings_grow(free, np.sqrt(0.9 / 2.0)) and strings_grow(free, np.sqrt(0.91 / 2.0))
