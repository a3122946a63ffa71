"""What generated kernels take from the library: their system, elementary functions, and imports.

A generated module imports all of this. It stands in a file, so that a change of any of it compiles
the kernels again and reruns the jobs that call them.
"""
# ruff: noqa: F401

from typing import NamedTuple

import numpy as np

from latticode.integrators import taylor
from latticode.integrators.taylor import EXTRA, ORDER, ORDER_STRIDE, X, Y, block_start, spare_start
from latticode.kernels.compiled import inlined_by_llvm, kernel
from latticode.kernels.simd import (
    LANES,
    TINY,
    define_shift,
    fill,
    left_neighbours,
    load,
    power_of_two,
    right_neighbours,
    select_positive,
    square_root,
    store,
    whole_exponent,
    zero_below,
)
from latticode.numerics import elementary
from latticode.numerics.elementary import HALF_PI, LN2

from .chain import at_every_site, close, sum_from_middle, unfold, widen
from .series import in_waves, sides_of


class DensityWorkspace(NamedTuple):
    """What the densities of a model are given, whose sums over the whole chain a run keeps.

    They go on beyond ends at rest as far as they look, so that the bonds to them count.
    """

    constants: tuple[float, ...]
    at: np.ndarray  # (row, 1 + site), as that of a system
    wide: np.ndarray  # (row, reach + site), room for the state
    terms: np.ndarray  # (density, 1 + site), room for the densities


class Couplings(NamedTuple):
    """The matrices that couple sites, for sums over all sites in a fixed order.

    Rows of a matrix are summed from the first column to the last, whatever the processor. All are
    in `dense` (matrix, column, site) if that has the sites; else their entries that are not zero
    are in `weights` and `columns`, those of a site between `starts` of it and of the next.
    """

    dense: np.ndarray
    weights: np.ndarray
    columns: np.ndarray
    starts: np.ndarray  # (matrix, site)
    factors: np.ndarray  # (product, 1 + site), what the matrices multiply
    products: np.ndarray  # (product, 1 + site)
    factors_by_block: np.ndarray  # (product, site), in whole blocks
    products_by_block: np.ndarray


@kernel
def multiply_by_matrix(couplings, matrix, factors, products, first) -> None:
    """Write a matrix times the flat `factors` into `products`, whose sites begin at `first`."""
    sites = couplings.starts.shape[1] - 1
    if couplings.dense.shape[1] == sites and couplings.dense.shape[0] > matrix:
        for site in range(sites):
            products[first + site] = 0.0
        for column in range(sites):
            factor, line = factors[first + column], couplings.dense[matrix, column]
            for site in range(sites):
                products[first + site] += line[site] * factor
        return
    for site in range(sites):
        total = 0.0
        for k in range(couplings.starts[matrix, site], couplings.starts[matrix, site + 1]):
            total += couplings.weights[k] * factors[first + couplings.columns[k]]
        products[first + site] = total


class System(NamedTuple):
    """What the kernels of any traced model are given."""

    constants: tuple[float, ...]
    clocks: tuple[float, ...]  # the functions of the time, and behind them their derivatives
    at: np.ndarray  # (row, 1 + site), parameters that depend on the site, with room for a vector
    wide: np.ndarray  # (row, reach + site), room for a state with more ghost columns
    sums: DensityWorkspace
    couplings: Couplings
    left: int
    right: int


# --- Sine and cosine of numbers or vectors of sites, with the same bits on every machine ----------

sine_less_angle, cosine_near_zero = map(
    inlined_by_llvm, (elementary.sine_less_angle, elementary.cosine_near_zero)
)
STRAIGHT = 1e-65
"""For smaller angles sin x = x and cos x = 1 to the last bit; their fourth powers underflow."""


@inlined_by_llvm
def _nearest_integer(x):
    """Return the whole number nearest to x, for abs(x) < 2^51; x is a number or a Vector."""
    return -(6755399441055744.0 - (6755399441055744.0 + x))  # 1.5 * 2^52, where doubles are whole


@inlined_by_llvm
def _reduced(x):
    """Return sin r, cos r, o and s of x = r + (o + 2 j) pi / 2, abs(r) <= pi / 4.

    o is -1, 0 or 1, and s = (-1)^j. So sin x = s (sin r + o cos r) with one of the two terms, and
    no lane of a vector needs another code than the next.
    """
    quarters = _nearest_integer((1.0 / HALF_PI[0]) * x)
    near = (x - HALF_PI[0] * quarters) - HALF_PI[1] * quarters
    low = -(HALF_PI[2] * quarters)
    halves = _nearest_integer(0.5 * quarters)
    odd = quarters - 2.0 * halves
    parity = halves - 2.0 * _nearest_integer(0.5 * halves)
    sign = 1.0 - 2.0 * (parity * parity)
    bent = zero_below(STRAIGHT, near)
    return near + sine_less_angle(bent, low), cosine_near_zero(bent, low), odd, sign


@inlined_by_llvm
def sine_and_cosine(x) -> tuple:
    """Return sin x and cos x with errors of some 1e-16, for angles of up to thousands of turns."""
    s, c, odd, sign = _reduced(x)
    even = 1.0 - odd * odd
    return sign * (even * s + odd * c), sign * (even * c - odd * s)


# --- Exponentials, logarithms and roots -----------------------------------------------------------

E2, E3, E4, E5, E6, E7, E8, E9, E10, E11, E12, E13, E14 = elementary.EXP
A1, A2, A3, A4, A5, A6, A7, A8, A9, A10, A11, A12 = elementary.ATANH


@inlined_by_llvm
def exponential(x):
    """Return e^x with an error of some 1e-16 of it, 0 or infinity beyond the range of doubles."""
    k = _nearest_integer((1.0 / LN2[0]) * x)
    start, low = x - LN2[0] * k, LN2[1] * k
    r = start - low
    far = E10 + r * (E11 + r * (E12 + r * (E13 + E14 * r)))
    near = E5 + r * (E6 + r * (E7 + r * (E8 + r * (E9 + r * far))))
    curved = r * r * (E2 + r * (E3 + r * (E4 + r * near)))
    t = r + (curved + ((start - r) - low))
    half = _nearest_integer(0.5 * k)
    return ((1.0 + t) * power_of_two(half)) * power_of_two(k - half)


@inlined_by_llvm
def logarithm_and_inverse(x) -> tuple:
    """Return log(x), with an error of some 1e-16, and 1 / x, for normal x > 0; else NaN."""
    k = whole_exponent(x)
    half = _nearest_integer(0.5 * k)
    f = -(1.0 - (x * power_of_two(-half)) * power_of_two(-(k - half)))
    s = f / (2.0 + f)
    z = s * s
    far = A7 + z * (A8 + z * (A9 + z * (A10 + z * (A11 + A12 * z))))
    series = z * (A1 + z * (A2 + z * (A3 + z * (A4 + z * (A5 + z * (A6 + z * far))))))
    bent = 0.5 * f * f
    value = LN2[0] * k - ((bent - (s * (bent + series) + LN2[1] * k)) - f)
    inverse = 1.0 / x
    return value + (0.0 * square_root(x) + 0.0 * inverse), inverse


@inlined_by_llvm
def root_and_inverse(x) -> tuple:
    """Return the square root of x and its inverse."""
    root = square_root(x)
    return root, 1.0 / root
