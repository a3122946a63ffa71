"""A proven bound of the distance between a curve of integers and the true solution, by frames.

Where errors grow so fast that no norm bounds them usefully (large data, chaos), the linearised flow
is followed instead, as by R. J. Lohner (1988). The curve p is that of `fixed_point`, on half of a
chain; u is the solution of (4) with the printed decimals. The error e = u - p obeys

    e' = J e - i (r - d),   J e = -i (L e + DN(p) e),

where d is the defect of p, and r what the cubic term has beyond first order in e. Norms |.| are
those of all real numbers of half of a chain; the norm over the whole chain is at most sqrt(2) times
as large, as each site but n = 0 counts twice.

Between two frames e = M z + w, where z is a constant vector of real numbers, M(tau) any matrix
whose columns are states, and w the rest, zero at first. M is continued as polynomials with doubles
as coefficients, which nearly solve M' = J M. From the equation of e,

    |w|' <= mu |w| + |J M - M'| |z| + |r| + |d|,   mu = 2 |gamma| + |epsilon| / 2 + a^2 / 2, (i)

where a is the largest |A_n| of p over the step. For mu: Re <w, J w> has Im <w, L w> + Im <w, DN w>;
gamma conj(b - a) gives at most 2 |gamma| |w|^2; of epsilon's bonds those between the sites 0 and 1
are 2 one way and 1 the other, so |epsilon| |w_0| |w_1| <= |epsilon| |w|^2 / 2 is left; and of DN w
= |A|^2 w + A^2 conj(w) / 2 only the second part counts. By (i) |w| at the end of a step h is at
most e^(mu h) times the sum of |w| at its start and of the integrals of the other terms.

A new frame. Its columns are those of any matrix Q, nearly orthogonal: |Q^T Q - I| <= eta < 1/2.
With G = Q^T Q, e = Q z' holds for z' = G^-1 (Q^T M z + Q^T w), and |G^-1 x - x| <= eta / (1 - eta)
|x|, |Q^T w| <= sqrt(1 + eta) |w|. So, with R = Q^T M and y_i = sum of |R_ij| |z_j|,

    |z'_i| <= y_i + sqrt(1 + eta) |w| + eta / (1 - eta) (|y| + sqrt(1 + eta) |w|).

R and Q^T Q are computed in doubles. Each entry is a sum of n = 4 (M + 1) products, off by at most
gamma_n = n u / (1 - n u) times the product of the two columns' norms, in whatever order it is taken
(N. J. Higham, Accuracy and Stability of Numerical Algorithms, 2nd ed. (2002), section 3.1).

The tangent polynomials. With S_i and P_i the coefficients of |A|^2 and A^2, computed from the
doubles nearest to those of p, T_{k+1} = h F_k / (k + 1), where F_k is -i times L T_k + sum over i
<= k of (S_i T_{k-i} + P_i conj(T_{k-i}) / 2). The sum has all i, beyond the order of p as well: S
and P have twice the order of p, which may be smaller than that of T. So what T misses of M' = J M
has the coefficients, over theta,

- for k below the order K of T: rounding only. The terms go through 4 K + 16 roundings at most: one
  of the coefficients and one of a constant, the product of two and its sum over up to K + 1
  products and two parts, S + P / 2, the product with T, the sum over K + 1 terms of two parts, the
  linear terms (9), step, quotient. Their absolute values sum to at most h (lambda t_k + 2 sum of
  s_i t_{k-i}), where t_k is the Frobenius norm of T_k, s_i = sum of a_j a_{i-j}, a_j the largest
  |p_j| of a site, and lambda = 5 |epsilon| + |Omega| + 2 |gamma| (rows of the bonds sum to 4,
  columns to 5 at most).
- for k from K on: at most h (lambda t_K [k = K] + (3/2) sum of s_i t_{k-i}).

Their integrals over theta are a (k + 1)th of that. M at the end is the rounded sum of its
coefficients, off by at most gamma_{K+1} times the sum of t_k: it is added to w times |z|.

The quadratic term. From |A + e|^2 (A + e) - |A|^2 A less its terms of first order,
2 Re(conj(A) e) e + |e|^2 A + |e|^2 e, follows |r| <= (3 a y + y^2) y / 2 where |e| <= y. A trial is
taken, which is |w| from (i) without r and a thousandth of all that |e| may be, and (i) with r must
come out below it. Then |w| stays below the trial over the whole step, since it is continuous, and
|e| below y = the trial + (sum of t_k) |z|.

The parts of the bound grow alike, so they are carried side by side: the bounds of |z_i| and |w| are
sums over parts. One more part, which belongs to no error, is a unit error at the start: the
order of the columns in a new frame depends on it.

Rounding of the bound itself: it uses only + - * / and roots of numbers that are not negative, of
fewer than a million roundings in a step, which the factor `UP` covers; TINY covers what underflow
may lose.
"""

from fractions import Fraction
from math import sqrt
from typing import NamedTuple

import numpy as np

from pendula.problem import Problem

from .fixed_point import (
    UP,
    FixedPointChain,
    Step,
    defect,
    doubles,
    end,
    follow,
    half_chain,
    jump,
    start,
    whole,
)

UNIT = 2.0**-53
TINY = 1e-140
"""More than what any number of this module that underflows can have lost."""
ORDER = 24
"""Order of the tangent polynomials; what they leave out is as small as rounding."""
DIGITS = 20
"""Binary digits that a bound is kept with."""
SLACK = 2.0**-10
"""The part of an error that the quadratic term may add to it over a step."""
UNIT_ERROR = 3
"""The place of the unit error among the parts that grow: start, defect, quadratic term, and it."""


class Certified(NamedTuple):
    """Norms of the curve at the output times, with a bound of their distance to the true ones."""

    tau: np.ndarray  # (time,)
    linf: np.ndarray  # (component, time)
    l2: np.ndarray  # (component, time)
    parts: np.ndarray  # (part, time): start, defect, quadratic term, and rounding of the outputs

    @property
    def bound(self) -> np.ndarray:
        """The bound of the distance of the states, (time,), the sum of its parts rounded up."""
        return UP * np.sum(self.parts, axis=0)


class Tube(NamedTuple):
    """Where the error is: e = matrix z + w, with bounds of |z_i| and |w| by part."""

    matrix: np.ndarray  # (part of a complex number, component, site, column)
    z: np.ndarray  # (column, part)
    w: np.ndarray  # (part,)


def begin(chain: FixedPointChain, off: float) -> Tube:
    """Return the tube around the start, which is `off` by the rounding of the data."""
    size = 4 * chain.sites
    z = np.zeros((size, UNIT_ERROR + 1))
    z[:, 0], z[:, UNIT_ERROR] = off, 1.0 / sqrt(size)
    return Tube(np.eye(size).reshape(2, 2, chain.sites, size), z, np.zeros(UNIT_ERROR + 1))


def distances(tube: Tube) -> np.ndarray:
    """Return bounds of the distance over the whole chain, (part,)."""
    flat = np.abs(tube.matrix).reshape(len(tube.z), -1)
    reached = np.stack([np.sum(flat * own, axis=1) for own in tube.z.T], axis=1)
    found = UP * sqrt(2.0) * (np.sqrt(np.sum(reached**2, axis=0)) + tube.w)
    return np.where(np.isnan(found), np.inf, found)  # zero times infinity


# --- A step ---------------------------------------------------------------------------------------


def advance(
    tube: Tube, step: Step, chain: FixedPointChain, jumped: float, order: int = ORDER
) -> Tube:
    """Return the tube at the end of a step that starts `jumped` from where the tube is."""
    coefficients = doubles(step, chain)
    sizes = UP * np.sqrt(np.max(np.sum(coefficients**2, axis=1), axis=(1, 2))) + TINY
    h = float(chain.interval / step.pieces)
    terms = tangents(tube.matrix, coefficients, h, chain, order)
    norms = np.array([UP * sqrt(np.sum(term * term)) for term in terms])
    largest = UP * float(np.sum(sizes))
    rate = 2.0 * abs(chain.gamma) + 0.5 * abs(chain.epsilon)
    growth = exponential(UP * h * (float(rate) + 0.5 * largest * largest))
    z = UP * np.sqrt(np.sum(tube.z**2, axis=0))
    w = tube.w + UP * missed(norms, sizes, h, chain) * z
    w[1] += jumped + defect(step, chain)
    w *= UP * growth
    moved = UP * float(np.sum(norms) * np.sum(z[:3]))
    w[2] += _quadratic(float(np.sum(w[:3])), moved, largest, UP * growth * h)
    matrix = sum_up(terms)
    w += UP * (len(terms) + 1) * UNIT * np.sum(norms) * z
    return Tube(matrix, tube.z, UP * w)


def exponential(x: float) -> float:
    """Return an upper bound of e^x for 0 <= x <= 1: x^3 / 6 (1 + x/4 + x^2/20 + ...) <= x^3 / 4."""
    if not x <= 1.0:
        return np.inf
    return (1.0 + x + 0.5 * x * x + 0.25 * x * x * x) * (1.0 + 4.0 * UNIT)


def _quadratic(w: float, moved: float, largest: float, time: float) -> float:
    """Return what the quadratic term adds to |w| over a step, infinite if that is not small.

    `moved` bounds |M z|, and `time` e^(mu h) h.
    """
    trial = w + SLACK * (w + moved) + TINY
    y = UP * (trial + moved)
    added = UP * time * 0.5 * (3.0 * largest * y + y * y) * y
    return added if UP * (w + added) <= trial else np.inf


def tangents(
    matrix: np.ndarray, p: np.ndarray, h: float, chain: FixedPointChain, order: int
) -> list:
    """Return the tangent polynomials' coefficients, each of the shape of the matrix."""
    square, real, imaginary = products(p, order)
    plus, minus, across = square + 0.5 * real, square - 0.5 * real, 0.5 * imaginary
    terms = [matrix]
    for k in range(order):
        x, y = linear(terms[k], chain)
        for i in range(k + 1):
            own_x, own_y = terms[k - i]
            x += plus[i][..., None] * own_x
            x += across[i][..., None] * own_y
            y += across[i][..., None] * own_x
            y += minus[i][..., None] * own_y
        x *= -h
        y *= h
        x /= k + 1
        y /= k + 1
        terms.append(np.stack([y, x]))  # -i (x + i y) = y - i x
    return terms


def products(p: np.ndarray, count: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return so many coefficients of |A|^2 and of both parts of A^2, (order, component, site)."""
    p = np.concatenate([p[:count], np.zeros((max(count - len(p), 0), *p.shape[1:]))])
    square, real, imaginary = np.zeros((3, count, *p.shape[2:]))
    for k in range(count):
        own, other = p[: k + 1], p[k::-1]
        xx, yy = np.sum(own[:, 0] * other[:, 0], axis=0), np.sum(own[:, 1] * other[:, 1], axis=0)
        square[k], real[k] = xx + yy, xx - yy
        imaginary[k] = 2.0 * np.sum(own[:, 0] * other[:, 1], axis=0)
    return square, real, imaginary


def linear(values: np.ndarray, chain: FixedPointChain) -> np.ndarray:
    """Return the linear terms of (4) on half of a chain, (part, component, site, column)."""
    epsilon, gamma, omega = map(float, (chain.epsilon, chain.gamma, chain.omega))
    both = np.zeros_like(values)
    both[:, :, :-1] += values[:, :, 1:]
    both[:, :, 1:] += values[:, :, :-1]
    if chain.sites > 1:
        both[:, :, 0] *= 2.0
    drive = np.array([gamma, -gamma])[:, None, None, None]
    found = epsilon * (both - 2.0 * values) + omega * values
    return found + drive * (values[:, ::-1] - values)


def missed(norms: np.ndarray, sizes: np.ndarray, h: float, chain: FixedPointChain) -> float:
    """Return a bound of the integral of |J M - M'| over a step."""
    order = len(norms) - 1
    squares = np.zeros(2 * len(sizes) - 1)
    for j, size in enumerate(sizes):
        squares[j : j + len(sizes)] += size * sizes
    cubes = np.zeros(len(squares) + order)
    for j, norm in enumerate(norms):
        cubes[j : j + len(squares)] += norm * squares
    strength = float(5 * abs(chain.epsilon) + abs(chain.omega) + 2 * abs(chain.gamma))
    found = 1.5 * cubes
    found[order] += strength * norms[order]
    rounded = strength * norms[:order] + 2.0 * cubes[:order]
    found[:order] = (4 * order + 16) * UNIT * rounded
    return UP * h * float(np.sum(found / np.arange(1, len(found) + 1)))


def sum_up(terms: list) -> np.ndarray:
    """Return the sum of all terms, the small ones first."""
    total = terms[-1].copy()
    for term in terms[-2::-1]:
        total += term
    return total


# --- A new frame ----------------------------------------------------------------------------------


def reframe(tube: Tube) -> Tube:
    """Return the same tube with columns that are nearly orthogonal."""
    size = len(tube.z)
    matrix = tube.matrix.reshape(size, size)
    lengths = np.sqrt(np.sum(matrix**2, axis=0))
    order = np.argsort(-lengths * np.sum(tube.z, axis=1), kind="stable")
    frame = orthogonal(matrix[:, order])
    gamma = UP * size * UNIT
    own, others = (UP * np.sqrt(np.sum(m * m, axis=0)) for m in (frame, matrix))
    gram = times(frame, frame) - np.eye(size)
    eta = UP * (sqrt(np.sum(gram * gram)) + 2.0 * gamma * float(np.sum(own * own)))
    if not eta < 0.5:
        return tube._replace(z=np.full_like(tube.z, np.inf))
    turned = np.abs(times(frame, matrix)) + gamma * own[:, None] * others
    y = UP * np.stack([np.sum(turned * part, axis=1) for part in tube.z.T], axis=1)
    w = UP * sqrt(1.0 + eta) * tube.w
    slack = eta / (1.0 - eta) * (np.sqrt(np.sum(y * y, axis=0)) + w)
    z = UP * (y + w + UP * slack) + TINY
    return Tube(frame.reshape(tube.matrix.shape), z, np.zeros_like(tube.w))


def orthogonal(matrix: np.ndarray) -> np.ndarray:
    """Return orthonormal columns by the modified method of Gram and Schmidt, done twice."""
    rows = matrix.T.copy()
    for _ in range(2):
        for j, row in enumerate(rows):
            row /= np.sqrt(np.sum(row * row))
            below = rows[j + 1 :]
            below -= np.sum(below * row, axis=1)[:, None] * row
    return np.ascontiguousarray(rows.T)


def times(left: np.ndarray, right: np.ndarray) -> np.ndarray:
    """Return left^T right as plain sums, which have the same bits whatever BLAS is there."""
    total = np.zeros((left.shape[1], right.shape[1]))
    for row, other in zip(left, right, strict=True):
        total += row[:, None] * other
    return total


# --- The curve at its outputs ---------------------------------------------------------------------


def certify(problem: Problem, bits: int, order: int, outputs_per_frame: int) -> Certified:
    """Return the curve at the outputs, with its proven distance to the solution.

    The coefficients are in units of 2^-bits, and the polynomials of the given order. Raises
    NotEvenError and StepError.
    """
    chain = half_chain(problem, bits)
    state, off = start(problem, chain)
    tube = begin(chain, off)
    steps_between = follow(state, chain, order)
    states, parts = [], []
    for count, tau in enumerate(problem.times.tolist()):
        for step in whole(next(steps_between)) if count else ():
            tube = advance(tube, step, chain, jump(state, step, chain))
            state = end(step.terms)
        half = np.array([[value / 2**bits for value in part] for part in state])
        half = half.reshape(2, 2, chain.sites)
        states.append(np.concatenate([half[..., :0:-1], half], axis=-1))
        grown = distances(tube)[:UNIT_ERROR]
        late = float(abs(Fraction(tau) - count * chain.interval))  # tau is a double
        parts.append(round_up([*grown, evaluation(states[-1], grown, chain, late)]))
        if count and count % outputs_per_frame == 0:
            tube = reframe(tube)
    return Certified(problem.times, *norms_of(np.array(states)), np.array(parts).T)


def evaluation(state: np.ndarray, parts: np.ndarray, chain: FixedPointChain, late: float) -> float:
    """Return how far outputs are off by rounding: of states and norms, and of their times.

    States to doubles, squares, the at most 16 levels of the sum, and the root are 12 roundings of
    the norm or fewer. Over `late` the solution moves by at most late |u'|, where
    |u'| <= (lambda + |u|^2 / 2) |u|, and |u| itself grows by no more than e^(2 |gamma| late), which
    `UP` covers.
    """
    strength = float(4 * abs(chain.epsilon) + abs(chain.omega) + 2 * abs(chain.gamma))
    norm = UP * sqrt(np.sum(state * state))
    near = norm + float(np.sum(parts))
    moved = UP * late * (strength + 0.5 * near * near) * near
    return UP * (12.0 * UNIT * norm + moved) + TINY


def norms_of(states: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return l-infinity and l2 norms, (component, time), of (time, part, component, site)."""
    squares = states[:, 0] ** 2 + states[:, 1] ** 2
    return np.sqrt(squares.max(axis=2)).T, np.sqrt(tree_sum(np.moveaxis(squares, 2, 0))).T


def tree_sum(values: np.ndarray) -> np.ndarray:
    """Return the sum over the first axis by halves, so that a term goes through few roundings."""
    while len(values) > 1:
        half = (len(values) + 1) // 2
        rest = values[half:]
        values = values[:half].copy()
        values[: len(rest)] += rest
    return values[0]


def round_up(values) -> np.ndarray:
    """Return numbers with DIGITS binary digits, rounded up."""
    mantissa, exponent = np.frexp(values)
    return np.ldexp(np.ceil(mantissa * 2.0**DIGITS), exponent - DIGITS)
