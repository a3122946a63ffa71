"""Proofs that steady breathers of (4) exist, on the infinite chain and on finite ones.

A steady state A = a, B = b or A = i a, B = i b with real a and b, and s = gamma in the real,
s = -gamma in the imaginary case, is a zero of F on the space of bounded sequences u = (a_n, b_n),

    F(u)_n = epsilon (u_{n+1} - 2 u_n + u_{n-1}) + Omega u_n + s (X u_n - u_n) + u_n^3 / 2,

where X exchanges a and b, powers are taken component by component, and |u| is the largest of all
|a_n|, |b_n|. So DF(u) = epsilon D + Omega + s (X - 1) + 3 u^2 / 2, with D the second difference.
In bounds, epsilon stands for its modulus.

Given: numbers u with u_n = 0 for |n| > M (doubles, so exact), and any matrix N on the block
|n| <= M, here about the inverse of K, the part of DF(u) within the block.

Approximate inverse. Beyond the block DF(u) has constant coefficients. Its part at one site is the
matrix C with Omega - s - 2 epsilon on and s off the diagonal, whose eigenvalues are
Omega - 2 epsilon on (1, 1) and Omega - 2 s - 2 epsilon on (1, -1); let d be the smaller of their
moduli. C^-1 has x on and y off the diagonal, so |C^-1| = |x| + |y| = max(|x + y|, |x - y|) = 1 / d.
Let A be N on the block and C^-1 at each site beyond.

1. |1 - A DF(u)| <= Z, the larger of 2 epsilon / d and of the row sums in the block of
   |1 - N K| + epsilon |N E|, E the four columns of the sites n = M and n = -M. Proof: for |w| <= 1,
   (A DF(u) w)_n = w_n + C^-1 epsilon (w_{n+1} + w_{n-1}) beyond the block, and N (K w + epsilon e)
   in it, where e holds w_{M+1} and w_{-M-1} at the two ends and vanishes elsewhere.
2. If Z < 1, A is injective. Proof: A DF(u) has an inverse by Neumann's series, so A is onto. Hence
   so is N, and a square matrix that is onto is injective; C^-1 is injective anyway.
3. |A F(u)| <= eta, the larger of |N F(u)| and of epsilon |u_M| / d and epsilon |u_{-M}| / d.
   Proof: of F(u), beyond the block only epsilon u_{+-M} at the sites +-(M + 1) is left.
4. |A (DF(v) - DF(u))| <= lambda r + mu r^2 for |v - u| <= r, with lambda = 3 max_i sum_j
   |N_ij u_j| and mu = (3/2) max(|N|, 1 / d). Proof: DF(v) - DF(u) multiplies u_j by
   (3/2) (v_j^2 - u_j^2), at most 3 |u_j| r + (3/2) r^2, and u_j = 0 beyond the block.

Theorem. Let T(v) = v - A F(v) and p(r) = eta - (1 - Z) r + lambda r^2 / 2 + mu r^3 / 3. If
p(r) <= 0 and q(r) = Z + lambda r + mu r^2 < 1 for some r > 0, there is exactly one zero of F within
r of u. Proof: |DT(v)| <= q(|v - u|) by 1 and 4, so that |T(v) - u| <= eta + the integral of q from
0 to r = p(r) + r <= r. T maps the closed ball into itself and contracts it. Its only fixed point is
a zero of F since A is injective; and every zero of F is a fixed point of T.

Uniqueness further out. If p(r) <= 0 and p(R) < 0 for some R > r, no other zero lies within R.
Proof: p is convex on [0, R], hence negative on (r, R]. A zero v at the distance t in (r, R] would
give t = |T(v) - u| <= p(t) + t < t.

It is localised. Let q = 2 epsilon / (d - r^2 / 2) < 1 and rho = q / (1 + sqrt(1 - q^2)). Then the
true state v has |v_n| <= |v_M| rho^(n - M) for n >= M and lies in l2. Proof: beyond the block
|v_n| <= r, and C + v_n^2 / 2 has an inverse of at most 1 / (d - r^2 / 2); so
|v_n| <= (q/2) (|v_{n+1}| + |v_{n-1}|). The sequence z_n = |v_M| rho^(n - M) has equality there. Let
the bounded sequence |v_n| - z_n, zero at n = M, have a positive supremum t over n > M: then
t <= (q/2) 2 t < t, which is absurd. The same holds for n <= -M.

Symmetries. F commutes with n -> -n, with X, and with u -> -u, which keep |.|. If u has a symmetry
to the last bit, uniqueness gives it to the true state.

The state is not zero, since r < |u| is asked for. On a finite chain of half-width M with the sites
beyond it at rest there is no outside: the same holds without 2 epsilon / d, E and 1 / d.
"""

from typing import NamedTuple

import numpy as np
from flint import arb, arb_mat

from . import balls
from .states import Chain

FURTHER_IN = (0.99, 0.9, 0.75, 0.5)
"""Parts of a root at which R is tried."""


class Proof(NamedTuple):
    """What is proved of the state near to the given one: doubles rounded to the safe side."""

    radius: float  # r: a true state lies within it
    unique: float  # R: no other state lies within it
    contraction: float  # Z
    decay: float  # rho, the factor from site to site beyond the block; 0 on a finite chain


class Estimates(NamedTuple):
    """What the theorem needs, as balls whose upper ends are bounds."""

    eta: arb
    z: arb  # Z
    bent: arb  # lambda
    cubic: arb  # mu


class RefusedError(ArithmeticError):
    """There is no proof; the message says which inequality fails."""


def prove(chain: Chain, s: float, state: np.ndarray, infinite: bool = True) -> Proof:
    """Prove that a true steady state is near to `state`, even, (component, site 0..M), of doubles.

    `s` is the drive on a and b. On the infinite chain, or on the finite one of M = `half_width`.
    Raises RefusedError where an inequality of the theorem cannot be shown.
    """
    with balls.precision():
        whole = np.concatenate([state[:, :0:-1], state], axis=1)
        u = [arb(float(value)) for value in whole.ravel()]
        found = estimate(chain, s, u, infinite)
        radius, unique = radii(found)
        if not arb(radius) < _largest(map(abs, u)):
            raise RefusedError("the enclosure of the state contains zero")
        decay = _decay(chain, s, arb(radius)) if infinite else 0.0
        return Proof(radius, unique, balls.upper(found.z), decay)


def estimate(chain: Chain, s: float, u: list[arb], infinite: bool) -> Estimates:
    """Return the numbers of 1, 3 and 4 for exact u on the sites -M..M, components in turn."""
    k, size = slope(chain, s, u), len(u)
    epsilon, away = abs(balls.decimal(chain.epsilon)), distance(chain, s)
    if infinite and not 2 * epsilon < away:
        raise RefusedError("the outside does not contract: Omega lies in a band of waves")
    try:
        n = k.inv().mid()  # N
    except ZeroDivisionError:
        raise RefusedError("the slope of the equations has no inverse there") from None
    # indices of both components on the sites -M and M
    ends = (0, size // 2 - 1, size // 2, size - 1) if infinite else ()
    unit = arb_mat(size, size, [int(i == j) for i in range(size) for j in range(size)])
    left = _moduli(unit - n * k) * arb_mat([[1]] * size)
    # row sums of |N E|, |N_ij u_j| and |N|
    sums = _moduli(n) * arb_mat([[ends.count(j), abs(x), 1] for j, x in enumerate(u)])
    z = _largest(left[i, 0] + epsilon * sums[i, 0] for i in range(size))
    eta = _largest(abs(x) for x in (n * residual(chain, s, u)).entries())
    bent, plain = (_largest(sums[i, column] for i in range(size)) for column in (1, 2))
    if infinite:
        z = _largest([z, 2 * epsilon / away])
        eta = _largest([eta, *(epsilon * abs(u[j]) / away for j in ends)])
        plain = _largest([plain, 1 / away])
    return Estimates(eta, z, 3 * bent, 1.5 * plain)


def slope(chain: Chain, s: float, u: list[arb]) -> arb_mat:
    """Return K, the matrix of DF(u) on the sites -M..M, components one after the other."""
    epsilon, omega, drive = map(balls.decimal, (chain.epsilon, chain.omega, s))
    sites = len(u) // 2
    rows = [[arb(0)] * len(u) for _ in u]
    for i, x in enumerate(u):
        rows[i][i] = omega - drive - 2 * epsilon + 1.5 * x * x
        rows[i][(i + sites) % len(u)] = drive
        for j in (i - 1, i + 1):
            if 0 <= j < len(u) and j // sites == i // sites:
                rows[i][j] = epsilon
    return arb_mat(rows)


def residual(chain: Chain, s: float, u: list[arb]) -> arb_mat:
    """Return F(u) on the sites -M..M, a column."""
    epsilon, omega, drive = map(balls.decimal, (chain.epsilon, chain.omega, s))
    sites, zero = len(u) // 2, [arb(0)]
    values = []
    for own, other in ((u[:sites], u[sites:]), (u[sites:], u[:sites])):
        for left, a, b, right in zip(zero + own, own, other, own[1:] + zero, strict=False):
            coupled = epsilon * (right + left - 2 * a) + omega * a + drive * (b - a)
            values.append([coupled + a * a * a / 2])
    return arb_mat(values)


def distance(chain: Chain, s: float) -> arb:
    """Return d, below the moduli of the eigenvalues of C."""
    epsilon, omega, drive = map(balls.decimal, (chain.epsilon, chain.omega, s))
    moduli = abs(omega - 2 * epsilon), abs(omega - 2 * drive - 2 * epsilon)
    return arb.min(*moduli)


def radii(estimates: Estimates) -> tuple[float, float]:
    """Return r and R of the theorem, each shown by its inequalities.

    Where to try them is no matter of proof: r a little above the smaller root of p without its last
    term, and R a little below the larger root of p without eta, or further in.
    """
    eta, z, bent, cubic = estimates
    room = 1 - z
    if not room > 0:
        raise RefusedError("the inverse is not near enough: the slope may be singular")

    def p(r: arb) -> arb:
        return eta - room * r + bent * r * r / 2 + cubic * r * r * r / 3

    under = room * room - 2 * bent * eta
    radius = balls.upper(1.01 * 2 * eta / (room + under.sqrt())) if under > 0 else np.inf
    r = arb(radius)
    if not (p(r) <= 0 and z + bent * r + cubic * r * r < 1):
        raise RefusedError("the residual is too large for the slope and the curvature")
    root = ((bent * bent / 4 + 4 * cubic * room / 3).sqrt() - bent / 2) / (2 * cubic / 3)
    tried = (balls.lower(part * root) for part in FURTHER_IN)
    return radius, next((out for out in tried if out > radius and p(arb(out)) < 0), radius)


def _decay(chain: Chain, s: float, r: arb) -> float:
    """Return an upper bound of rho."""
    epsilon, away = abs(balls.decimal(chain.epsilon)), distance(chain, s)
    ratio = 2 * epsilon / (away - r * r / 2)
    if not (away > r * r / 2 and ratio < 1):
        raise RefusedError("the state may not decay: the radius is too large")
    return balls.upper(ratio / (1 + (1 - ratio * ratio).sqrt()))


def _moduli(matrix: arb_mat) -> arb_mat:
    return arb_mat(matrix.nrows(), matrix.ncols(), [abs(x) for x in matrix.entries()])


def _largest(values) -> arb:
    """Return a ball whose upper end is not below any of the values."""
    top = arb(0)
    for value in values:
        top = arb.max(top, value)
    return top
