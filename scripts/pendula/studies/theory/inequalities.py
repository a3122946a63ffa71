"""Proofs of the inequalities of Section 4: larger minus smaller side is a sum of squares.

The factors of the squares are nonnegative for epsilon, gamma > 0 and both signs of Omega. The
residual of an inequality is its larger side minus its smaller side minus these squares. It must
vanish. Each inequality has a wrong twin, with a residual that must not vanish: its larger side is
multiplied by 3/4, or its gamma by 1/2. P is |A|^2 + |B|^2 in l2, and `drive` and `bonds` are
functions of `polynomials`.
"""

from collections.abc import Callable, Mapping
from itertools import combinations, permutations
from typing import Any

import numpy as np
from flint import fmpq, fmpq_mpoly

from .polynomials import (
    EPSILON,
    GAMMA,
    OMEGA,
    PERTURBATION,
    SITES,
    STATE,
    ZERO,
    Residual,
    bonds,
    densities,
    energy,
    joined,
    linear_rates,
    rates,
)

HALF, QUARTER, LESS = fmpq(1, 2), fmpq(1, 4), fmpq(3, 4)


def sums(ends: str, state: np.ndarray = STATE) -> fmpq_mpoly:
    """Return 4 P - bonds(ends) as a sum of squares."""
    right, left = joined(ends, state)
    ends_twice = 2 * densities(state)[:, [0, -1]].sum() if ends == "free" else ZERO
    return ((right + left) ** 2).sum() + ends_twice


def along_drive(sign: int) -> fmpq_mpoly:
    """Return 2 P + `sign` drive(STATE) as a sum of squares."""
    together, (x, y) = STATE[0] + STATE[1], STATE[0] - STATE[1]
    return (together**2).sum() + 2 * ((x if sign > 0 else y) ** 2).sum()


def pairs(values: np.ndarray) -> fmpq_mpoly:
    """Return the sum of the products of any two values, each pair once."""
    return sum((a * b for a, b in combinations(np.ravel(values), 2)), start=ZERO)


def driven(change: fmpq_mpoly, state: np.ndarray, factor: int) -> list[fmpq_mpoly]:
    """Return `factor` gamma |state|^2 - s `change` minus squares, for s = 1 and s = -1.

    The squares have the factor 2 gamma.
    """
    together, (x, y) = state[0] + state[1], state[0] - state[1]
    power = factor * GAMMA * densities(state).sum()
    return [
        power - s * change - 2 * GAMMA * ((together**2).sum() + ((x - s * y) ** 2).sum())
        for s in (1, -1)
    ]


def growth(ends: str, factor: int) -> Residual:
    """Return the residuals of (19), |dP/dtau| <= `factor` gamma P, for both signs of dP/dtau."""
    return driven(2 * (STATE * rates(ends)).sum(), STATE, factor)


def parting(ends: str, factor: int) -> Residual:
    """Return the residuals of a bound on the rate of |d|^2, for a small difference d of solutions.

    With d = (a, b) in A and B, the bound is `factor` gamma |d|^2 plus the sum of |A_n|^2 |a_n|^2
    and |B_n|^2 |b_n|^2. There is a residual for each sign of the rate.
    """
    (re, im), (x, y) = STATE.swapaxes(0, 1), PERTURBATION.swapaxes(0, 1)
    along, across = re * x + im * y, im * x - re * y  # Re and Im of A conj(a) and B conj(b)
    quartic = (densities() * densities(PERTURBATION)).sum()
    bounds = driven(
        2 * (PERTURBATION * linear_rates(ends, PERTURBATION, STATE)).sum(), PERTURBATION, factor
    )
    return [
        bound + quartic - ((along - s * across) ** 2).sum()
        for s, bound in zip((1, -1), bounds, strict=True)
    ]


def laplacian(ends: str, share: int | fmpq) -> Residual:
    """Return the residual of (17) after multiplication of its larger side by `share`."""
    return 4 * share * densities().sum() - bonds(ends) - sums(ends)


def of_products(ends: str, share: int | fmpq) -> Residual:
    """Return the residual of (18) with both sides squared and the larger side times `share`."""
    a, b = densities()
    both = sum((a[i] * b[j] for i, j in permutations(range(SITES), 2)), start=ZERO)
    return share * a.sum() * b.sum() - (a * b).sum() - both


def embedding(ends: str, share: int | fmpq) -> Residual:
    """Return the residual of (22) between fourth powers, with the larger side times `share`."""
    a = densities()[0]
    return share * a.sum() ** 2 - (a**2).sum() - 2 * pairs(a)


def embedding_reversed(ends: str, share: int | fmpq) -> Residual:
    """Return the residual of (27) between fourth powers, with the larger side times `share`."""
    a = densities()[0]
    differences = sum(((x - y) ** 2 for x, y in combinations(a, 2)), start=ZERO)
    return share * len(a) * (a**2).sum() - a.sum() ** 2 - differences


def above_band(ends: str, gammas: int) -> Residual:
    """Return the residual of (21), with `gammas` in place of the factor 2 of gamma."""
    squares = densities()
    power, quartic = squares.sum(), (squares**2).sum()
    bound = (OMEGA - gammas * GAMMA - 4 * EPSILON) * power
    return energy(ends) - bound - QUARTER * quartic - GAMMA * along_drive(-1) - EPSILON * sums(ends)


def below_band(ends: str, gammas: int) -> Residual:
    """Return the residual of (25) for Omega < 0, with `gammas` in place of the factor of gamma."""
    squares = densities()
    power = squares.sum()
    bound = (-OMEGA - gammas * GAMMA) * power - QUARTER * power**2
    dropped = HALF * pairs(squares) + GAMMA * along_drive(1) + EPSILON * bonds(ends)
    return -energy(ends) - bound - dropped


def size_of_energy(ends: str, gammas: int) -> Residual:
    """Return the residuals of |H| <= (|Omega| + 2 gamma + 4 epsilon) P + P^2 / 4.

    There is one for each sign of H and of Omega. `gammas` replaces the factor 2 of gamma.
    """
    squares, h, left = densities(), energy(ends), []
    power, quartic = squares.sum(), (squares**2).sum()
    for sign_of_h in (1, -1):
        for size in (OMEGA, -OMEGA):  # |Omega|
            bound = (size + gammas * GAMMA + 4 * EPSILON) * power + QUARTER * power**2
            dropped = (size - sign_of_h * OMEGA) * power + GAMMA * along_drive(sign_of_h)
            dropped += EPSILON * (sums(ends) if sign_of_h < 0 else 4 * power + bonds(ends))
            dropped += HALF * pairs(squares) + (QUARTER * (1 - sign_of_h)) * quartic
            left.append(bound - sign_of_h * h - dropped)
    return left


def quadratic_part(ends: str, gammas: int) -> Residual:
    """Return the residuals of the lower bound on H in Theorem 3's proof, for each sign of Omega."""
    squares, left = densities(), []
    power, quartic = squares.sum(), (squares**2).sum()
    for size in (OMEGA, -OMEGA):  # |Omega|
        bound = QUARTER * quartic - (size + gammas * GAMMA + 4 * EPSILON) * power
        dropped = (size + OMEGA) * power + GAMMA * along_drive(-1) + EPSILON * sums(ends)
        left.append(energy(ends) - bound - dropped)
    return left


IDENTITIES: Mapping[str, tuple[Callable, Any, Any]] = {
    "(17)": (laplacian, 1, LESS),
    "(18)": (of_products, 1, LESS),
    "(19)": (growth, 4, 2),
    "distance of two solutions": (parting, 4, 2),
    "(21)": (above_band, 2, 1),
    "(22)": (embedding, 1, LESS),
    "(25)": (below_band, 2, 1),
    "(27)": (embedding_reversed, 1, LESS),
    "size of H": (size_of_energy, 2, 1),
    "lower bound for Theorem 3": (quadratic_part, 2, 1),
}
"""Statements with their residuals, as in `identities.IDENTITIES`."""
