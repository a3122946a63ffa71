"""A proven bound of the distance between a computed curve and the true solution, where Q is a norm.

The curve p is a polynomial in each step, whose coefficients are doubles; u is the solution of (4)
on the same chain with the printed decimals as constants and data. Within a step e = u - p obeys
i e' = L e + DN(p) e + r - d: the defect d = i p' - F(p) is what p misses of (4), and r is what the
cubic term has beyond first order in e. With the norm, form and rates of `norm`, E = sqrt(Q(e)) has

    E' <= rho E + sqrt(m2) (|d| + |r|),                                                        (i)

since Q' = 2 T(e) + 2 s <L e, -i (r - d)>, and <L e, x> <= sqrt(Q(e)) sqrt(Q(x)) by Cauchy and
Schwarz, Q(x) <= m2 |x|^2. Norms |.| are l2 over both components and all sites. At the start of a
step E rises by at most sqrt(m2) times the jump of p, and |e| <= E / sqrt(m1) at the end of it all.

Inequality (i) lets each of these parts grow alike, so that their sum is the bound:

- start: the doubles next to the printed data.
- polynomial: the terms of d that a polynomial of finite order leaves out.
- rounding: the other terms of d, which would vanish if its coefficients were exact.
- jumps: from the end of a step to the state that begins the next, which is rounded.
- quadratic: r. From |A + e|^2 (A + e) - |A|^2 A less its terms of first order,
  2 Re(conj(A) e) e + |e|^2 A + |e|^2 e, follows |r| <= (3 a y + y^2) y / 2 where |e| <= y and
  |A_n| <= a. A trial y above what is known at the start of an interval is taken, and E at its end
  must come out below it; then E stays below on the whole interval, as it is continuous there.
- evaluation: from the curve to the numbers that are stored, which are rounded. It does not grow.

The defect. With theta in [0, 1] over a step h, the coefficients R_k of h d are
R_k = i (k + 1) p_{k+1} - h F_k, where F_k is that of F(p), and the integral of |d| over the step is
at most the sum of |R_k| / (k + 1). Let a_k be the largest |p_k| of a site and b_k = |p_k|.

- For k >= K, the order of p, only F_k is left, and |F_k| <= lambda b_k [k = K] +
  (1/2) sum of a_i a_j b_l over i + j + l = k, with lambda = 4 |epsilon| + |Omega| + 2 |gamma|.
- For k < K, R_k is computed. A sum of products whose terms go through m roundings each is off by at
  most gamma_m = m u / (1 - m u) times the sum of the absolute terms, u = 2^-53 (Higham, section
  3.1). The terms of the linear part go through 9 roundings at most (with one that turns the decimal
  of a constant into a double), their absolute values sum to at most lambda b_k; those of the cubic
  part through 2 k + 10, and sum to at most the sum of a_i a_j b_l above (|x x'| + |y y'| <= |p||p'|
  for the parts of p = x + i y); (k + 1) p_{k+1} through 3.

The rate over time. Matrices T are linear in |A_n|^2 and A_n^2. Between two times delta apart these
differ from their linear interpolation by at most delta^2 / 8 times their largest second derivative,
2 (|A'|^2 + |A| |A''|). Where rho_1 Q - T_1 and rho_2 Q - T_2 are positive semidefinite, so is the
interpolation between them, and what is left changes T by at most (3/2) sqrt(m2 / m1) eta Q, eta
being that difference: by (|x_n| + |x_n| / 2) eta for each site. So the integral of rho over the
interval is at most delta ((rho_1 + rho_2) / 2 + (3/2) sqrt(m2 / m1) eta). To eta comes what the
states of the two times are off: their rounding, and the jump at the end of a step.

Rounding of the bound itself: it uses only + - * / and roots of numbers that are
not negative, of fewer than a million roundings in a row, which the factor `UP` covers. In the sum
over all steps there may be more, and `up` covers them. TINY covers what underflow may lose.
"""

from fractions import Fraction
from math import sqrt
from typing import NamedTuple

import numpy as np

from pendula.problem import Problem

from .norm import UP, Form, decimal, find_form, find_rates, up
from .polynomials import Curve, add_up, linear

UNIT = 2.0**-53
TINY = 1e-140
"""More than what any number of this module that underflows can have lost."""
PARTS = ("start", "polynomial", "rounding", "jumps", "quadratic", "evaluation")
GROWING = PARTS[:-1]
SAMPLES = 4
"""Intervals of a step between whose ends the rate is interpolated."""
LINEAR_ROUNDINGS = 9


class Certified(NamedTuple):
    """Norms of the curve at the output times, with a bound of their distance to the true ones."""

    tau: np.ndarray  # (time,)
    linf: np.ndarray  # (component, time)
    l2: np.ndarray  # (component, time)
    parts: np.ndarray  # (part, time), in the order of PARTS
    states: np.ndarray  # (time, part of a complex number, component, site)

    @property
    def bound(self) -> np.ndarray:
        """The bound of the distance of the states, (time,), the sum of its parts rounded up."""
        return UP * np.sum(self.parts, axis=0)


class Proof(NamedTuple):
    """A curve, and how far it can be from the solution of its problem."""

    curve: Curve
    errors: np.ndarray  # in the l2 norm, (step, end of interval, part), parts as in GROWING


def prove(problem: Problem, curve: Curve) -> Proof:
    """Return the proven distance of a curve to the solution; raises NotDefiniteError."""
    form = find_form(problem.constants)
    sizes = _sizes(curve)
    growth = _growth(curve, problem, form, sizes)
    inputs = {
        "start": _start(curve, problem),
        "polynomial": _left_out(sizes, problem, curve.step),
        "rounding": _rounding(curve, problem, sizes),
        "jumps": _jumps(curve, sizes),
    }
    errors = _accumulate(inputs, growth, sizes, form, curve.step)
    return Proof(curve, UP * errors / sqrt(form.m1))


def leave_unproved(curve: Curve) -> Proof:
    """Return an infinite distance, for problems whose linear flow conserves no norm."""
    steps = curve.terms.shape[1]
    errors = np.full((steps, SAMPLES + 1, len(GROWING)), np.inf)
    return Proof(curve, errors)


class Sizes(NamedTuple):
    """Upper bounds of the terms of each step, (order, step)."""

    largest: np.ndarray  # of the modulus on a site
    norm: np.ndarray  # of the l2 norm
    modulus: np.ndarray  # of the modulus on each site, (order, step, component, site)


def _sizes(curve: Curve) -> Sizes:
    squares = curve.terms[:, :, 0] ** 2 + curve.terms[:, :, 1] ** 2
    modulus = UP * np.sqrt(squares) + TINY
    return Sizes(modulus.max(axis=(2, 3)), _norms(curve.terms, 2), modulus)


def _norms(values: np.ndarray, first: int) -> np.ndarray:
    """Return upper bounds of the l2 norm over the axes from `first` on."""
    flat = values.reshape(*values.shape[:first], -1)
    return UP * np.sqrt(np.sum(flat * flat, axis=-1)) + TINY


def _gamma(roundings: int) -> float:
    return UP * roundings * UNIT


def _strength(problem: Problem) -> float:
    """Return lambda, a bound of the linear part of (4)."""
    constants = problem.constants
    return UP * (4 * abs(constants.epsilon) + abs(constants.omega) + 2 * abs(constants.gamma))


# --- What enters the bound ------------------------------------------------------------------------


def _start(curve: Curve, problem: Problem) -> np.ndarray:
    """Return the distance of the curve's start from the printed data, in the first step alone."""
    given = np.stack([problem.amplitudes.real, problem.amplitudes.imag])
    pairs = zip(given.ravel(), curve.terms[0, 0].ravel(), strict=True)
    off = sum((decimal(x) - Fraction(float(start))) ** 2 for x, start in pairs)
    entering = np.zeros(curve.terms.shape[1])
    entering[0] = UP * sqrt(off)
    return entering


def _jumps(curve: Curve, sizes: Sizes) -> np.ndarray:
    """Return the jump at the start of each step, after the first.

    The sum of a step's terms is first + second of `add_up`, but for errors of errors: of the sum of
    at most K + 1 errors, each at most u times a sum of the terms.
    """
    first, second = add_up(curve.terms[:, :-1])
    jump = (curve.terms[0, 1:] - first) - second
    rest = (len(curve.terms) * UNIT) ** 2 * np.sum(sizes.norm[:, :-1], axis=0)
    found = _norms(jump, 1) * (1.0 + 4.0 * UNIT) + 4.0 * rest
    return np.concatenate([[0.0], UP * found])


def _cubic(sizes: Sizes) -> np.ndarray:
    """Return half of the sum of a_i a_j b_l over i + j + l = k, for all k to 3 K, (k, step)."""
    count, steps = sizes.norm.shape
    squares = np.zeros((2 * count - 1, steps))
    cubes = np.zeros((3 * count - 2, steps))
    for k in range(count):
        squares[k : k + count] += sizes.largest[k] * sizes.largest
    for k in range(count):
        cubes[k : k + len(squares)] += sizes.norm[k] * squares
    return 0.5 * UP * cubes


def _left_out(sizes: Sizes, problem: Problem, step: float) -> np.ndarray:
    """Return the integral over each step of the defect's terms of the orders K and above."""
    order = len(sizes.norm) - 1
    terms = _cubic(sizes)[order:]
    terms[0] += _strength(problem) * sizes.norm[order]
    shares = 1.0 / np.arange(order + 1, order + 1 + len(terms))
    return UP * step * np.sum(terms * shares[:, None], axis=0)


def _rounding(curve: Curve, problem: Problem, sizes: Sizes) -> np.ndarray:
    """Return the integral over each step of the defect's terms of the orders below K."""
    terms, step, cubic = curve.terms, curve.step, _cubic(sizes)
    half_squares = np.empty((len(terms) - 1, terms.shape[1], 1, *terms.shape[3:]))
    total = np.zeros(terms.shape[1])
    for k in range(len(terms) - 1):
        half_squares[k] = _half_square(terms, k)
        cube = sum(half_squares[j] * terms[k - j] for j in range(k + 1))
        field = step * (linear(terms[k], problem) + cube)
        following = (k + 1) * terms[k + 1]
        # i (x + i y) = -y + i x
        missed = np.stack([-following[:, 1], following[:, 0]], axis=1) - field
        off = _gamma(LINEAR_ROUNDINGS) * _strength(problem) * step * sizes.norm[k]
        off += _gamma(2 * k + 10) * step * cubic[k] + _gamma(3) * (k + 1) * sizes.norm[k + 1]
        total += (_norms(missed, 1) + off) / (k + 1)
    return UP * total


def _half_square(terms: np.ndarray, k: int) -> np.ndarray:
    """Return the coefficient k of |A|^2 / 2, (step, 1, component, site); equal products once."""
    total = np.zeros_like(terms[0])
    for j in range((k + 1) // 2):
        total += terms[j] * terms[k - j]
    if k % 2 == 0:
        total += 0.5 * (terms[k // 2] * terms[k // 2])
    return total[:, :1] + total[:, 1:]


# --- How errors grow ------------------------------------------------------------------------------


def _growth(curve: Curve, problem: Problem, form: Form, sizes: Sizes) -> np.ndarray:
    """Return bounds of the integral of the rate over each interval, (interval,)."""
    states = sample(curve)
    rates = find_rates(states, problem, form)
    delta = curve.step / SAMPLES
    a0 = np.sum(sizes.modulus, axis=0)
    orders = np.arange(len(curve.terms))
    a1 = np.sum(orders[:, None, None, None] * sizes.modulus, axis=0) / curve.step
    a2 = np.sum((orders * (orders - 1))[:, None, None, None] * sizes.modulus, axis=0)
    a2 = a2 / curve.step**2
    bend = delta**2 / 8.0 * 2.0 * np.max(a1 * a1 + a0 * a2, axis=(1, 2))
    largest = np.max(a0, axis=(1, 2))
    # states are off by the rounding of their sums, and the last of a step by the jump behind it
    off = 2.0**-44 * np.sum(sizes.norm, axis=0)
    off = off + np.append(_jumps(curve, sizes)[1:], 0.0)
    eta = bend + 2.0 * largest * off + off * off
    extra = np.repeat(1.5 * form.condition * eta, SAMPLES)
    return UP * delta * (0.5 * (rates[:-1] + rates[1:]) + extra)


def sample(curve: Curve) -> np.ndarray:
    """Return the states at the ends of all intervals, (interval + 1, part, component, site)."""
    inner = [evaluate(curve.terms, i / SAMPLES)[0] for i in range(SAMPLES)]
    states = np.stack(inner, axis=1).reshape(-1, *curve.terms.shape[2:])
    return np.concatenate([states, add_up(curve.terms[:, -1:])[0]])


def evaluate(terms: np.ndarray, theta) -> tuple[np.ndarray, np.ndarray]:
    """Return the polynomials at theta, and a bound of the rounding error of each number.

    By Horner's rule b_k = p_k + theta b_{k+1}. Both operations add at most u times their result,
    and theta <= 1 carries the error of b_{k+1} on.
    """
    value, error = terms[-1], np.zeros_like(terms[-1])
    for term in terms[-2::-1]:
        product = theta * value
        value = term + product
        error = theta * error + (np.abs(product) + np.abs(value))
    return value, UP * UNIT * error


def exponential(x: float) -> float:
    """Return an upper bound of e^x for 0 <= x <= 1: x^3 / 6 (1 + x/4 + x^2/20 + ...) <= x^3 / 4."""
    if not x <= 1.0:
        return np.inf
    return (1.0 + x + 0.5 * x * x + 0.25 * x * x * x) * (1.0 + 4.0 * UNIT)


def _accumulate(inputs, growth: np.ndarray, sizes: Sizes, form: Form, step: float) -> np.ndarray:
    """Return E in its growing parts at the ends of all intervals, (step, SAMPLES + 1, part).

    What enters in a step counts from its start, which is no less than when it enters.
    """
    m1, m2 = (UP * sqrt(m) for m in (form.m1, form.m2))
    low = m1 / UP**2
    entering = UP * m2 * np.stack([inputs[name] for name in GROWING[:-1]], axis=1)
    largest = np.sum(sizes.modulus, axis=0).max(axis=(1, 2))
    factors = [exponential(x) for x in growth.tolist()]
    enough = up(4 * len(factors))  # an interval adds four roundings or fewer
    errors = np.empty((len(entering), SAMPLES + 1, len(GROWING)))
    error = np.zeros(len(GROWING))
    for j, added in enumerate(entering):
        error[:-1] += added
        errors[j, 0] = error
        for i in range(SAMPLES):
            factor = factors[j * SAMPLES + i]
            trial = factor * float(np.sum(error)) * (1.0 + 2.0**-20) + TINY
            y = trial / low
            rest = m2 * 0.5 * (3.0 * largest[j] * y + y * y) * y * step / SAMPLES
            error = factor * error
            error[-1] += factor * rest
            if not enough * np.sum(error) <= trial:
                error = np.full(len(GROWING), np.inf)
            errors[j, i + 1] = error
    return enough * errors


# --- The curve at the output times ----------------------------------------------------------------


def norms_at(proof: Proof, tau: np.ndarray) -> Certified:
    """Return the norms at any times of the run, and the parts of their bound."""
    # Exact: the step is a power of two. A time and the start of its step, if that is not zero, are
    # within a factor of two (P. H. Sterbenz, Floating-Point Computation, 1974).
    step, steps = proof.curve.step, proof.curve.terms.shape[1]
    index = np.minimum((tau / step).astype(int), steps - 1)
    theta = (tau - index * step) / step
    interval = np.ceil(theta * SAMPLES).astype(int)
    states, off = evaluate(proof.curve.terms[:, index], theta[:, None, None, None])
    parts = np.empty((len(PARTS), len(tau)))
    parts[:-1] = proof.errors[index, interval].T
    # squares, the at most 16 levels of the sum, and the root: 12 roundings of the norm or fewer
    parts[-1] = UP * (_norms(off, 1) + 12.0 * UNIT * _norms(states, 1))
    return Certified(tau, *norms_of(states), parts, states)


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
