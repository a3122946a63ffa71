"""The norm in which errors hardly grow, and how fast they can grow in it.

The linear part of (4), i e' = L e, keeps H_2(e) = <e, L e>, the quadratic part of the energy (8),
where <x, y> is the real part of the sum of conj(x) y over both components and all sites. With
P = <e, e>, epsilon times the bonds lies between 0 and 4 epsilon P, and gamma Re (a - b)^2 between
-2 |gamma| P and 2 |gamma| P. So

    low P <= H_2(e) <= high P,   low = Omega - max(0, 4 epsilon) - 2 |gamma|,
                                 high = Omega - min(0, 4 epsilon) + 2 |gamma|,

for all ends of the chain. Where low > 0 or high < 0, Q(e) = |H_2(e)| is the square of a norm with

    m1 P <= Q(e) <= m2 P,   m1 = min(|low|, |high|),   m2 = max(|low|, |high|).

The rate of a state p. Along i e' = DN(p) e, the linearised cubic term, with
(DN(p) e)_n = |A_n|^2 e_n + A_n^2 conj(e_n) / 2, Q changes by 2 T(e),
T(e) = s <L e, -i DN(p) e>, where s is the sign of H_2. A `rate` is a number rho with T <= rho Q.

- Crude: |DN(p) e| <= (3/2) max |A_n|^2 |e|, and by Cauchy and Schwarz in the norm of Q
  T(e) <= sqrt(Q(e)) sqrt(Q(-i DN(p) e)) <= sqrt(m2) sqrt(Q(e)) (3/2) max |A_n|^2 |e|, so
  rho = (3/2) sqrt(m2 / m1) max |A_n|^2 is one.
- Sharp: rho is one if the symmetric matrix rho Q - T is positive semidefinite. In real coordinates
  (Re a, Im a, Re b, Im b), site after site, it is banded: on a chain with ends nothing stands
  further than BAND places beside the diagonal. Bisection between 0 and the crude rate looks for a
  small rho for which Cholesky's method, in double precision, succeeds on rho Q - T - c.

That success is a proof. If it runs to its end for a floating-point matrix M, there is a matrix
within |dM| <= gamma_7 |R^T| |R| of M, elementwise, that is R^T R (N. J. Higham, Accuracy and
Stability of Numerical Algorithms, 2nd ed. (2002), theorem 10.3; no entry takes more than BAND + 1
products), and |R^T| |R| <= max M_ii / (1 - gamma_7) elementwise. A row has 2 BAND + 1 entries, so
||dM|| <= 11 gamma_7 / (1 - gamma_7) max M_ii < 1e-14 max M_ii. The entries of M themselves are off
by their rounding, of no more than 30 operations each, and by that of the constants: together less
than 1e-13 times `scale` below, which bounds the sum of the absolute terms of an entry. So
c = 2^-40 scale covers both nine times over.
"""

from fractions import Fraction
from math import sqrt
from typing import NamedTuple

import numpy as np
from latticode.equations.ends import FREE, PERIODIC, kind_of

from pendula.problem import Constants, Problem

BAND = 5
"""Places beside the diagonal of rho Q - T that may hold a number."""
HALVINGS = 6
"""Halvings of the crude rate's interval; the sharp one is off by a 64th of the crude one."""
SMALLEST = 1e-100
"""Below this rate the entries of the matrix may underflow, and the crude rate is small enough."""
CHUNK = 512
"""States whose matrices are factorised at a time: as many as fit into the cache."""
UP = 1.0 + 1e-9
"""Sums and products of positive numbers, with fewer than a million roundings, times this are upper
bounds: 1e6 * 2^-53 < 1e-9."""


def up(roundings: int) -> float:
    """Return what makes an upper bound of a number that is the result of so many roundings."""
    return 1.0 + 1e-9 * (1 + roundings // 1_000_000)


class NotDefiniteError(ValueError):
    """The linear flow keeps no norm: Omega lies in the interval where Q is not definite."""


class Form(NamedTuple):
    """Bounds of Q: m1 P <= Q <= m2 P, exact; `sign` is that of H_2."""

    m1: Fraction
    m2: Fraction
    sign: int

    @property
    def condition(self) -> float:
        """Return an upper bound of sqrt(m2 / m1)."""
        return UP * sqrt(self.m2 / self.m1)


def decimal(x: float) -> Fraction:
    """Return the printed decimal that a double stands for: 1/10 for 0.1."""
    return Fraction(repr(float(x)))


def find_form(constants: Constants) -> Form:
    """Return the form of the printed constants; raises NotDefiniteError where it is none."""
    epsilon, gamma, omega = map(decimal, (constants.epsilon, constants.gamma, constants.omega))
    low = omega - max(0, 4 * epsilon) - 2 * abs(gamma)
    high = omega - min(0, 4 * epsilon) + 2 * abs(gamma)
    if low <= 0 <= high:
        raise NotDefiniteError(
            f"Omega = {float(omega):g} lies in [{float(omega - high):g}, {float(omega - low):g}], "
            "where no norm is kept: outside of it, with these epsilon and gamma, a bound exists"
        )
    return Form(min(abs(low), abs(high)), max(abs(low), abs(high)), 1 if low > 0 else -1)


def crude_rates(states: np.ndarray, form: Form) -> np.ndarray:
    """Return the crude rate of each state (state, part, component, site)."""
    squares = np.max(states[:, 0] ** 2 + states[:, 1] ** 2, axis=(1, 2))
    return UP * 1.5 * form.condition * squares


def find_rates(states: np.ndarray, problem: Problem, form: Form) -> np.ndarray:
    """Return a proven rate of each state (state, part, component, site).

    On a ring it is the crude one, since the matrix has entries in its corners there.
    """
    crude, constants = crude_rates(states, form), problem.constants
    if kind_of(problem.boundary) == PERIODIC:
        return crude
    size = abs(constants.omega) + 4 * abs(constants.epsilon) + 2 * abs(constants.gamma)
    found = crude.copy()
    for first in range(0, len(states), CHUNK):
        own = slice(first, first + CHUNK)
        quadratic, change = bands(states[own], problem, form)
        largest = np.max(states[own, 0] ** 2 + states[own, 1] ** 2, axis=(1, 2))
        low, high = np.zeros(len(largest)), np.ones(len(largest))
        for _ in range(HALVINGS):
            middle = 0.5 * (low + high)
            rates = middle * crude[own]
            shift = 2.0**-40 * size * (rates + 1.5 * largest)
            proven = _is_positive(rates * quadratic - change, shift)
            low, high = np.where(proven, low, middle), np.where(proven, middle, high)
        found[own] *= np.where(crude[own] > SMALLEST, high, 1.0)
    return UP * found


def _is_positive(band: np.ndarray, shift: np.ndarray) -> np.ndarray:
    """Return where Cholesky's method succeeds on a band (column, place below it, state), shifted.

    The band is overwritten.
    """
    positive = np.ones(band.shape[2], bool)
    for j in range(len(band)):
        pivot = band[j, 0] - shift
        positive &= pivot > 0.0
        column = np.where(positive, band[j, 1:], 0.0) / np.sqrt(np.where(positive, pivot, 1.0))
        for r in range(min(BAND, len(band) - 1 - j)):
            band[j + 1 + r, : BAND - r] -= column[r] * column[r:]
    return positive


def bands(states: np.ndarray, problem: Problem, form: Form) -> tuple[np.ndarray, np.ndarray]:
    """Return the bands of Q, (column, place, 1), and of T, (column, place, state).

    With the matrix S of <e, L e> and V of -i DN(p), T is the symmetric part of S V, times the sign.
    S has epsilon between neighbours, and on a site Omega - 2 epsilon (one epsilon less at a free
    end) and the drive. V acts on each site and component by itself.
    """
    sign, sites = form.sign, states.shape[-1]
    epsilon, gamma, omega = problem.constants
    s = np.zeros((4, 4, sites, 1))  # on each site, (row, column, site, 1)
    own = np.full(sites, omega - 2.0 * epsilon)
    if kind_of(problem.boundary) == FREE:
        own[0] += epsilon
        own[-1] += epsilon
    for row, drive in enumerate((gamma, -gamma, gamma, -gamma)):
        s[row, row, :, 0] = own - drive
        s[row, (row + 2) % 4, :, 0] = drive
    x, y = (np.moveaxis(states[:, part], 0, -1) for part in (0, 1))  # (component, site, state)
    square, real, imaginary = x * x + y * y, x * x - y * y, 2.0 * x * y
    v = np.zeros((4, 4, *x.shape[1:]))  # on each site, (row, column, site, state)
    for c in (0, 1):
        v[2 * c, 2 * c] = 0.5 * imaginary[c]
        v[2 * c, 2 * c + 1] = square[c] - 0.5 * real[c]
        v[2 * c + 1, 2 * c] = -(square[c] + 0.5 * real[c])
        v[2 * c + 1, 2 * c + 1] = -0.5 * imaginary[c]
    product = sum(s[:, k, None] * v[None, k] for k in range(4))
    quadratic = np.zeros((4 * sites, BAND + 1, 1))
    change = np.zeros((4 * sites, BAND + 1, len(states)))
    for j in range(4):
        for i in range(4):
            if i >= j:
                quadratic[j::4, i - j] = sign * s[i, j]
                change[j::4, i - j] = 0.5 * sign * (product[i, j] + product[j, i])
            if 4 + i - j <= BAND and sites > 1:
                between = v[i, j, :-1] + v[j, i, 1:]
                change[j : 4 * (sites - 1) : 4, 4 + i - j] = 0.5 * sign * epsilon * between
        quadratic[j : 4 * (sites - 1) : 4, 4] = sign * epsilon
    return quadratic, change
