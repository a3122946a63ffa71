"""Mathieu's equation: the drive at which a wave loses stability.

Mathieu's equation is z'' + (a - 2 q cos 2 theta) z = 0, with q > 0. Two of its curves bound the
region where a wave of the chain is stable (NIST Digital Library of Mathematical Functions, 28.2
and 28.6): those of the first tongue, which starts at a = 1, and the lower one of the second, which
starts at a = 4. With `offset` = a - 1 their continued fractions, 28.6(i), are written so that
nothing cancels near a = 1, where small mu leads. They hold for 0 < a < 4. Arithmetic is + - * / and
square roots of real numbers, whose bits are the same on every machine.
"""

import numpy as np

DEPTH = 12
"""Terms of a continued fraction; twice as many change no bit."""
MOST = 1_000
"""Iterations after which something is wrong; they need ten."""
ROUNDING = 2.0**-49
"""Relative rounding of a square: eight units in the last place."""
BEYOND = 4.0
"""The curve a_1(q) has its highest point below this q: what is not met by then never is."""


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


def _settled(step, start: np.ndarray) -> np.ndarray:
    """Return what `step` leaves as it is, by iteration from `start`: its square no longer moves."""
    found = start
    for _ in range(MOST):
        old, found = found, step(found)
        moved = np.abs(found - old) * (found + old)
        if np.all((moved <= ROUNDING * found**2) | np.isinf(found)):
            return found
    raise ArithmeticError(f"no fixed point after {MOST} iterations")


def first_tongue(offset) -> np.ndarray:
    """Return the least q at which the first tongue reaches a = 1 + `offset`, -1 < offset < 3.

    The solution of q = |offset| +- q^2 / (8 - offset - ...) is on a_1 for positive offsets and on
    b_1 for negative ones. The fraction is convex in q, so that Newton's method goes to it in one
    direction, and for positive offsets finds the least of several. Where there is none, since a_1
    does not reach so high, the result is infinite.
    """
    offset = np.asarray(offset, dtype=float)
    size, side = np.abs(offset), np.sign(offset)
    gaps = [4.0 * j * (j + 1) - offset for j in range(1, DEPTH + 1)]  # (2 j + 1)^2 - a

    def step(q):
        bounded = np.minimum(q, BEYOND)
        fraction, slope = _fraction(bounded * bounded, gaps)
        steepness = 1.0 - 2.0 * side * bounded * slope
        move = (size + side * fraction - bounded) / np.where(steepness > 0.0, steepness, np.nan)
        found = np.where(side * move > 0.0, bounded + move, bounded)
        return np.where(np.isnan(move) | (found >= BEYOND), np.inf, found)

    with np.errstate(invalid="ignore"):  # inf - inf, where nothing is met
        return _settled(step, size)


def second_tongue(offset) -> np.ndarray:
    """Return the q at which the lower curve b_2 of the second tongue comes down to 1 + `offset`."""
    below_four = 3.0 - np.asarray(offset, dtype=float)
    gaps = [4.0 * (j * j - 1) + below_four for j in range(3, DEPTH + 3)]  # (2 j)^2 - a

    def step(q):
        return np.sqrt(below_four * (12.0 + below_four - _fraction(q * q, gaps)[0]))

    return _settled(step, np.sqrt(below_four * (12.0 + below_four)))


def band_threshold(lowest, highest) -> np.ndarray:
    """Return the q up to which all waves with offsets from `lowest` to `highest` are stable.

    It is zero where a = 1 or a = 4 is among them, at which a tongue starts. Between, the first
    tongue meets the band at the end nearest to a = 1, and the second at the highest. NaN where all
    waves lie above a = 4: the two curves say nothing about these.
    """
    lowest, highest = np.asarray(lowest, dtype=float), np.asarray(highest, dtype=float)
    nearest = np.where(lowest > 0.0, lowest, highest)
    within = ((lowest <= 0.0) & (highest >= 0.0)) | ((lowest <= 3.0) & (highest >= 3.0))
    above = lowest > 3.0
    nearest, highest = (np.where(within | above, 0.0, one) for one in (nearest, highest))
    found = np.minimum(first_tongue(nearest), second_tongue(highest))
    return np.where(above, np.nan, np.where(within, 0.0, found))


def strings_grow(constants, mu: float) -> bool:
    """Return whether the drive makes waves of the strings grow where no gravity holds the pendula.

    The mean force of gravity on pendula that turn over and over is zero. Without it the difference
    of the two pendula of a pair obeys Mathieu's equation, with 0 < a <= 4 epsilon mu^2 / omega^2
    and q = 2 |gamma| mu^2 / omega^2. `constants` are those of (4).
    """
    highest = 4.0 * constants.epsilon * mu * mu / squared_frequency(constants.omega, mu)
    stable_to = band_threshold(-1.0, highest - 1.0)
    return bool(highest < 0.0 or strength(constants, mu) > stable_to)


def strength(constants, mu: float) -> float:
    """Return q of the drive, 2 |gamma| mu^2 / omega^2."""
    square = squared_frequency(constants.omega, mu) / (mu * mu)
    return float(2.0 * abs(constants.gamma) / square)
