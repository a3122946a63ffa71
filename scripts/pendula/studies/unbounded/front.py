"""The front of the infinite chain as the linearised equations predict it.

The dispersion relation (15) at complex wave numbers gives the speed at which small data spread.
D = A - B moves as exp(s t + i k n) with s^2 = 4 gamma^2 - kappa(k)^2 and
kappa = 2 epsilon (1 - cos k) - Omega. The solution is an integral over k of entire functions, so
its path may be moved to Im k = decay: |D_n| <= C exp(t max Re s - decay n). The least of
max Re s / decay is the speed of linear spreading; there k is a saddle point, s'(k) = -i v, where
Re s = v decay (van Saarloos, Physics Reports 386 (2003) 29). Where the chain at rest is stable, no
front is pulled, and the fastest group velocity takes its place.

A pulled front comes to v from below, as the saddle point predicts too (Ebert and van
Saarloos, Physica D 146 (2000) 1): its place is v tau - delay log tau - rest tau^(-1/2) and an
offset, with delay = 3 / (2 decay), rest = 3 pi^(1/2) Re(D^(-1/2)) / decay^2 and D = -s''(k) / 2.
"""

from typing import NamedTuple

import numpy as np
from latticode.numerics.elementary import (
    complex_of,
    cos,
    cosh,
    exp,
    log,
    modulus,
    product,
    quotient,
    sin,
    sine_and_cosine,
    sinh,
    square_root,
)

from pendula.problem import Constants

WAVES, DECAYS = np.linspace(0.0, np.pi, 801), exp(np.linspace(log(1e-3), log(6.0), 60))
"""The grid on which the speed of linear spreading is looked for."""

NEWTON = 12
"""Steps of Newton's method to the saddle point."""

PREDICTED_SPEED = "speed of linear spreading, in sites per unit of tau"
DELAY = "sites lost per unit of log tau on the way to that speed"
REST = "sites yet to be lost on that way, times tau^(1/2)"
PIECE_TAU, SITE_OF_FRONT = "slow time at the end of a piece of the run", "site of the front"
"""What these quantities are called in every dataset of this study."""


class LinearFront(NamedTuple):
    """Speed v in sites per unit of tau, and the wave exp(-decay n + i q n) at the leading edge."""

    speed: float
    decay: float  # zero where the chain at rest is stable
    wave_number: float
    diffusion: complex = 0.0
    """-s''(k) / 2 at the saddle point, in sites^2 per unit of tau."""

    @property
    def delay(self) -> float:
        """Sites lost per unit of log tau on the way to v: the speed is v - 3 / (2 decay tau)."""
        return 1.5 / self.decay if self.decay else 0.0

    @property
    def rest(self) -> float:
        """Sites times tau^(1/2): at tau the front has yet to lose `rest` tau^(-1/2) sites."""
        if not self.decay:
            return 0.0
        across = quotient(1.0, square_root(self.diffusion)).real
        return float(3.0 * np.sqrt(np.pi) * across / (self.decay * self.decay))


def is_unstable(constants: Constants) -> bool:
    """Return whether the infinite chain at rest is unstable (Lemma 1, gamma > 0)."""
    gamma = constants.gamma
    return -2.0 * gamma < constants.omega < 2.0 * gamma + 4.0 * constants.epsilon


def linear_front(constants: Constants) -> LinearFront:
    """Return the front of data of finite extent in the linearised infinite chain."""
    if not is_unstable(constants):
        speeds = group_velocity(WAVES[1:-1], constants)
        best = int(np.argmax(speeds))
        return LinearFront(float(speeds[best]), 0.0, float(WAVES[1 + best]))
    wave, decay = _least(WAVES[::8], DECAYS, constants)
    wave, decay = _saddle(wave, decay, constants) or _corner(decay, constants)
    s, _, curvature = _growing_branch(wave, decay, constants)
    return LinearFront(float(s.real / decay), decay, wave, complex(-0.5 * curvature))


def _saddle(wave: float, decay: float, constants: Constants) -> tuple[float, float] | None:
    """Return the saddle point near a point of the grid, by Newton's method; None if none is near.

    The speed Re s / decay does not change to first order there, so that s'' is all of the Jacobian.
    """
    nearest = decay
    for _ in range(NEWTON):
        s, slope, curvature = _growing_branch(wave, decay, constants)
        step = quotient(slope + 1j * (s.real / decay), curvature)
        wave, decay = wave - float(step.real), decay - float(step.imag)
        if not 0.7 * nearest < decay < 1.4 * nearest:
            return None
    s = _growing_branch(wave, decay, constants)[0]
    fastest = growth_rate(WAVES, decay, constants).max()
    return (wave, decay) if modulus(step) < 1e-8 and fastest <= s.real * (1.0 + 1e-9) else None


def _corner(decay: float, constants: Constants) -> tuple[float, float]:
    """Return where the least speed near `decay` is that of two waves at once, which is no saddle.

    Weakly unstable chains are so. Ever finer grids in the decay come close to the corner.
    """
    waves, span = np.linspace(0.0, np.pi, 6401), 0.2 * decay
    for _ in range(6):
        wave, decay = _least(waves, decay + span * np.linspace(-1.0, 1.0, 9), constants)
        span *= 0.3
    return wave, decay


def _growing_branch(wave: float, decay: float, constants: Constants) -> tuple[complex, ...]:
    """Return s, s'(k) and s''(k) of the growing branch, from s^2 = 4 gamma^2 - kappa^2."""
    epsilon, gamma, omega = constants
    (s, c), (along, across) = sine_and_cosine(wave), (cosh(decay), sinh(decay))
    cosine, sine = complex_of(c * along, -s * across), complex_of(s * along, c * across)
    kappa = 2.0 * epsilon * (1.0 - cosine) - omega
    of_kappa, curvature = 2.0 * epsilon * sine, 2.0 * epsilon * cosine
    s = square_root(4.0 * gamma * gamma - product(kappa, kappa))
    slope = -quotient(product(kappa, of_kappa), s)
    twice = product(of_kappa, of_kappa) + product(kappa, curvature) + product(slope, slope)
    return s, slope, -quotient(twice, s)


def growth_rate(wave, decay, constants: Constants):
    """Return Re s of the growing branch at the complex wave numbers wave + i decay."""
    epsilon, gamma, omega = constants
    s, c = sine_and_cosine(wave)
    kappa = 2.0 * epsilon * (1.0 - c * cosh(decay)) - omega
    across = 2.0 * epsilon * s * sinh(decay)  # Im kappa
    along = 4.0 * gamma * gamma - kappa * kappa + across * across
    return square_root(complex_of(along, -2.0 * kappa * across)).real


def group_velocity(k, constants: Constants):
    """Return |d omega_2 / dk| of real wave numbers where omega_2 is real and not zero."""
    epsilon, gamma = constants.epsilon, constants.gamma
    kappa = 2.0 * epsilon * (1.0 - cos(k)) - constants.omega
    square = (kappa - 2.0 * gamma) * (kappa + 2.0 * gamma)
    return np.abs(2.0 * epsilon * sin(k) * kappa) / np.sqrt(square)


def _least(waves: np.ndarray, decays: np.ndarray, constants: Constants) -> tuple[float, float]:
    """Return (wave number, decay) of the least over decays of the largest speed over waves."""
    speeds = growth_rate(waves[:, None], decays, constants) / decays
    j = int(np.argmin(speeds.max(axis=0)))
    return float(waves[np.argmax(speeds[:, j])]), float(decays[j])
