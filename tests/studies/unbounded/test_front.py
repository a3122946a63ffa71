"""The speed of linear spreading, against the matrix of each wave and a saddle point."""

import hashlib

import numpy as np
import pytest
from pendula.studies.unbounded.front import growth_rate, linear_front
from problems import constants_of
from scipy.optimize import minimize_scalar

PAPER = [(1.0, 1.0, omega) for omega in (-1.95, -1.5, 0.0, 2.0, 5.5, 5.9)]
"""At the first and the last of these two waves are equally fast, and there is no saddle point."""


def of_wave(k, numbers):
    """Return s of a wave of D = A - B: x' = -(kappa + 2 gamma) y and y' = (kappa - 2 gamma) x."""
    epsilon, gamma, omega = numbers
    kappa = 2.0 * epsilon - 2.0 * epsilon * np.cos(k) - omega
    matrix = np.array([[0.0, -kappa - 2.0 * gamma], [kappa - 2.0 * gamma, 0.0]])
    return max(np.linalg.eigvals(matrix).real)


@pytest.mark.parametrize("numbers", [(0.8, 0.3, -1.5), (1.3, 0.6, 9.0), (0.7, 0.9, 0.4)])
def test_waves_grow_as_the_matrix_of_each_says(numbers):
    for k in (0.4, 1.3, 2.9, 0.4 + 0.7j):
        computed = growth_rate(k.real, k.imag, constants_of(numbers))
        assert computed == pytest.approx(of_wave(k, numbers), abs=1e-12)


@pytest.mark.parametrize("numbers", [*PAPER, (0.7, 0.9, 0.4)])
def test_the_speed_is_the_least_over_decays_of_the_fastest_wave(numbers):
    constants, waves = constants_of(numbers), np.linspace(0.0, np.pi, 8001)
    front = linear_front(constants)

    def fastest(decay):
        return growth_rate(waves, decay, constants).max() / decay

    bounds = (0.8 * front.decay, 1.25 * front.decay)
    best = minimize_scalar(fastest, bounds=bounds, method="bounded", options={"xatol": 1e-6})
    assert front.speed == pytest.approx(best.fun, rel=2e-5)
    assert front.delay == pytest.approx(1.5 / best.x, rel=5e-3)


@pytest.mark.parametrize("numbers", [(1.0, 1.0, 0.0), (0.5, 0.3, 0.0), (2.0, 0.7, 0.0)])
def test_a_front_is_pulled_inside_the_unstable_band_alone(numbers):
    epsilon, gamma, _ = numbers
    low, high = -2.0 * gamma, 4.0 * epsilon + 2.0 * gamma
    for omega, unstable in ((low, 0), (low + 1e-9, 1), (high - 1e-9, 1), (high + 1e-9, 0)):
        front = linear_front(constants_of((epsilon, gamma, omega)))
        assert bool(front.speed) == bool(front.delay) == bool(unstable)


HASH = "c6f261e07c6ad0f3"
"""Of the bits that every machine must get of the fronts below."""


def test_the_bits_of_predicted_fronts_are_those_of_every_machine():
    fronts = [linear_front(constants_of(numbers)) for numbers in PAPER]
    assert hashlib.sha256(np.array(fronts).tobytes()).hexdigest()[:16] == HASH
