"""How far the Taylor method may go: the step that the last coefficients of a series allow.

Step control after Jorba and Zou (Experimental Mathematics 14 (2005) 99): the last two coefficients
give the length at which the last terms fall below the tolerance, largest component, so that a half
chain takes the same steps as the whole.
"""

from math import sqrt

import numpy as np

from pendula.compiled import kernel, merged
from pendula.models.blocks import BLOCK, STEP, X, Y
from pendula.simd import fill, larger_magnitude, largest_lane, load

SQUARES = 1e-280
"""Below this, squares lose digits or vanish."""


@merged
def largest(series, k):
    """Return lane by lane the largest squared modulus in order k, and the largest part."""
    m, square, part = series.memory, fill(0.0), fill(0.0)
    for block in range(series.components * series.blocks):
        u = block * BLOCK + k * STEP
        x, y = load(m, u + X), load(m, u + Y)
        square = larger_magnitude(square, x * x + y * y)
        part = larger_magnitude(part, larger_magnitude(x, y))
    return square, part


@merged
def modulus(square, part):
    """Return the root of the largest squared modulus, or where that vanishes the largest part."""
    return part if square < SQUARES else sqrt(square)


@kernel
def size(series, k):
    """Return the largest modulus in order k."""
    square, part = largest(series, k)
    return modulus(largest_lane(square), largest_lane(part))


@kernel
def root(x):
    """Return x^(1/16) by operations that give the same bits everywhere, unlike a power."""
    return sqrt(sqrt(sqrt(sqrt(x))))


@kernel
def root_before(x):
    """Return x^(1/15) = x^(1/16 + 1/256 + 1/4096 + ...) to four digits."""
    if not x < np.inf:
        return x
    first = root(x)
    second = root(first)
    third = root(second)
    rest = (16.0 * third + 14.0) / (14.0 * third + 16.0)  # third^(1/15), and third is close to 1
    return (first * second) * (third * rest)


@kernel
def allowed_step(sizes, rtol, atol):
    """Return the step that three sizes allow: orders 0, ORDER - 1, ORDER. NaN if they overflow."""
    here, before, last = sizes
    if not last + before < np.inf:
        return np.nan
    allowed = atol + rtol * here
    return min(root(allowed / last), root_before(allowed / before))


@kernel
def up_to(h, left):
    """Return the step, or what is left where that is no more, or hardly."""
    return left if h * (1.0 + 1e-9) >= left else h
