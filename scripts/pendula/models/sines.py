"""Sine and cosine of numbers or vectors of sites, with the same bits on every machine."""

from pendula.compiled import inlined_by_llvm
from pendula.numerics import elementary
from pendula.numerics.elementary import HALF_PI

sine_near_zero, cosine_near_zero = map(
    inlined_by_llvm, (elementary.sine_near_zero, elementary.cosine_near_zero)
)


@inlined_by_llvm
def whole(x):
    """Return the whole number nearest to x, for abs(x) < 2^51; x is a number or a Vector."""
    return -(6755399441055744.0 - (6755399441055744.0 + x))  # 1.5 * 2^52, where doubles are whole


@inlined_by_llvm
def reduced(x):
    """Return sin r, cos r, o and s of x = r + (o + 2 j) pi / 2, abs(r) <= pi / 4.

    o is -1, 0 or 1, and s = (-1)^j. So sin x = s (sin r + o cos r) with one of the two terms, and
    no lane of a vector needs another code than the next.
    """
    quarters = whole((1.0 / HALF_PI[0]) * x)
    near = (x - HALF_PI[0] * quarters) - HALF_PI[1] * quarters
    rest = -(HALF_PI[2] * quarters)
    halves = whole(0.5 * quarters)
    odd = quarters - 2.0 * halves
    parity = halves - 2.0 * whole(0.5 * halves)
    sign = 1.0 - 2.0 * (parity * parity)
    return sine_near_zero(near, rest), cosine_near_zero(near, rest), odd, sign


@inlined_by_llvm
def sine_and_cosine(x):
    """Return sin x and cos x with errors of some 1e-16, for angles of up to thousands of turns."""
    s, c, odd, sign = reduced(x)
    even = 1.0 - odd * odd
    return sign * (even * s + odd * c), sign * (even * c - odd * s)
