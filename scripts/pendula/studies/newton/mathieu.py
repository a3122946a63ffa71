"""Mathieu's equation: the drive at which a wave loses stability.

Mathieu's equation is z'' + (a - 2 q cos 2 theta) z = 0, with q > 0. Waves of the chain with
0 < a <= 2 are stable up to the curves of the first tongue, which starts at a = 1 (NIST Digital
Library of Mathematical Functions, 28.2 and 28.6). With `offset` = a - 1 their continued fractions,
28.6(i), are written so that nothing cancels near a = 1, where small mu leads. Arithmetic is + - * /
of real numbers, whose bits are the same on every machine.
"""

import numpy as np

DEPTH = 12
"""Terms of a continued fraction; twice as many change no bit."""
ITERATIONS = 12
"""Of Newton's method; after eight nothing moves."""


def squared_frequency(omega, mu):
    """Return omega^2 = 1 + mu^2 Omega, half of the drive's frequency squared."""
    return 1.0 + mu * mu * np.asarray(omega)


def _fraction(square, gaps):
    """Return square / (gaps[0] - square / (gaps[1] - ...)), and its derivative by `square`."""
    found, slope = 0.0, 0.0
    for gap in gaps[::-1]:
        over = 1.0 / (gap - found)
        slope = over * (1.0 + square * over * slope)
        found = square * over
    return found, slope


def first_tongue(offset) -> np.ndarray:
    """Return the least q at which the first tongue reaches a = 1 + `offset`, -1 < offset <= 1.

    The solution of q = |offset| +- q^2 / (8 - offset - ...) is on a_1 for positive offsets and on
    b_1 for negative ones. The fraction is convex in q, so that Newton's method goes to it in one
    direction.
    """
    offset = np.asarray(offset, dtype=float)
    size, side = np.abs(offset), np.sign(offset)
    gaps = [4.0 * j * (j + 1) - offset for j in range(1, DEPTH + 1)]  # (2 j + 1)^2 - a
    found = size
    for _ in range(ITERATIONS):
        fraction, slope = _fraction(found * found, gaps)
        move = (size + side * fraction - found) / (1.0 - 2.0 * side * found * slope)
        found = np.where(side * move > 0.0, found + move, found)
    return found


def band_threshold(lowest, highest) -> np.ndarray:
    """Return the q up to which all waves with offsets from `lowest` to `highest` are stable.

    It is zero where a = 1 is among them. Else the tongue meets the band at the end nearest to it.
    """
    lowest, highest = np.asarray(lowest, dtype=float), np.asarray(highest, dtype=float)
    within = (lowest <= 0.0) & (highest >= 0.0)
    nearest = np.where(lowest > 0.0, lowest, highest)
    return np.where(within, 0.0, first_tongue(np.where(within, 0.0, nearest)))


def strings_grow(constants, mu: float) -> bool:
    """Return whether the drive makes waves of the strings grow where no gravity holds the pendula.

    The mean force of gravity on pendula that turn over and over is zero. Without it the difference
    of the two pendula of a pair obeys Mathieu's equation, with 0 < a <= 4 epsilon mu^2 / omega^2
    and q = 2 |gamma| mu^2 / omega^2. `constants` are those of (4).
    """
    share = mu * mu / squared_frequency(constants.omega, mu)
    highest, strength = 4.0 * constants.epsilon * share, 2.0 * abs(constants.gamma) * share
    return bool(highest < 0.0 or strength > band_threshold(-1.0, highest - 1.0))
