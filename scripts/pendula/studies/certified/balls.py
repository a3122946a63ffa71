"""Balls: numbers that are known to lie within a radius, as python-flint's `arb` keeps them.

Every operation of `arb` returns a ball that contains the result for all numbers of its operands.
What is decided here is decided by comparisons, which are true only if they hold for all numbers of
the balls. Its arithmetic is that of integers, so that balls have the same bits on every machine.
"""

import math
from fractions import Fraction

from flint import arb, ctx, fmpq

from .fixed_point import decimal as exact_decimal

BITS = 128
"""Precision of the midpoints."""


def precision():
    """Return a context in which balls have midpoints of BITS bits."""
    return ctx.workprec(BITS)


def decimal(value: float) -> arb:
    """Return the ball of the decimal fraction that a double prints as: 0.1 is one tenth."""
    exact = exact_decimal(value)
    return arb(fmpq(exact.numerator, exact.denominator))


def within(value: float, radius: float) -> arb:
    """Return the ball of all numbers at most `radius` from a double."""
    return arb(float(value), float(radius))


def upper(ball: arb) -> float:
    """Return a double that is not below any number of the ball."""
    end = ball.upper()
    if not end.is_finite():
        return math.inf
    rational = end.fmpq()
    exact = Fraction(int(rational.p), int(rational.q))
    near = float(exact)
    return math.nextafter(near, math.inf) if near < exact else near
