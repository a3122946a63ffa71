"""The equations (4) for power series in time: each coefficient of a solution from those before.

With A = sum_k a_k (tau - t)^k, i (k + 1) a_{k+1} is the linear part at a_k and half the coefficient
of |A|^2 A, which two Cauchy products give: first |A|^2, whose coefficients are kept, then that
times A. Sites go four at a time and orders in pairs: one pass sums the products of an even order k
in registers, and those of order k + 1 but for the terms that hold its own coefficients, so that
each number that is loaded serves twice.
"""

from .chain import close, linear_field
from .compiled import kernel, merged
from .vectors import LANES, fill, load, store

# not cached on its own: its cache would not notice a change in `vectors`
linear_vector = merged(linear_field.py_func)


@merged
def extend(chain, c, k, re, i, cubic_re, cubic_im):
    """Write coefficient k + 1 of four sites of a component, whose real parts are at c[0] + i."""
    row = c.shape[2]
    order = c.shape[1] * row
    share, gamma = 1.0 / (k + 1), chain.gamma
    u = k * order + i
    v, away = u + row, (c.shape[1] - 2 - 2 * re) * row  # the row itself when A = B
    of_v = linear_vector(
        chain, -gamma, load(c, v - 1), load(c, v), load(c, v + 1), load(c, v + away)
    )
    of_u = linear_vector(
        chain, gamma, load(c, u - 1), load(c, u), load(c, u + 1), load(c, u + away)
    )
    store(c, u + order, share * (of_v + 0.5 * cubic_im))
    store(c, v + order, -share * (of_u + 0.5 * cubic_re))


@merged
def square(c, density, k, i):
    """Return coefficient k, even, of |A|^2 at four sites; write it, and k + 1 as far as known."""
    row = c.shape[2]
    order = c.shape[1] * row
    u = i + k // 2 * order
    x, y = load(c, u), load(c, u + row)
    sum_x, sum_y = 0.5 * x * x, 0.5 * y * y
    later_x, later_y = fill(0.0), fill(0.0)
    low_x, low_y = load(c, i), load(c, i + row)
    for j in range(1, k // 2 + 1):
        high, low = i + (k + 1 - j) * order, i + j * order
        high_x, high_y = load(c, high), load(c, high + row)
        sum_x, sum_y = sum_x + low_x * high_x, sum_y + low_y * high_y
        low_x, low_y = load(c, low), load(c, low + row)
        later_x, later_y = later_x + low_x * high_x, later_y + low_y * high_y
    total, later = sum_x + sum_y, later_x + later_y
    total, later = total + total, later + later
    store(density, i + k * order, total)
    store(density, i + (k + 1) * order, later)
    return total


@merged
def even_order(chain, c, density, k, re, i):
    """Extend four sites from order k; the known cubic terms of k + 1 wait in coefficient k + 2."""
    row = c.shape[2]
    order = c.shape[1] * row
    last = square(c, density, k, i)
    now_x, now_y, next_x, next_y = fill(0.0), fill(0.0), fill(0.0), fill(0.0)
    here = load(density, i)
    for j in range(k):
        u = i + (k - j) * order
        x, y = load(c, u), load(c, u + row)
        now_x, now_y = now_x + here * x, now_y + here * y
        here = load(density, i + (j + 1) * order)
        next_x, next_y = next_x + here * x, next_y + here * y
    if k + 2 < c.shape[0]:
        store(c, i + (k + 2) * order, next_x)
        store(c, i + (k + 2) * order + row, next_y)
    cubic_x, cubic_y = now_x + last * load(c, i), now_y + last * load(c, i + row)
    extend(chain, c, k, re, i, cubic_x, cubic_y)


@merged
def odd_order(chain, c, density, k, re, i):
    """Extend four sites from order k: add the terms that hold its own coefficients."""
    row = c.shape[2]
    order = c.shape[1] * row
    u = i + k * order
    x0, y0, x, y = load(c, i), load(c, i + row), load(c, u), load(c, u + row)
    half, first = x0 * x + y0 * y, load(density, i)
    last = load(density, u) + (half + half)
    store(density, u, last)
    cubic_x = load(c, u + order) + (last * x0 + first * x)
    cubic_y = load(c, u + order + row) + (last * y0 + first * y)
    extend(chain, c, k, re, i, cubic_x, cubic_y)


@kernel
def next_coefficient(chain, series, k):
    """Write c[k + 1], the coefficients of order k + 1 of all sites, from c[0] to c[k]."""
    c, density = series.c, series.density
    close(chain, c[k, :, : series.columns])
    for re in range(0, c.shape[1], 2):
        first = re * c.shape[2] + 1
        last = first + series.columns - 2
        if k % 2 == 0:
            for i in range(first, last, LANES):
                even_order(chain, c, density, k, re, i)
        else:
            for i in range(first, last, LANES):
                odd_order(chain, c, density, k, re, i)
