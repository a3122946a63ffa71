"""The speed of linear spreading, against the matrix of each wave and exact cases."""

import hashlib

import numpy as np
import pytest
from pendula.studies.unbounded.front import group_velocity, growth_rate, is_unstable, linear_front
from problems import constants_of


def constants(omega):
    return constants_of((1.0, 1.0, omega))


def of_wave(k, numbers):
    """Return s of a wave of D = A - B: x' = -(kappa + 2 gamma) y and y' = (kappa - 2 gamma) x."""
    epsilon, gamma, omega = numbers
    kappa = 2.0 * epsilon - 2.0 * epsilon * np.cos(k) - omega
    matrix = np.array([[0.0, -kappa - 2.0 * gamma], [kappa - 2.0 * gamma, 0.0]])
    return max(np.linalg.eigvals(matrix), key=lambda s: (s.real, s.imag))


@pytest.mark.parametrize("numbers", [(0.8, 0.3, -1.5), (1.3, 0.6, 9.0), (0.7, 0.9, 0.4)])
def test_waves_grow_and_move_as_the_matrix_of_each_says(numbers):
    constants, step = constants_of(numbers), 1e-5
    for k in (0.4, 1.3, 2.9):
        assert growth_rate(k, 0.0, constants) == pytest.approx(of_wave(k, numbers).real, abs=1e-12)
        ahead, behind = of_wave(k + step, numbers), of_wave(k - step, numbers)
        if ahead.imag:
            speed = abs(ahead.imag - behind.imag) / (2.0 * step)
            assert group_velocity(k, constants) == pytest.approx(speed, rel=1e-6)


@pytest.mark.parametrize("omega", [-1.95, -1.75, 5.9])
def test_near_the_edge_of_the_band_two_waves_are_equally_fast_at_the_least_speed(omega):
    """No saddle point is the least there, over decays, of the largest speed over waves."""
    front, waves = linear_front(constants(omega)), np.linspace(0.0, np.pi, 8001)
    decays = front.decay * np.linspace(0.99, 1.01, 41)
    speeds = [growth_rate(waves, decay, constants(omega)).max() / decay for decay in decays]
    assert front.speed == pytest.approx(min(speeds), rel=2e-5)


@pytest.mark.parametrize("numbers", [(1.0, 1.0, 0.0), (0.5, 0.3, 0.0), (2.0, 0.7, 0.0)])
def test_rest_is_unstable_inside_the_band_and_the_front_is_continuous_at_its_edge(numbers):
    epsilon, gamma, _ = numbers
    low, high = -2.0 * gamma, 4.0 * epsilon + 2.0 * gamma
    for omega, unstable in ((low, 0), (low + 1e-9, 1), (high - 1e-9, 1), (high + 1e-9, 0)):
        assert is_unstable(constants_of((epsilon, gamma, omega))) == bool(unstable)
    inside, outside = (
        linear_front(constants_of((epsilon, gamma, low + step))) for step in (1e-3, -1e-3)
    )
    assert inside.speed == pytest.approx(outside.speed, abs=5e-3)
    assert outside.decay == outside.delay == 0.0 < inside.decay


@pytest.mark.parametrize(
    "numbers", [*((1.0, 1.0, omega) for omega in (-1.5, 0.0, 2.0, 5.5)), (0.7, 0.9, 0.4)]
)
def test_the_curvature_at_the_saddle_is_that_of_the_rate(numbers):
    epsilon, gamma, omega = numbers
    front, step = linear_front(constants_of(numbers)), 1e-3
    k = front.wave_number + 1j * front.decay

    def branch(k):
        s = np.sqrt(4.0 * gamma**2 - (2.0 * epsilon * (1.0 - np.cos(k)) - omega) ** 2 + 0j)
        return s if s.real > 0 else -s

    second = (branch(k + step) - 2.0 * branch(k) + branch(k - step)) / step**2
    assert front.diffusion == pytest.approx(-0.5 * second, rel=1e-4)
    lost = 3.0 * np.sqrt(np.pi) * (front.diffusion**-0.5).real / front.decay**2
    assert (front.delay, front.rest) == pytest.approx((1.5 / front.decay, lost))


HASH = "ba346a3eb4b76d4a"
"""Of the bits that every machine must get of the fronts below."""


def test_the_bits_of_predicted_fronts_are_those_of_every_machine():
    fronts = [linear_front(constants(omega)) for omega in (-3.0, -1.5, 0.0, 2.0, 5.5)]
    told = [(*front[:3], front.diffusion.real, front.diffusion.imag) for front in fronts]
    assert hashlib.sha256(np.array(told).tobytes()).hexdigest()[:16] == HASH
