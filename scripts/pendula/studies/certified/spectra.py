"""Proofs that steady breathers on a finite chain are stable or unstable, by enclosed spectra.

A perturbation p + i q (times i for imaginary states) of a steady state u obeys p' = L q, q' = -K p,

    L = epsilon D + Omega + u^2 / 2 + s (1 - X),    K = epsilon D + Omega + 3 u^2 / 2 - s (1 - X),

in the notation of `existence`. The matrix of both has the characteristic polynomial
det(x^2 + L K), so the exponents x are the square roots, of both signs, of the eigenvalues y of
S = -L K. A state is called stable if no exponent has a positive real part. Hence it is stable if
and only if all y are real and not positive: any other y has a root with a positive real part.

How "real" is proved. `acb_mat.eig` encloses the eigenvalues of a matrix of balls, one in each box,
for all matrices in the balls. S is real, so that the conjugate of an eigenvalue is one as well. If
the mirror image of a box meets no box but itself, the conjugate of its eigenvalue lies in the same
box, which holds only one: the eigenvalue is real. This is the symmetry of the Hamiltonian system
that keeps a simple pair of exponents on the imaginary axis; no rounding can hide a small growth.

Zero. For A = B the phase is free, L a = 0 exactly on sums of the two components, so S has the
eigenvalue zero. The one box that contains zero is then known to hold just zero. For other states a
box that contains zero leaves the question open.

The blocks. The true state is even, and has A = B or A = -B where the given one has, by uniqueness
(see `existence`). So S splits into even and odd perturbations, on the sites 0..M and 1..M, and for
such states into sums a + b (1 - X = 0) and differences a - b (1 - X = 2). In the blocks stand balls
around the squares of the given doubles that contain those of the true state.
"""

from enum import IntEnum

import numpy as np
from flint import acb, acb_mat, arb, arb_mat

from pendula.models.pairs import Family

from . import balls
from .existence import Chain


class Verdict(IntEnum):
    """Whether a state is proved stable, as datasets keep it."""

    UNDECIDED = -1
    UNSTABLE = 0
    STABLE = 1


def decide(chain: Chain, family: Family, state: np.ndarray, radius: float) -> Verdict:
    """Decide on all true states within `radius` of `state`, (component, site 0..M), and its family.

    The state is one of the finite chain, even, and has A = B or A = -B exactly if the family says.
    """
    found = set()
    with balls.precision():
        u = [[balls.within(value, radius) for value in row] for row in state]
        for even in (True, False):
            for block, sums in blocks(chain, family, u, even):
                zero = family.kind == "equal" and sums and even
                found.add(judge(eigenvalues(block), zero))
    order = (Verdict.UNSTABLE, Verdict.UNDECIDED, Verdict.STABLE)
    return next(one for one in order if one in found)


def judge(boxes: list[acb] | None, zero: bool) -> Verdict:
    """Decide by boxes of eigenvalues of a real matrix, one in each; None: they were not isolated.

    `zero` says that zero is known to be an eigenvalue.
    """
    if boxes is None or any(
        one.overlaps(other) for i, one in enumerate(boxes) for other in boxes[:i]
    ):
        return Verdict.UNDECIDED
    at_zero = [i for i, box in enumerate(boxes) if box.contains(0)]
    known = at_zero if zero and len(at_zero) == 1 else []
    verdict = Verdict.STABLE
    for i, box in enumerate(boxes):
        mirror = box.conjugate()
        real = not any(mirror.overlaps(other) for j, other in enumerate(boxes) if j != i)
        if i in known or (real and box.real < 0):
            continue
        if box.real > 0 if real else not box.imag.contains(0):
            return Verdict.UNSTABLE
        verdict = Verdict.UNDECIDED
    return verdict


def eigenvalues(block: arb_mat) -> list[acb] | None:
    """Return a box around each eigenvalue, None if they cannot be isolated."""
    try:
        return acb_mat(block).eig(algorithm="rump")
    except ValueError:
        return None


def blocks(chain: Chain, family: Family, u: list[list[arb]], even: bool) -> list:
    """Return the blocks of S on even or odd perturbations, each with whether it acts on sums."""
    drive = balls.decimal(family.drive(chain.gamma))
    a, b = ([one * one for one in row[0 if even else 1 :]] for row in u)
    if family.kind == "asymmetric":
        parts = [([a, b], drive, False)]
    else:
        parts = [([a], arb(0), True), ([a], 2 * drive, False)]
    found = []
    for squares, own, sums in parts:
        lower = _operator(chain, squares, own, 0.5, even)
        upper = _operator(chain, squares, -own, 1.5, even)
        found.append((-(lower * upper), sums))
    return found


def _operator(
    chain: Chain, squares: list[list[arb]], drive: arb, weight: float, even: bool
) -> arb_mat:
    """Return epsilon D + Omega + weight u^2 + drive (1 - X), with `weight` exact.

    For sums or differences alone, `drive` is already multiplied by 1 - X: 0 or 2 s.
    """
    epsilon, omega = balls.decimal(chain.epsilon), balls.decimal(chain.omega)
    sites = len(squares[0])
    flat = [one for row in squares for one in row]
    rows = [[arb(0)] * len(flat) for _ in flat]
    for i, square in enumerate(flat):
        rows[i][i] = omega - 2 * epsilon + weight * square + drive
        for j in (i - 1, i + 1):
            if 0 <= j < len(flat) and j // sites == i // sites:
                rows[i][j] = 2 * epsilon if even and i % sites == 0 else epsilon
        if len(squares) == 2:
            rows[i][(i + sites) % len(flat)] = -drive
    return arb_mat(rows)
