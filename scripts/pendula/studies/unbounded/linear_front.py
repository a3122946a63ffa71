"""The speed at which small data spread, from the dispersion relation (15) at complex wave numbers.

D = A - B moves as exp(s t + i k n) with s^2 = 4 gamma^2 - kappa(k)^2 and
kappa = 2 epsilon (1 - cos k) - Omega. The solution is an integral over k of entire functions, so
its path may be moved to Im k = decay: |D_n| <= C exp(t max Re s - decay n). The least of
max Re s / decay is the speed of linear spreading; there k is a saddle point, s'(k) = -i v, where
Re s = v decay (van Saarloos, Physics Reports 386 (2003) 29). Where the chain at rest is stable, no
front is pulled, and the fastest group velocity takes its place.
"""

from typing import NamedTuple

import numpy as np

from pendula.problem import Constants


class LinearFront(NamedTuple):
    """Speed v in sites per unit of tau, and the wave exp(-decay n + i q n) at the leading edge."""

    speed: float
    decay: float  # zero where the chain at rest is stable
    wave_number: float

    @property
    def delay(self) -> float:
        """Sites lost per unit of log tau on the way to v: the speed is v - 3 / (2 decay tau)."""
        return 1.5 / self.decay if self.decay else 0.0


def is_unstable(constants: Constants) -> bool:
    """Return whether the infinite chain at rest is unstable (Lemma 1, gamma > 0)."""
    gamma = constants.gamma
    return -2.0 * gamma < constants.omega < 2.0 * gamma + 4.0 * constants.epsilon


def linear_front(constants: Constants) -> LinearFront:
    """Return the front of data of finite extent in the linearised infinite chain."""
    waves, decays = np.linspace(0.0, np.pi, 801), np.geomspace(1e-3, 6.0, 400)
    if not is_unstable(constants):
        speeds = group_velocity(waves[1:-1], constants)
        best = int(np.argmax(speeds))
        return LinearFront(float(speeds[best]), 0.0, float(waves[1 + best]))
    speed, wave, decay = _least(waves, decays, constants)
    q_span, d_span = waves[1], 0.03 * decay
    for _ in range(10):  # the neighbourhood of the saddle, ever smaller
        box = np.linspace(-1.0, 1.0, 21)
        speed, wave, decay = _least(wave + q_span * box, decay + d_span * box, constants)
        q_span, d_span = 0.3 * q_span, 0.3 * d_span
    return LinearFront(speed, decay, wave)


def growth_rate(k, constants: Constants):
    """Return Re s of the growing branch at complex wave numbers k."""
    kappa = 2.0 * constants.epsilon * (1.0 - np.cos(k)) - constants.omega
    return np.abs(np.sqrt(4.0 * constants.gamma**2 - kappa**2 + 0j).real)


def group_velocity(k, constants: Constants):
    """Return |d omega_2 / dk| of real wave numbers where omega_2 is real and not zero."""
    epsilon, gamma = constants.epsilon, constants.gamma
    kappa = 2.0 * epsilon * (1.0 - np.cos(k)) - constants.omega
    return np.abs(2.0 * epsilon * np.sin(k) * kappa) / np.sqrt(kappa**2 - 4.0 * gamma**2)


def _least(
    waves: np.ndarray, decays: np.ndarray, constants: Constants
) -> tuple[float, float, float]:
    """Return (speed, wave number, decay) of the least over decays of the largest over waves."""
    speeds = growth_rate(waves[:, None] + 1j * decays, constants) / decays
    j = int(np.argmin(speeds.max(axis=0)))
    i = int(np.argmax(speeds[:, j]))
    return float(speeds[i, j]), float(waves[i]), float(decays[j])
