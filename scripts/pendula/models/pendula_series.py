"""The equations (1) of the pendula as a recurrence for power series in time, for the Taylor method.

With x = sum_k x_k s^k, v = x', s = sin x and c = cos x, each a series too, (1) gives

    (k + 1) x_{k+1} = v_k,
    (k + 1) v_{k+1} = C (left + right - 2 x)_k + sum_{j=0}^k D_j (y - x)_{k-j} - s_k,
    (k + 1) s_{k+1} = sum_{j=0}^k c_j v_{k-j},      (k + 1) c_{k+1} = -sum_{j=0}^k s_j v_{k-j},

since s' = c v and c' = -s v. The coefficients D_k of the drive follow from its value and its
derivative at the start of the step, and s_0 and c_0 are computed there for each angle. A block of
sites keeps x, v and s; behind the ghosts lie the D_k, and then the cosines of all blocks. Ends of
the chain and order of the work are those of `series`; `m` is the memory of a series, and `i` always
the place at which a block begins, `o` that at which its cosines do.

Orders go in pairs, as in `generated`: the pass over an even order k also sums the products
of order k + 1, but for those that hold its unknown coefficients.
"""

from pendula.compiled import inlined_by_llvm, kernel
from pendula.integrators.taylor import (
    EXTRA,
    ORDER,
    ORDER_STRIDE,
    X,
    Y,
    block_start,
    spare_start,
    work_arrays,
)
from pendula.simd import LANES, fill, load, store

from .series import in_waves, partner_of, sides_of, with_neighbours
from .sines import sine_and_cosine

ANGLE, VELOCITY, SINE = X, Y, EXTRA
"""What the parts of a coefficient hold."""
DRIVE_SIZE = 3 * LANES
"""Room for the coefficients of the drive, in whole vectors."""
COSINES_SIZE = (ORDER + 1) * LANES
"""Numbers of the cosines of a block."""
WORK = work_arrays(DRIVE_SIZE + COSINES_SIZE)


@inlined_by_llvm
def cosines_start(series, component, block):
    """Return where in memory the cosines of a block begin."""
    place = component * series.blocks + block
    return spare_start(series) + DRIVE_SIZE + place * COSINES_SIZE


@inlined_by_llvm
def write_drive(pendula, m, d):
    """Write the coefficients of D from `d` on: the series of a cosine, by its frequency."""
    cosine, sine = pendula.drive, pendula.quadrature
    for k in range(ORDER + 1):
        m[d + k] = cosine
        share = pendula.frequency / (k + 1)
        cosine, sine = -share * sine, share * cosine


# --- The Cauchy products ------------------------------------------------------------------------


@inlined_by_llvm
def turned_at_even_order(m, k, i, o):
    """Return the sums of c_j v_{k-j} and of s_j v_{k-j}, for an even `k`.

    Leave those of order k + 1, but for their first and last terms, in the places of s_{k+2} and
    c_{k+2}.
    """
    c, s = load(m, o), load(m, i + SINE)
    of_c, of_s, next_c, next_s = fill(0.0), fill(0.0), fill(0.0), fill(0.0)
    for j in range(k):
        v = load(m, i + (k - j) * ORDER_STRIDE + VELOCITY)
        of_c, of_s = of_c + c * v, of_s + s * v
        c, s = load(m, o + (j + 1) * LANES), load(m, i + (j + 1) * ORDER_STRIDE + SINE)
        next_c, next_s = next_c + c * v, next_s + s * v
    store(m, i + (k + 2) * ORDER_STRIDE + SINE, next_c)
    store(m, o + (k + 2) * LANES, next_s)
    v = load(m, i + VELOCITY)
    return of_c + c * v, of_s + s * v


@inlined_by_llvm
def turned_at_odd_order(m, k, i, o):
    """Return the same sums for an odd `k`: add the terms of order k to what was left before."""
    u, w = i + k * ORDER_STRIDE, o + k * LANES
    v0, v = load(m, i + VELOCITY), load(m, u + VELOCITY)
    of_c = load(m, u + ORDER_STRIDE + SINE) + (load(m, o) * v + load(m, w) * v0)
    of_s = load(m, w + LANES) + (load(m, i + SINE) * v + load(m, u + SINE) * v0)
    return of_c, of_s


@inlined_by_llvm
def driven_at_even_order(m, k, i, p, d):
    """Return the sum of D_j (y - x)_{k-j}, for an even `k`; `p` is the block of the partner.

    Leave that of order k + 1, but for its first term, in the place of v_{k+2}.
    """
    now, later = fill(0.0), fill(0.0)
    for j in range(k + 1):
        u = (k - j) * ORDER_STRIDE + ANGLE
        apart = load(m, p + u) - load(m, i + u)
        now, later = now + m[d + j] * apart, later + m[d + j + 1] * apart
    store(m, i + (k + 2) * ORDER_STRIDE + VELOCITY, later)
    return now


@inlined_by_llvm
def driven_at_odd_order(m, k, i, p, d):
    """Return the same sum for an odd `k`."""
    u = k * ORDER_STRIDE
    apart = load(m, p + u + ANGLE) - load(m, i + u + ANGLE)
    return load(m, i + u + ORDER_STRIDE + VELOCITY) + m[d] * apart


# --- The recurrence -----------------------------------------------------------------------------


@inlined_by_llvm
def write_next_coefficient(pendula, series, k, component, block, drive, turned, o):
    """Write all coefficients of order k + 1 of a block from the sums of order k."""
    m, share = series.memory, 1.0 / (k + 1)
    left, u, right = sides_of(series, k, component, block)
    before, x, after = with_neighbours(m, left + ANGLE, u + ANGLE, right + ANGLE)
    forces = (pendula.coupling * ((after + before) - 2.0 * x) + drive) - load(m, u + SINE)
    store(m, u + ORDER_STRIDE + ANGLE, share * load(m, u + VELOCITY))
    store(m, u + ORDER_STRIDE + VELOCITY, share * forces)
    store(m, u + ORDER_STRIDE + SINE, share * turned[0])
    store(m, o + (k + 1) * LANES, -(share * turned[1]))


@inlined_by_llvm
def driven(series, k, i):
    """Return the sum of D_j (y - x)_{k-j} of a block of x, which is minus that of x - y."""
    if series.components == 1:  # x = y, and nothing is driven
        return fill(0.0)
    m, d, p = series.memory, spare_start(series), partner_of(series, i, 0)
    if k % 2 == 0:
        return driven_at_even_order(m, k, i, p, d)
    return driven_at_odd_order(m, k, i, p, d)


@inlined_by_llvm
def write_next_order(pendula, series, k, first, last):
    """Write all coefficients of order k + 1 of the blocks `first` to `last` - 1."""
    m, even = series.memory, k % 2 == 0
    for block in range(first, last):
        drive = driven(series, k, block_start(series, 0, block))
        for component in range(series.components):
            i, o = block_start(series, component, block), cosines_start(series, component, block)
            if k == 0:
                sine, cosine = sine_and_cosine(load(m, i + ANGLE))
                store(m, i + SINE, sine)
                store(m, o, cosine)
            turned = turned_at_even_order(m, k, i, o) if even else turned_at_odd_order(m, k, i, o)
            write_next_coefficient(pendula, series, k, component, block, drive, turned, o)
            drive = fill(0.0) - drive  # of y; a zero keeps its sign


continue_in_waves = in_waves(write_next_order)


@kernel
def continue_series(pendula, series):
    """Write the coefficients of all orders from those of order 0, at the time of `pendula`."""
    write_drive(pendula, series.memory, spare_start(series))
    continue_in_waves(pendula, series)
