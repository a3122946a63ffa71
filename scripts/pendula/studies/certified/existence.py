"""Proofs that steady breathers of (4) exist on the infinite chain.

A steady state is A = a, B = b or A = i a, B = i b, with real a and b. Let s be gamma in the first
case, and -gamma in the second. The state is a zero of F on bounded sequences u = (a_n, b_n),

    F(u)_n = epsilon (u_{n+1} - 2 u_n + u_{n-1}) + Omega u_n + s (X u_n - u_n) + u_n^3 / 2,

where X exchanges a and b, powers are taken component by component, and |u| is the largest of all
|a_n|, |b_n|. So DF(u) = epsilon D + Omega + s (X - 1) + 3 u^2 / 2, with D the second difference.
In bounds, epsilon stands for its modulus.

Let u be exact numbers (doubles) with u_n = 0 for |n| > M. The block is the sites |n| <= M, and K is
the part of DF(u) within the block. N is any matrix on the block, here nearly the inverse of K.

Approximate inverse. Beyond the block DF(u) has constant coefficients. Its part at one site is a
2 x 2 matrix C. The diagonal entries of C are Omega - s - 2 epsilon, and the others are s. Its
eigenvalues are Omega - 2 epsilon, for (1, 1), and Omega - 2 s - 2 epsilon, for (1, -1). Let d be
the smaller modulus of the two. If the diagonal entries of C^-1 are x and the others y, then
|C^-1| = |x| + |y| = max(|x + y|, |x - y|) = 1 / d. The approximate inverse A of DF(u) is N on the
block and C^-1 at each site beyond.

1. |1 - A DF(u)| <= Z, where Z is the larger of 2 epsilon / d and the largest row sum of
   |1 - N K| + epsilon |N E|. E consists of four columns of the unit matrix on the block: those of
   a and b at n = M and n = -M. Proof: let |w| <= 1. Beyond the block (A DF(u) w)_n is
   w_n + C^-1 epsilon (w_{n+1} + w_{n-1}). On the block A DF(u) w is N (K w + epsilon e), where e is
   w_{M+1} at n = M, w_{-M-1} at n = -M, and zero at the other sites.
2. If Z < 1, A is injective. Proof: A DF(u) has an inverse by Neumann's series, so A is onto. Then
   N is onto too, and a square matrix that is onto is injective. C^-1 is injective anyway.
3. |A F(u)| <= eta, the largest of |N F(u)|, epsilon |u_M| / d and epsilon |u_{-M}| / d.
   Proof: beyond the block, F(u) is zero except epsilon u_{+-M} at the sites +-(M + 1).
4. |A (DF(v) - DF(u))| <= lambda r + mu r^2 for |v - u| <= r, with lambda = 3 max_i sum_j
   |N_ij u_j| and mu = (3/2) max(|N|, 1 / d). Proof: DF(v) - DF(u) multiplies u_j by
   (3/2) (v_j^2 - u_j^2), at most 3 |u_j| r + (3/2) r^2, and u_j = 0 beyond the block.

Theorem. Let T(v) = v - A F(v) and p(r) = eta - (1 - Z) r + lambda r^2 / 2 + mu r^3 / 3. If
p(r) <= 0 and q(r) = Z + lambda r + mu r^2 < 1 for some r > 0, there is exactly one zero of F within
r of u. Proof: |DT(v)| <= q(|v - u|) by 1 and 4, so |T(v) - u| <= eta + the integral of q from
0 to r = p(r) + r <= r. T maps the closed ball into itself and contracts it. Its only fixed point is
a zero of F since A is injective; and every zero of F is a fixed point of T.

The true state is localised: it tends to zero. Proof: F, DF and A map sequences that tend to zero to
sequences that tend to zero. These form a closed subspace that contains u, so the theorem also holds
in this subspace. The zero of F in the subspace is the only one within r of u.

Symmetries. F commutes with n -> -n, with X, and with u -> -u, and these maps preserve |.|. If u has
one of these symmetries to the last bit, the true state has it too, because it is unique.

The state is not zero, since r < |u| is required.

Numbers are balls, python-flint's `arb`: every operation returns a ball that contains the result for
all numbers in its operands, and a comparison is true only if it holds for all numbers in the balls.
Balls are computed with integers, so they have the same bits on every machine.
"""

from collections.abc import Iterable
from typing import NamedTuple

import numpy as np
from flint import arb, arb_mat, ctx, fmpq

from .fixed_point import decimal

BITS = 128
"""Precision of the midpoints of balls."""


class ProofChain(NamedTuple):
    """The constants of the equations as doubles, and the half-width M of the block."""

    epsilon: float
    gamma: float
    omega: float
    half_width: int


def as_ball(value: float) -> arb:
    """Return a ball around the decimal that Python prints for this double: 1/10 for 0.1."""
    exact = decimal(value)
    return arb(fmpq(exact.numerator, exact.denominator))


class Estimates(NamedTuple):
    """The numbers of the theorem as balls; the upper end of each ball is a bound."""

    eta: arb
    z: arb  # Z
    quadratic: arb  # lambda
    cubic: arb  # mu


class ProofFailedError(ArithmeticError):
    """The proof failed; the message names the inequality."""


def refine(chain: ProofChain, s: float, state: np.ndarray) -> np.ndarray:
    """Return `state`, which is rounded to ten decimals, after one step of Newton's method.

    The step doubles the number of correct decimals. It is computed with balls: far from the centre
    `state` is zero, so the result is the step itself, and must not depend on the machine.
    """
    with ctx.workprec(BITS):
        u = on_full_chain(state)
        step = make_derivative(chain, s, u).mid().solve(make_residual(chain, s, u).mid())
    numbers = np.array([float(x.mid()) for x in step.entries()])
    return state - numbers.reshape(2, -1)[:, chain.half_width :]


def prove(chain: ProofChain, s: float, state: np.ndarray) -> float:
    """Return r such that one true steady state of the infinite chain lies within r of `state`.

    `state` is an even state in doubles, (component, site 0..M); for `s` see the module. Raises
    ProofFailedError if an inequality of the theorem cannot be shown.
    """
    with ctx.workprec(BITS):
        u = on_full_chain(state)
        radius = find_radius(make_estimates(chain, s, u))
        if not arb(radius) < _largest(map(abs, u)):
            raise ProofFailedError("the enclosure of the state contains zero")
        return radius


def on_full_chain(state: np.ndarray) -> list[arb]:
    """Return a and then b on the sites -M..M, for an even state (component, site 0..M)."""
    full_state = np.concatenate([state[:, :0:-1], state], axis=1)
    return [arb(float(value)) for value in full_state.ravel()]


def make_estimates(chain: ProofChain, s: float, u: list[arb]) -> Estimates:
    """Return eta, Z, lambda and mu; `u` has exact numbers, a and then b on the sites -M..M."""
    k, size = make_derivative(chain, s, u), len(u)
    epsilon, tail = abs(as_ball(chain.epsilon)), tail_distance(chain, s)
    if not 2 * epsilon < tail:
        raise ProofFailedError("2 epsilon < d fails beyond the block: Omega is in a band of waves")
    try:
        n = k.inv().mid()  # N
    except ZeroDivisionError:
        raise ProofFailedError("K, the derivative of the equations, has no inverse") from None
    # indices of both components on the sites -M and M
    ends = (0, size // 2 - 1, size // 2, size - 1)
    unit = arb_mat(size, size, [int(i == j) for i in range(size) for j in range(size)])
    left = _moduli(unit - n * k) * arb_mat([[1]] * size)
    # row sums of |N E|, |N_ij u_j| and |N|
    sums = _moduli(n) * arb_mat([[ends.count(j), abs(x), 1] for j, x in enumerate(u)])
    outside = [epsilon * abs(u[j]) / tail for j in ends]
    eta = _largest([*map(abs, (n * make_residual(chain, s, u)).entries()), *outside])
    inside = (left[i, 0] + epsilon * sums[i, 0] for i in range(size))
    z = _largest([*inside, 2 * epsilon / tail])
    weighted_row_sum = _largest(sums[i, 1] for i in range(size))
    largest_row_sum = _largest([*(sums[i, 2] for i in range(size)), 1 / tail])
    return Estimates(eta, z, 3 * weighted_row_sum, 1.5 * largest_row_sum)


def make_derivative(chain: ProofChain, s: float, u: list[arb]) -> arb_mat:
    """Return K, the matrix of DF(u) on the sites -M..M, first those of a, then those of b."""
    epsilon, omega, drive = map(as_ball, (chain.epsilon, chain.omega, s))
    sites = len(u) // 2
    rows = [[arb(0)] * len(u) for _ in u]
    for i, x in enumerate(u):
        rows[i][i] = omega - drive - 2 * epsilon + 1.5 * x * x
        rows[i][(i + sites) % len(u)] = drive
        for j in (i - 1, i + 1):
            if 0 <= j < len(u) and j // sites == i // sites:
                rows[i][j] = epsilon
    return arb_mat(rows)


def make_residual(chain: ProofChain, s: float, u: list[arb]) -> arb_mat:
    """Return F(u) on the sites -M..M as a column."""
    epsilon, omega, drive = map(as_ball, (chain.epsilon, chain.omega, s))
    sites, zero = len(u) // 2, [arb(0)]
    values = []
    for component, partner in ((u[:sites], u[sites:]), (u[sites:], u[:sites])):
        for left, a, b, right in zip(
            zero + component, component, partner, component[1:] + zero, strict=False
        ):
            coupled = epsilon * (right + left - 2 * a) + omega * a + drive * (b - a)
            values.append([coupled + a * a * a / 2])
    return arb_mat(values)


def tail_distance(chain: ProofChain, s: float) -> arb:
    """Return d, the smaller modulus of the eigenvalues of C."""
    epsilon, omega, drive = map(as_ball, (chain.epsilon, chain.omega, s))
    moduli = abs(omega - 2 * epsilon), abs(omega - 2 * drive - 2 * epsilon)
    return arb.min(*moduli)


def find_radius(estimates: Estimates) -> float:
    """Return a radius r that satisfies the inequalities of the theorem.

    The trial r is slightly above the smaller root of p without the last term of p. The proof does
    not depend on this choice. Raises ProofFailedError if an inequality fails.
    """
    eta, z, quadratic, cubic = estimates
    contraction = 1 - z
    if not contraction > 0:
        raise ProofFailedError("Z < 1 fails: the inverse is inaccurate, or DF(u) is singular")
    discriminant = contraction * contraction - 2 * quadratic * eta
    radius = (
        float((1.01 * 2 * eta / (contraction + discriminant.sqrt())).upper())
        if discriminant > 0
        else np.inf
    )
    r = arb(radius)
    p = eta - contraction * r + quadratic * r * r / 2 + cubic * r * r * r / 3
    if not (p <= 0 and z + quadratic * r + cubic * r * r < 1):
        raise ProofFailedError("p(r) <= 0 or q(r) < 1 fails: the residual is too large")
    return radius


def _moduli(matrix: arb_mat) -> arb_mat:
    return arb_mat(matrix.nrows(), matrix.ncols(), [abs(x) for x in matrix.entries()])


def _largest(values: Iterable[arb]) -> arb:
    """Return a ball whose upper end is not below any of the values."""
    top = arb(0)
    for value in values:
        top = arb.max(top, value)
    return top
