"""A proven bound of the distance between the curve of `fixed_point` and the true solution.

Errors of large or chaotic solutions grow so fast that no norm bounds them usefully. The bound
therefore follows the linearised flow, as in R. J. Lohner (1988). Let p be the curve, on half of a
chain, and u the solution of (4), i u' = L u + N(u), with the printed decimals as constants. L is
linear, and N is the cubic term. The error e = u - p obeys

    e' = J e - i (r - d),   J e = -i (L e + DN(p) e),

where d is the defect of p, and r has the terms of N(p + e) beyond first order in e. The l2 norms
|.| are over all real numbers of half of a chain. The norm over the whole chain is at most sqrt(2)
times as large, because each site except n = 0 counts twice.

Between two frames e = M z + w. Here z is a constant vector of real numbers, M(tau) is any matrix
with states as columns, and the remainder w is zero at first. M is continued as polynomials with
double coefficients, which solve M' = J M approximately. From the equation of e,

    |w|' <= mu |w| + |J M - M'| |z| + |r| + |d|,   mu = 2 |gamma| + |epsilon| / 2 + a^2 / 2, (i)

where a is the largest |A_n| or |B_n| of p over the step. Proof of mu: Re <w, J w> is
Im <w, L w> + Im <w, DN(p) w>. The drive in L contributes at most 2 |gamma| |w|^2. The bonds cancel,
except the bond of the sites 0 and 1. It counts twice in one direction and once in the other, and
contributes at most |epsilon| |w_0| |w_1| <= |epsilon| |w|^2 / 2. In DN(p) w =
|A|^2 w + A^2 conj(w) / 2 only the second term contributes, at most a^2 |w|^2 / 2. By (i) |w| at the
end of a step h is at most e^(mu h) times the sum of |w| at its start and of the integrals of the
other terms.

A new frame has the columns of any nearly orthogonal matrix Q: |Q^T Q - I| <= eta < 1/2. With
G = Q^T Q, e = Q z' holds for z' = G^-1 (Q^T M z + Q^T w), and |G^-1 x - x| <= eta / (1 - eta) |x|,
|Q^T w| <= sqrt(1 + eta) |w|. So, with R = Q^T M and y_i = sum of |R_ij| |z_j|,

    |z'_i| <= y_i + sqrt(1 + eta) |w| + eta / (1 - eta) (|y| + sqrt(1 + eta) |w|).

R and Q^T Q are computed in doubles. Each entry is a sum of n products, four for each site. Its
error is at most gamma_n = n UNIT / (1 - n UNIT) times the product of the two columns' norms, in any
order of the sum
(N. J. Higham, Accuracy and Stability of Numerical Algorithms, 2nd ed. (2002), section 3.1).

The tangent polynomials. Let S_i and P_i be the coefficients of |A|^2 and A^2, computed from those
of p rounded to doubles. Then T_{k+1} = h F_k / (k + 1), where F_k is -i times L T_k + sum over
i <= k of (S_i T_{k-i} + P_i conj(T_{k-i}) / 2). The sum includes i beyond the order of p, which may
be smaller than that of T, because S and P have twice the order of p. So the residual of T in
M' = J M has the coefficients, in powers of theta,

- for k below the order K of T: only rounding. Each term has at most 4 K + 16 roundings: of the
  coefficients, of a constant, of S and P (a product, and a sum over up to K + 1 products and two
  parts), of S + P / 2, of the product with T, of the sum over K + 1 terms of two parts, of the
  linear terms (9), of the factor h, and of the division. The absolute values of the terms sum to at
  most h (lambda t_k + 2 sum of s_i t_{k-i}). Here t_k is the Frobenius norm of T_k, s_i is the sum
  of a_j a_{i-j}, a_j is the largest |p_j| of any site, and lambda is
  5 |epsilon| + |Omega| + 2 |gamma|: rows of the bonds sum to at most 4, columns to at most 5.
- for k from K on: at most h (lambda t_K [k = K] + (3/2) sum of s_i t_{k-i}).

Integrated over theta, these bounds are divided by k + 1. M at the end of a step is the rounded sum
of its coefficients, with an error of at most gamma_{K+1} times the sum of t_k. This error times |z|
is added to w.

The quadratic term. |A + e|^2 (A + e) - |A|^2 A without its terms of first order is
2 Re(conj(A) e) e + |e|^2 A + |e|^2 e, so |r| <= (3 a y + y^2) y / 2 if |e| <= y. The trial bound of
|w| is |w| from (i) without r, plus SLACK times the bound of |e|. The bound of |w| from (i) with r
must be smaller than the trial. Then |w| stays below the trial over the whole step, because it is
continuous, and |e| stays below y = trial + (sum of t_k) |z|.

The contributions to the bound obey the same inequalities, so bounds of |z_i| and |w| are stored
separately for each contribution. An additional contribution is a unit error at the start. It is not
part of the bound, but determines the order of the columns in a new frame.

Rounding of the bound itself: the bound uses only + - * / and square roots of nonnegative numbers. A
step has fewer than a million roundings, which the factor `UP` covers; TINY covers losses by
underflow.
"""

from collections.abc import Callable, Sequence
from fractions import Fraction
from math import sqrt
from typing import NamedTuple

import numpy as np

from pendula.problem import PaperProblem

from .fixed_point import (
    UP,
    FixedPointChain,
    Step,
    as_doubles,
    bound_defect,
    bound_jump,
    evaluate_end,
    generate_steps,
    make_half_chain,
    require_full_interval,
    round_initial_data,
)

UNIT = 2.0**-53
TINY = 1e-140
"""Larger than all losses by underflow in this module."""
ORDER = 24
"""Order of the tangent polynomials; their truncation error is as small as rounding."""
DIGITS = 20
"""Binary digits of a stored bound."""
SLACK = 2.0**-10
"""The quadratic term may add at most this fraction of an error over a step."""
UNIT_ERROR = 3
"""Index of the unit error among the contributions: start, defect, quadratic term, unit error."""


class CertifiedCurve(NamedTuple):
    """Norms of the curve at the output times, with a bound of their errors."""

    tau: np.ndarray  # (time,)
    linf: np.ndarray  # (component, time)
    l2: np.ndarray  # (component, time)
    contributions: (
        np.ndarray
    )  # (contribution, time): start, defect, quadratic term, and rounding of the outputs

    @property
    def bound(self) -> np.ndarray:
        """The bound of the l2 error, (time,): the sum of contributions, rounded up."""
        return UP * np.sum(self.contributions, axis=0)


class Tube(NamedTuple):
    """An enclosure of the error e = matrix z + w: bounds of |z_i| and |w| by contribution."""

    matrix: np.ndarray  # (Re or Im, component, site, column)
    z: np.ndarray  # (column, contribution)
    w: np.ndarray  # (contribution,)


def make_initial_tube(chain: FixedPointChain, initial_error: float) -> Tube:
    """Return the tube at the start, around the rounding errors of the initial data."""
    size = 4 * chain.sites
    z = np.zeros((size, UNIT_ERROR + 1))
    z[:, 0], z[:, UNIT_ERROR] = initial_error, 1.0 / sqrt(size)
    return Tube(np.eye(size).reshape(2, 2, chain.sites, size), z, np.zeros(UNIT_ERROR + 1))


def bound_distances(tube: Tube) -> np.ndarray:
    """Return bounds of the l2 error on the whole chain, (contribution,)."""
    flat = np.abs(tube.matrix).reshape(len(tube.z), -1)
    entry_bounds = np.stack(
        [np.sum(flat * column_bounds, axis=1) for column_bounds in tube.z.T], axis=1
    )
    bounds = UP * sqrt(2.0) * (np.sqrt(np.sum(entry_bounds**2, axis=0)) + tube.w)
    return np.where(np.isnan(bounds), np.inf, bounds)  # zero times infinity


# --- A step ---------------------------------------------------------------------------------------


def advance_tube(
    tube: Tube, step: Step, chain: FixedPointChain, jump: float, order: int = ORDER
) -> Tube:
    """Return the tube at the end of a step; `jump` bounds the jump of the curve at its start."""
    coefficients = as_doubles(step, chain)
    sizes = UP * np.sqrt(np.max(np.sum(coefficients**2, axis=1), axis=(1, 2))) + TINY
    h = float(chain.interval / step.divisor)
    terms = make_tangents(tube.matrix, coefficients, h, chain, order)
    norms = np.array([UP * sqrt(np.sum(term * term)) for term in terms])
    largest = UP * float(np.sum(sizes))
    rate = 2.0 * abs(chain.gamma) + 0.5 * abs(chain.epsilon)
    growth = bound_exponential(UP * h * (float(rate) + 0.5 * largest * largest))
    z = UP * np.sqrt(np.sum(tube.z**2, axis=0))
    w = tube.w + UP * bound_tangent_defect(norms, sizes, h, chain) * z
    w[1] += jump + bound_defect(step, chain)
    w *= UP * growth
    mz_bound = UP * float(np.sum(norms) * np.sum(z[:3]))
    w[2] += _bound_quadratic_term(float(np.sum(w[:3])), mz_bound, largest, UP * growth * h)
    matrix = sum_terms(terms)
    w += UP * (len(terms) + 1) * UNIT * np.sum(norms) * z
    return Tube(matrix, tube.z, UP * w)


def bound_exponential(x: float) -> float:
    """Return an upper bound of e^x for 0 <= x <= 1: x^3 / 6 (1 + x/4 + x^2/20 + ...) <= x^3 / 4."""
    if not x <= 1.0:
        return np.inf
    return (1.0 + x + 0.5 * x * x + 0.25 * x * x * x) * (1.0 + 4.0 * UNIT)


def _bound_quadratic_term(w: float, mz_bound: float, largest: float, time: float) -> float:
    """Return a bound of the quadratic term's addition to |w| over a step, infinite if not small.

    `mz_bound` is a bound of |M z|, and `time` is a bound of e^(mu h) h.
    """
    trial = w + SLACK * (w + mz_bound) + TINY
    y = UP * (trial + mz_bound)
    added = UP * time * 0.5 * (3.0 * largest * y + y * y) * y
    return added if UP * (w + added) <= trial else np.inf


def make_tangents(
    matrix: np.ndarray, p: np.ndarray, h: float, chain: FixedPointChain, order: int
) -> list:
    """Return the coefficients of the tangent polynomials, each of the shape of `matrix`."""
    square, real, imaginary = multiply_series(p, order)
    plus, minus, across = square + 0.5 * real, square - 0.5 * real, 0.5 * imaginary
    terms = [matrix]
    for k in range(order):
        x, y = linear_terms(terms[k], chain)
        for i in range(k + 1):
            re, im = terms[k - i]
            x += plus[i][..., None] * re
            x += across[i][..., None] * im
            y += across[i][..., None] * re
            y += minus[i][..., None] * im
        x *= -h
        y *= h
        x /= k + 1
        y /= k + 1
        terms.append(np.stack([y, x]))  # -i (x + i y) = y - i x
    return terms


def multiply_series(p: np.ndarray, count: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return `count` coefficients of |A|^2, Re A^2 and Im A^2, each (order, component, site)."""
    p = np.concatenate([p[:count], np.zeros((max(count - len(p), 0), *p.shape[1:]))])
    square, real, imaginary = np.zeros((3, count, *p.shape[2:]))
    for k in range(count):
        forward, backward = p[: k + 1], p[k::-1]
        xx, yy = (
            np.sum(forward[:, 0] * backward[:, 0], axis=0),
            np.sum(forward[:, 1] * backward[:, 1], axis=0),
        )
        square[k], real[k] = xx + yy, xx - yy
        imaginary[k] = 2.0 * np.sum(forward[:, 0] * backward[:, 1], axis=0)
    return square, real, imaginary


def linear_terms(values: np.ndarray, chain: FixedPointChain) -> np.ndarray:
    """Return the linear terms of (4) on half of a chain, (Re or Im, component, site, column)."""
    epsilon, gamma, omega = map(float, (chain.epsilon, chain.gamma, chain.omega))
    neighbours = np.zeros_like(values)
    neighbours[:, :, :-1] += values[:, :, 1:]
    neighbours[:, :, 1:] += values[:, :, :-1]
    if chain.sites > 1:
        neighbours[:, :, 0] *= 2.0
    drive = np.array([gamma, -gamma])[:, None, None, None]
    terms = epsilon * (neighbours - 2.0 * values) + omega * values
    return terms + drive * (values[:, ::-1] - values)


def bound_tangent_defect(
    norms: np.ndarray, sizes: np.ndarray, h: float, chain: FixedPointChain
) -> float:
    """Return an upper bound of the integral of |J M - M'| over a step."""
    order = len(norms) - 1
    squares = np.zeros(2 * len(sizes) - 1)
    for j, size in enumerate(sizes):
        squares[j : j + len(sizes)] += size * sizes
    cubes = np.zeros(len(squares) + order)
    for j, norm in enumerate(norms):
        cubes[j : j + len(squares)] += norm * squares
    strength = float(5 * abs(chain.epsilon) + abs(chain.omega) + 2 * abs(chain.gamma))
    coefficients = 1.5 * cubes
    coefficients[order] += strength * norms[order]
    rounded = strength * norms[:order] + 2.0 * cubes[:order]
    coefficients[:order] = (4 * order + 16) * UNIT * rounded
    return UP * h * float(np.sum(coefficients / np.arange(1, len(coefficients) + 1)))


def sum_terms(terms: list) -> np.ndarray:
    """Return the sum of all terms, added from the last one, which is the smallest."""
    total = terms[-1].copy()
    for term in terms[-2::-1]:
        total += term
    return total


# --- A new frame ----------------------------------------------------------------------------------


def change_frame(tube: Tube) -> Tube:
    """Return a tube around the same errors that has a nearly orthogonal matrix."""
    size = len(tube.z)
    matrix = tube.matrix.reshape(size, size)
    lengths = np.sqrt(np.sum(matrix**2, axis=0))
    order = np.argsort(-lengths * np.sum(tube.z, axis=1), kind="stable")
    frame = orthogonalise(matrix[:, order])
    gamma = UP * size * UNIT
    frame_norms, matrix_norms = (UP * np.sqrt(np.sum(m * m, axis=0)) for m in (frame, matrix))
    gram = multiply_transposed(frame, frame) - np.eye(size)
    eta = UP * (sqrt(np.sum(gram * gram)) + 2.0 * gamma * float(np.sum(frame_norms * frame_norms)))
    if not eta < 0.5:
        return tube._replace(z=np.full_like(tube.z, np.inf))
    turned = (
        np.abs(multiply_transposed(frame, matrix)) + gamma * frame_norms[:, None] * matrix_norms
    )
    y = UP * np.stack(
        [np.sum(turned * column_bounds, axis=1) for column_bounds in tube.z.T], axis=1
    )
    w = UP * sqrt(1.0 + eta) * tube.w
    slack = eta / (1.0 - eta) * (np.sqrt(np.sum(y * y, axis=0)) + w)
    z = UP * (y + w + UP * slack) + TINY
    return Tube(frame.reshape(tube.matrix.shape), z, np.zeros_like(tube.w))


def orthogonalise(matrix: np.ndarray) -> np.ndarray:
    """Return orthonormal columns by the modified Gram-Schmidt method, applied twice."""
    rows = matrix.T.copy()
    for _ in range(2):
        for j, row in enumerate(rows):
            row /= np.sqrt(np.sum(row * row))
            below = rows[j + 1 :]
            below -= np.sum(below * row, axis=1)[:, None] * row
    return np.ascontiguousarray(rows.T)


def multiply_transposed(left: np.ndarray, right: np.ndarray) -> np.ndarray:
    """Return left^T right by plain sums: the bits of BLAS depend on the processor."""
    total = np.zeros((left.shape[1], right.shape[1]))
    for left_row, right_row in zip(left, right, strict=True):
        total += left_row[:, None] * right_row
    return total


# --- The curve at its outputs ---------------------------------------------------------------------


def certify(
    problem: PaperProblem,
    bits: int,
    order: int,
    outputs_per_frame: int,
    progress: Callable[[int, int], None] = lambda done, count: None,
) -> CertifiedCurve:
    """Return the curve at the outputs of a problem, with a proven bound of its error.

    The curve's polynomials have this order, and coefficients in units of 2^-bits. `progress` is
    called with the number of outputs done and of all outputs. Raises NotEvenError and StepError.
    """
    chain = make_half_chain(problem, bits)
    state, initial_error = round_initial_data(problem, chain)
    tube = make_initial_tube(chain, initial_error)
    steps_between = generate_steps(state, chain, order)
    states, contributions = [], []
    for count, tau in enumerate(problem.times.tolist()):
        for step in require_full_interval(next(steps_between)) if count else ():
            tube = advance_tube(tube, step, chain, bound_jump(state, step, chain))
            state = evaluate_end(step.terms)
        half = np.array([[value / 2**bits for value in row] for row in state])
        half = half.reshape(2, 2, chain.sites)
        states.append(np.concatenate([half[..., :0:-1], half], axis=-1))
        bounds = bound_distances(tube)[:UNIT_ERROR]
        delay = float(abs(Fraction(tau) - count * chain.interval))  # tau is a double
        contributions.append(
            round_up([*bounds, bound_output_error(states[-1], bounds, chain, delay)])
        )
        if count and count % outputs_per_frame == 0:
            tube = change_frame(tube)
        progress(count + 1, problem.times.size)
    return CertifiedCurve(
        problem.times, *compute_norms(np.array(states)), np.array(contributions).T
    )


def bound_output_error(
    state: np.ndarray, contributions: np.ndarray, chain: FixedPointChain, delay: float
) -> float:
    """Return a bound of the errors of outputs by rounding of states, norms and times.

    The norm has at most 12 roundings: those of states, of squares, of at most 16 levels of the sum,
    and of the root. Over `delay` the solution moves by at most delay |u'|, where |u'| is at most
    (4 |epsilon| + |Omega| + 2 |gamma| + |u|^2 / 2) |u|. In this time |u| grows at most by the
    factor e^(2 |gamma| delay), which `UP` covers.
    """
    strength = float(4 * abs(chain.epsilon) + abs(chain.omega) + 2 * abs(chain.gamma))
    norm = UP * sqrt(np.sum(state * state))
    near = norm + float(np.sum(contributions))
    motion = UP * delay * (strength + 0.5 * near * near) * near
    return UP * (12.0 * UNIT * norm + motion) + TINY


def compute_norms(states: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return l-infinity and l2 norms (component, time) of (time, Re or Im, component, site)."""
    squares = states[:, 0] ** 2 + states[:, 1] ** 2
    return np.sqrt(squares.max(axis=2)).T, np.sqrt(sum_pairwise(np.moveaxis(squares, 2, 0))).T


def sum_pairwise(values: np.ndarray) -> np.ndarray:
    """Return the sum over the first axis by halves, with few roundings of each term."""
    while len(values) > 1:
        half = (len(values) + 1) // 2
        second_half = values[half:]
        values = values[:half].copy()
        values[: len(second_half)] += second_half
    return values[0]


def round_up(values: Sequence[float]) -> np.ndarray:
    """Return the numbers rounded up to DIGITS binary digits."""
    mantissa, exponent = np.frexp(values)
    return np.ldexp(np.ceil(mantissa * 2.0**DIGITS), exponent - DIGITS)
