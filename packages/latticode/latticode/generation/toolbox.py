"""All names that generated modules use: their system, elementary functions, and imports.

A generated module imports everything from this file. A change in this file or in its imports thus
recompiles the kernels and reruns the jobs that call them.
"""
# ruff: noqa: F401

from typing import Any, NamedTuple

import numpy as np

from latticode.integrators import taylor
from latticode.integrators.taylor import EXTRA, ORDER, ORDER_STRIDE, X, Y, block_start, spare_start
from latticode.kernels.compiled import in_one_pass, inlined_by_llvm, kernel
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
    """Inputs and work arrays of conserved densities, which are summed over the whole chain.

    The sums include sites beyond ends at rest as far as the densities reach: their bonds count.
    """

    constants: tuple[float, ...]
    at: np.ndarray  # (row, 1 + site), see System
    wide: np.ndarray  # (row, reach + site), for the state
    terms: np.ndarray  # (density, 1 + site), for the densities


class Couplings(NamedTuple):
    """Matrices that couple sites, with work arrays.

    Rows are summed from the first column to the last, on every processor. If `dense` has as many
    columns as the chain has sites, it contains all matrices. Otherwise `weights` and `columns`
    contain the nonzero entries; the entries of site i begin at index starts[matrix, i].
    """

    dense: np.ndarray  # (matrix, column, site)
    weights: np.ndarray
    columns: np.ndarray
    starts: np.ndarray  # (matrix, site)
    factors: np.ndarray  # (product, 1 + site)
    products: np.ndarray  # (product, 1 + site)
    factors_by_block: np.ndarray  # (product, site), in whole blocks
    products_by_block: np.ndarray


@kernel
def multiply_by_matrix(
    couplings: Couplings, matrix: int, factors: np.ndarray, products: np.ndarray, first: int
) -> None:
    """Write a matrix times `factors` into `products`; in both, sites begin at index `first`."""
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
    """The inputs and work arrays of a traced model's kernels."""

    constants: tuple[float, ...]
    clocks: tuple[float, ...]  # functions of time, then their derivatives
    at: np.ndarray  # (row, 1 + site), constants that depend on the site, padded by a vector
    wide: np.ndarray  # (row, reach + site), for a state with more ghost columns
    sums: DensityWorkspace
    couplings: Couplings
    left: int  # kind of the left end
    right: int


# --- Sine and cosine of numbers or vectors of sites, with the same bits on every machine ----------

Real = Any  # a number or a Vector

sine_less_angle, cosine_near_zero = map(
    inlined_by_llvm, (elementary.sine_less_angle, elementary.cosine_near_zero)
)
STRAIGHT = 1e-65
"""For smaller angles x, sin x = x and cos x = 1 to the last bit, and x^4 underflows."""


@inlined_by_llvm
def _nearest_integer(x: Real) -> Real:
    """Return the integer nearest to x, for abs(x) < 2^51."""
    return -(6755399441055744.0 - (6755399441055744.0 + x))  # near 1.5 * 2^52 doubles are integers


@inlined_by_llvm
def _reduced(x: Real) -> tuple[Real, Real, Real, Real]:
    """Return sin r, cos r, o and s for x = r + (o + 2 j) pi / 2 with abs(r) <= pi / 4.

    j is an integer, o is -1, 0 or 1, and s = (-1)^j. sin x is s sin r if o = 0, and s o cos r
    otherwise. As all lanes execute the same operations, sin x = (1 - o^2) s sin r + s o cos r.
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
def sine_and_cosine(x: Real) -> tuple[Real, Real]:
    """Return sin x and cos x with errors of about 1e-16, for angles up to thousands of turns."""
    s, c, odd, sign = _reduced(x)
    even = 1.0 - odd * odd
    return sign * (even * s + odd * c), sign * (even * c - odd * s)


# --- Exponentials, logarithms and roots -----------------------------------------------------------

E2, E3, E4, E5, E6, E7, E8, E9, E10, E11, E12, E13, E14 = elementary.EXP
A1, A2, A3, A4, A5, A6, A7, A8, A9, A10, A11, A12 = elementary.ATANH


@inlined_by_llvm
def exponential(x: Real) -> Real:
    """Return e^x with a relative error of about 1e-16; 0 or infinity if x is out of range."""
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
def logarithm_and_inverse(x: Real) -> tuple[Real, Real]:
    """Return log(x), with error about 1e-16 for normal x > 0 and NaN for x <= 0, and 1 / x."""
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
def root_and_inverse(x: Real) -> tuple[Real, Real]:
    """Return the square root of x and its inverse."""
    root = square_root(x)
    return root, 1.0 / root
