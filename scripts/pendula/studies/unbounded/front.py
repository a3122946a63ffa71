"""The speed of the front on the infinite chain, by the linearised equations.

D = A - B moves as exp(s t + i k n) with s^2 = 4 gamma^2 - kappa(k)^2 and kappa = 2 epsilon (1 - cos
k) - Omega. The solution is an integral over k of entire functions. The path of integration can be
moved to Im k = decay. So |D_n| is at most a constant times exp(t max Re s - decay n). The minimum
of max Re s / decay is the speed v of linear spreading (van Saarloos, Physics Reports 386 (2003)
29).

A pulled front approaches v from below: its site is v tau - delay log tau plus an offset, with
delay = 3 / (2 decay) (Ebert and van Saarloos, Physica D 146 (2000) 1).
"""

from typing import NamedTuple

import numpy as np
from latticode.numerics.elementary import (
    complex_of,
    cosh,
    geometric,
    sine_and_cosine,
    sinh,
    square_root,
)

from pendula.problem import Constants

WAVES = np.linspace(0.0, np.pi, 6401)
FINER, NARROWER = 8, 0.3
"""Number of finer grids around the best decay so far, and the width of each relative to the one
before."""


class LinearFront(NamedTuple):
    """Speed v in sites per unit of tau, and decay of the leading edge; both 0 without a front."""

    speed: float
    decay: float

    @property
    def delay(self) -> float:
        """Coefficient of -log tau in the site of the front."""
        return 1.5 / self.decay if self.decay else 0.0


def linear_front(constants: Constants) -> LinearFront:
    """Return the front that localised data excite on the linearised infinite chain.

    If the chain at rest is stable (Lemma 1) there is no front.
    """
    epsilon, gamma, omega = constants
    if not -2.0 * gamma < omega < 2.0 * gamma + 4.0 * epsilon:
        return LinearFront(0.0, 0.0)
    decays, span = geometric(1e-3, 6.0, 60), 0.2
    for _ in range(1 + FINER):
        speeds = growth_rate(WAVES[:, None], decays, constants).max(axis=0) / decays
        best = int(np.argmin(speeds))
        speed, decay = float(speeds[best]), float(decays[best])
        decays, span = decay * (1.0 + span * np.linspace(-1.0, 1.0, 9)), NARROWER * span
    return LinearFront(speed, decay)


def growth_rate(wave: np.ndarray, decay: np.ndarray, constants: Constants) -> np.ndarray:
    """Return Re s of the growing branch at the complex wave numbers wave + i decay."""
    epsilon, gamma, omega = constants
    s, c = sine_and_cosine(wave)
    kappa = 2.0 * epsilon * (1.0 - c * cosh(decay)) - omega
    across = 2.0 * epsilon * s * sinh(decay)  # Im kappa
    along = 4.0 * gamma * gamma - kappa * kappa + across * across
    return square_root(complex_of(along, -2.0 * kappa * across)).real
