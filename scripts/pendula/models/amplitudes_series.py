"""The equations (4) as a recurrence for power series in time, the rule of the Taylor method.

With A = sum_k a_k s^k and D = |A|^2 / 2 = sum_k d_k s^k, (4) gives

    i (k + 1) a_{k+1} = linear terms of (4) at a_k + c_k,
    c_k = sum_{j=0}^k d_j a_{k-j},      d_k = sum_{j=0}^k Re(conj(a_j) a_{k-j}) / 2,

so that two Cauchy products make the coefficient c_k of the cubic term. From top to bottom: the
Cauchy products, and the recurrence. The ends of the chain and the order of the work are those of
`series`. How a series lies in memory, in blocks of sites, says pendula.integrators.taylor; `m` is
that memory, and `i` always the place at which a block begins.
"""

from pendula.compiled import inlined_by_llvm, kernel
from pendula.integrators.taylor import EXTRA, ORDER_STRIDE, X, Y, block_start
from pendula.simd import fill, load, store

from .amplitudes import Chain, linear_field
from .series import in_waves, partner_of, sides_of, with_neighbours

HALF_SQUARE = EXTRA
"""Where a coefficient keeps d_k, that of |A|^2 / 2."""


# --- The cubic term by Cauchy products ----------------------------------------------------------
# Orders go in pairs: the pass that sums the products of an even order k in registers also sums
# those of order k + 1, but for the terms that hold a_{k+1}, which is not known yet. Each number
# that is loaded thus serves twice, and loads are what limits the speed.


@inlined_by_llvm
def half_square_of_even_order(m, k, i):
    """Return d_k for an even `k`; write it, and d_{k+1} without its terms of a_{k+1}.

    Equal products of the sum, j and k - j, are taken once: d_k is half of the middle one and the
    sum of the others. Re and Im are summed apart, and added at the end.
    """
    middle = i + k // 2 * ORDER_STRIDE
    x, y = load(m, middle + X), load(m, middle + Y)
    sum_x, sum_y = 0.5 * x * x, 0.5 * y * y
    next_x, next_y = fill(0.0), fill(0.0)
    low_x, low_y = load(m, i + X), load(m, i + Y)
    for j in range(1, k // 2 + 1):
        high, low = i + (k + 1 - j) * ORDER_STRIDE, i + j * ORDER_STRIDE
        high_x, high_y = load(m, high + X), load(m, high + Y)
        sum_x, sum_y = sum_x + low_x * high_x, sum_y + low_y * high_y  # j - 1 and k + 1 - j
        low_x, low_y = load(m, low + X), load(m, low + Y)
        next_x, next_y = next_x + low_x * high_x, next_y + low_y * high_y  # j and k + 1 - j
    total = sum_x + sum_y
    store(m, i + k * ORDER_STRIDE + HALF_SQUARE, total)
    store(m, i + (k + 1) * ORDER_STRIDE + HALF_SQUARE, next_x + next_y)
    return total


@inlined_by_llvm
def cubic_of_even_order(m, k, i):
    """Return both parts of c_k for an even `k`; leave c_{k+1} but for two terms in order k + 2.

    The two are d_0 a_{k+1} and d_{k+1} a_0. The place of a_{k+2} is free until c_{k+1} is used.
    """
    last = half_square_of_even_order(m, k, i)
    now_x, now_y, next_x, next_y = fill(0.0), fill(0.0), fill(0.0), fill(0.0)
    d = load(m, i + HALF_SQUARE)
    for j in range(k):
        u = i + (k - j) * ORDER_STRIDE
        x, y = load(m, u + X), load(m, u + Y)
        now_x, now_y = now_x + d * x, now_y + d * y  # d_j a_{k-j}
        d = load(m, i + (j + 1) * ORDER_STRIDE + HALF_SQUARE)
        next_x, next_y = next_x + d * x, next_y + d * y  # d_{j+1} a_{k-j}
    store(m, i + (k + 2) * ORDER_STRIDE + X, next_x)
    store(m, i + (k + 2) * ORDER_STRIDE + Y, next_y)
    return now_x + last * load(m, i + X), now_y + last * load(m, i + Y)


@inlined_by_llvm
def cubic_of_odd_order(m, k, i):
    """Return both parts of c_k for an odd `k`: add the terms of a_k to what was left before."""
    u = i + k * ORDER_STRIDE
    x0, y0, x, y = load(m, i + X), load(m, i + Y), load(m, u + X), load(m, u + Y)
    last, first = load(m, u + HALF_SQUARE) + (x0 * x + y0 * y), load(m, i + HALF_SQUARE)
    store(m, u + HALF_SQUARE, last)
    cubic_x = load(m, u + ORDER_STRIDE + X) + (last * x0 + first * x)
    cubic_y = load(m, u + ORDER_STRIDE + Y) + (last * y0 + first * y)
    return cubic_x, cubic_y


# --- The recurrence -----------------------------------------------------------------------------


@inlined_by_llvm
def linear_part(scaled, m, left, here, right, partner):
    """Return the linear terms at Re or Im of a block, given where it and the others lie."""
    before, u, after = with_neighbours(m, left, here, right)
    return linear_field(scaled, scaled.gamma, before, u, after, load(m, partner))


@inlined_by_llvm
def write_next_coefficient(chain, series, k, component, block, cubic):
    """Write a_{k+1} of a block: x_{k+1} = Im F_k / (k + 1) and y_{k+1} = -Re F_k / (k + 1).

    The factor and the signs go into the constants, three numbers instead of three vectors.
    """
    m, share = series.memory, 1.0 / (k + 1)
    left, u, right = sides_of(series, k, component, block)
    # the block itself when A = B, where the drive vanishes exactly since partner - u is then zero
    partner = partner_of(series, u, component)
    epsilon, gamma, omega = share * chain.epsilon, share * chain.gamma, share * chain.omega
    of_y = Chain(epsilon, -gamma, omega, chain.left, chain.right)
    of_x = Chain(-epsilon, -gamma, -omega, chain.left, chain.right)
    x = linear_part(of_y, m, left + Y, u + Y, right + Y, partner + Y) + share * cubic[1]
    y = linear_part(of_x, m, left + X, u + X, right + X, partner + X) - share * cubic[0]
    store(m, u + ORDER_STRIDE + X, x)
    store(m, u + ORDER_STRIDE + Y, y)


@inlined_by_llvm
def write_next_order(chain, series, k, first, last):
    """Write a_{k+1} of the blocks `first` to `last` - 1 of each component."""
    m = series.memory
    for component in range(series.components):
        if k % 2 == 0:  # asked outside the loops over blocks, whose bodies are long
            for block in range(first, last):
                cubic = cubic_of_even_order(m, k, block_start(series, component, block))
                write_next_coefficient(chain, series, k, component, block, cubic)
        else:
            for block in range(first, last):
                cubic = cubic_of_odd_order(m, k, block_start(series, component, block))
                write_next_coefficient(chain, series, k, component, block, cubic)


continue_in_waves = in_waves(write_next_order)


@kernel
def continue_series(chain, series):
    """Write the coefficients of all orders from those of order 0."""
    continue_in_waves(chain, series)
