"""The drive at which a wave of the chain loses stability, by Mathieu's equation.

Mathieu's equation is z'' + (a - 2 q cos 2 theta) z = 0, with q > 0. Waves of the chain with
0 < a <= 2 are stable up to the curves of the first tongue, which starts at a = 1 (NIST Digital
Library of Mathematical Functions, 28.2 and 28.6). Small mu means a near 1: the continued fractions
28.6(i) are therefore written in `offset` = a - 1, so that nothing cancels. Arithmetic is + - * / of
real numbers, whose bits are the same on every machine.
"""

import numpy as np
from numpy.typing import ArrayLike

from pendula.problem import Constants

DEPTH = 12
"""Terms of the continued fraction; twice as many give the same bits."""
ITERATIONS = 12
"""Steps of Newton's method; after eight no bit changes."""


def squared_frequency(omega: ArrayLike, mu: ArrayLike) -> np.ndarray:
    """Return omega^2 = 1 + mu^2 Omega, where 2 omega is the frequency of the drive."""
    return 1.0 + mu * mu * np.asarray(omega)


def _fraction(square: np.ndarray, gaps: list[np.ndarray]) -> tuple[np.ndarray, np.ndarray]:
    """Return square / (gaps[0] - square / (gaps[1] - ...)) and its derivative by `square`."""
    fraction, slope = 0.0, 0.0
    for gap in gaps[::-1]:
        inverse = 1.0 / (gap - fraction)
        slope = inverse * (1.0 + square * inverse * slope)
        fraction = square * inverse
    return fraction, slope


def first_tongue(offset: ArrayLike) -> np.ndarray:
    """Return the least q at which the first tongue reaches a = 1 + `offset`.

    Offsets are in (-1, 1]. The equation is q = |offset| +- q^2 / (8 - offset - ...), on a_1 for
    positive offsets and on b_1 for negative ones. The fraction is convex in q, so
    Newton's method converges monotonically.
    """
    offset = np.asarray(offset, dtype=float)
    size, side = np.abs(offset), np.sign(offset)
    gaps = [4.0 * j * (j + 1) - offset for j in range(1, DEPTH + 1)]  # (2 j + 1)^2 - a
    q = size
    for _ in range(ITERATIONS):
        fraction, slope = _fraction(q * q, gaps)
        newton_step = (size + side * fraction - q) / (1.0 - 2.0 * side * q * slope)
        q = np.where(side * newton_step > 0.0, q + newton_step, q)
    return q


def band_threshold(lowest: ArrayLike, highest: ArrayLike) -> np.ndarray:
    """Return the q up to which all waves with offsets from `lowest` to `highest` are stable.

    It is zero if the band contains a = 1. Otherwise the tongue first meets the nearest end.
    """
    lowest, highest = np.asarray(lowest, dtype=float), np.asarray(highest, dtype=float)
    is_inside = (lowest <= 0.0) & (highest >= 0.0)
    nearest = np.where(lowest > 0.0, lowest, highest)
    return np.where(is_inside, 0.0, first_tongue(np.where(is_inside, 0.0, nearest)))


def waves_on_strings_grow(constants: Constants, mu: float) -> bool:
    """Return whether the drive makes waves grow among pendula that keep rotating.

    The mean force of gravity on a rotating pendulum is zero. Without it the difference of the two
    pendula of a pair obeys Mathieu's equation, with 0 < a <= 4 epsilon mu^2 / omega^2 and
    q = 2 |gamma| mu^2 / omega^2. `constants` are those of (4).
    """
    share = mu * mu / squared_frequency(constants.omega, mu)
    highest, strength = 4.0 * constants.epsilon * share, 2.0 * abs(constants.gamma) * share
    return bool(highest < 0.0 or strength > band_threshold(-1.0, highest - 1.0))
