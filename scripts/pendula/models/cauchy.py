"""The cubic term of the equations, half of |A|^2 A, for power series in blocks.

Two Cauchy products give a coefficient of it: first |A|^2 / 2, whose coefficients are kept, then
that times A. Orders go in pairs: one pass sums the products of an even order k in registers, and
those of order k + 1 but for the terms that hold its own coefficients, so that each number that is
loaded serves twice. Everywhere `i` is where the block begins.
"""

from pendula.compiled import merged
from pendula.simd import fill, load, store

from .blocks import DENSITY, STEP, X, Y


@merged
def square(m, k, i):
    """Return coefficient k, even, of the density; write it, and k + 1 as far as known."""
    u = i + k // 2 * STEP
    x, y = load(m, u + X), load(m, u + Y)
    sum_x, sum_y = 0.5 * x * x, 0.5 * y * y
    later_x, later_y = fill(0.0), fill(0.0)
    low_x, low_y = load(m, i + X), load(m, i + Y)
    for j in range(1, k // 2 + 1):
        high, low = i + (k + 1 - j) * STEP, i + j * STEP
        high_x, high_y = load(m, high + X), load(m, high + Y)
        sum_x, sum_y = sum_x + low_x * high_x, sum_y + low_y * high_y
        low_x, low_y = load(m, low + X), load(m, low + Y)
        later_x, later_y = later_x + low_x * high_x, later_y + low_y * high_y
    total = sum_x + sum_y
    store(m, i + k * STEP + DENSITY, total)
    store(m, i + (k + 1) * STEP + DENSITY, later_x + later_y)
    return total


@merged
def even_cubic(m, k, i):
    """Return both parts of coefficient k, even; what is known of k + 1 waits in k + 2."""
    last = square(m, k, i)
    now_x, now_y, next_x, next_y = fill(0.0), fill(0.0), fill(0.0), fill(0.0)
    here = load(m, i + DENSITY)
    for j in range(k):
        u = i + (k - j) * STEP
        x, y = load(m, u + X), load(m, u + Y)
        now_x, now_y = now_x + here * x, now_y + here * y
        here = load(m, i + (j + 1) * STEP + DENSITY)
        next_x, next_y = next_x + here * x, next_y + here * y
    store(m, i + (k + 2) * STEP + X, next_x)
    store(m, i + (k + 2) * STEP + Y, next_y)
    return now_x + last * load(m, i + X), now_y + last * load(m, i + Y)


@merged
def odd_cubic(m, k, i):
    """Return both parts of coefficient k, odd: add the terms that hold its own coefficients."""
    u = i + k * STEP
    x0, y0, x, y = load(m, i + X), load(m, i + Y), load(m, u + X), load(m, u + Y)
    last, first = load(m, u + DENSITY) + (x0 * x + y0 * y), load(m, i + DENSITY)
    store(m, u + DENSITY, last)
    cubic_x = load(m, u + STEP + X) + (last * x0 + first * x)
    cubic_y = load(m, u + STEP + Y) + (last * y0 + first * y)
    return cubic_x, cubic_y
