"""The equations (4) for power series in time: each coefficient of a solution from those before.

With A = sum_k a_k (tau - t)^k, i (k + 1) a_{k+1} is the linear part at a_k and half the coefficient
of |A|^2 A, which two Cauchy products give: first |A|^2, whose coefficients are kept, then that
times A. Products run over all rows of a state at once: `density` holds |A_n|^2 in the row of the
real and again in that of the imaginary part.
"""

from .chain import close, linear_field
from .compiled import kernel


@kernel
def put_product(u, v, out):
    for i in range(out.size):
        out[i] = u[i] * v[i]


@kernel
def put_2_products(u, v, j, top, out):
    u0, u1, v0, v1 = u[j], u[j + 1], v[top - j], v[top - j - 1]
    for i in range(out.size):
        out[i] = u0[i] * v0[i] + u1[i] * v1[i]


@kernel
def put_3_products(u, v, j, top, out):
    u0, u1, u2 = u[j], u[j + 1], u[j + 2]
    v0, v1, v2 = v[top - j], v[top - j - 1], v[top - j - 2]
    for i in range(out.size):
        out[i] = (u0[i] * v0[i] + u1[i] * v1[i]) + u2[i] * v2[i]


@kernel
def put_4_products(u, v, j, top, out):
    u0, u1, u2, u3 = u[j], u[j + 1], u[j + 2], u[j + 3]
    v0, v1, v2, v3 = v[top - j], v[top - j - 1], v[top - j - 2], v[top - j - 3]
    for i in range(out.size):
        out[i] = (u0[i] * v0[i] + u1[i] * v1[i]) + (u2[i] * v2[i] + u3[i] * v3[i])


@kernel
def add_4_products(u, v, j, top, out):
    u0, u1, u2, u3 = u[j], u[j + 1], u[j + 2], u[j + 3]
    v0, v1, v2, v3 = v[top - j], v[top - j - 1], v[top - j - 2], v[top - j - 3]
    for i in range(out.size):
        out[i] += (u0[i] * v0[i] + u1[i] * v1[i]) + (u2[i] * v2[i] + u3[i] * v3[i])


@kernel
def sum_products(u, v, count, top, out):
    """Write the sum of u[j] v[top - j] for j < count, count > 0, into `out` (all flat).

    Four at a time, which saves most of the loads and stores of the sum.
    """
    first = (count - 1) % 4 + 1
    if first == 1:
        put_product(u[0], v[top], out)
    elif first == 2:
        put_2_products(u, v, 0, top, out)
    elif first == 3:
        put_3_products(u, v, 0, top, out)
    else:
        put_4_products(u, v, 0, top, out)
    for j in range(first, count, 4):
        add_4_products(u, v, j, top, out)


@kernel
def put_double_sum(u, v, one, other):
    """Write 2 (u + v) twice."""
    for i in range(u.size):
        value = u[i] + v[i]
        one[i] = value + value
    for i in range(u.size):
        other[i] = one[i]


@kernel
def add_half_square(u, out):
    for i in range(out.size):
        out[i] += 0.5 * u[i] * u[i]


@kernel
def square(series, k):
    """Write the k-th coefficient of |A|^2 and |B|^2 into density[k], each twice."""
    out, scratch, density = series.flat_scratch, series.scratch, series.density
    if k == 0:
        for i in range(out.size):
            out[i] = 0.0
    else:
        sum_products(series.flat_c, series.flat_c, (k + 1) // 2, k, out)
    if k % 2 == 0:
        add_half_square(series.flat_c[k // 2], out)
    for re in range(0, scratch.shape[0], 2):
        put_double_sum(scratch[re], scratch[re + 1], density[k, re], density[k, re + 1])


@kernel
def extend(chain, drive, u, partner, cubic, factor, out):
    """Write one row of the next coefficient, `factor` times the field at the row `u`."""
    for j in range(1, out.size - 1):
        linear = linear_field(chain, drive, u[j - 1], u[j], u[j + 1], partner[j])
        out[j] = factor * (linear + 0.5 * cubic[j])


@kernel
def next_coefficient(chain, series, k):
    """Write c[k + 1], the coefficients of order k + 1 of all sites, from c[0] to c[k]."""
    square(series, k)
    sum_products(series.flat_density, series.flat_c, k + 1, k, series.flat_scratch)
    y, dy, cubic = series.c[k], series.c[k + 1], series.scratch
    gamma, share = chain.gamma, 1.0 / (k + 1)
    close(chain, y)
    for re in range(0, y.shape[0], 2):
        im, partner = re + 1, y.shape[0] - 2 - re
        extend(chain, -gamma, y[im], y[partner + 1], cubic[im], share, dy[re])
        extend(chain, gamma, y[re], y[partner], cubic[re], -share, dy[im])
