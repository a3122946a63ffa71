"""The paper's identities, proved by algebra: both sides are polynomials, compared term by term.

These are polynomials in the fields and the constants, for each kind of ends. An identity holds for
all data and constants if and only if its residual, the difference of its sides, vanishes. Each
statement has a wrong twin, a false statement with a residual that must not vanish.
"""

from collections.abc import Callable, Mapping
from functools import partial
from itertools import combinations, permutations
from math import prod
from typing import Any

import numpy as np
import xarray as xr
from flint import fmpq, fmpq_mpoly
from latticode.datasets.checks import describe, table, variable
from latticode.equations.model import Model, Value, abs2, conj, lap

from pendula.problem import BOUNDARIES

from . import derivation, inequalities
from .polynomials import (
    CONSTANTS,
    EPSILON,
    GAMMA,
    KAPPA,
    OMEGA,
    SINE,
    SITES,
    STATE,
    ZERO,
    Residual,
    conjugate,
    energy,
    gradient,
    linear_rates,
    put,
    rates,
    scaled,
    terms_left,
    times,
)

HALF = fmpq(1, 2)
TURN = fmpq(3, 5), fmpq(4, 5)
"""Cosine and sine of an irrational fraction of a turn. Its multiples are dense, so a symmetry under
a shift of phases by this angle is a symmetry under all shifts."""

# --- The paper's other forms of the equations, as it prints them ----------------------------------


def pt_form(p: Any, u: Value, v: Value) -> list[Value]:
    """Return i du/dtau and i dv/dtau of (10)."""
    uu, vv = abs2(u), abs2(v)
    return [
        p.epsilon * lap(v)
        + p.omega * v
        + 1j * p.gamma * u
        - p.gamma * conj(u)
        + 2.0 * ((2.0 * uu + vv) * v + u * u * conj(v)),
        p.epsilon * lap(u)
        + p.omega * u
        - 1j * p.gamma * v
        - p.gamma * conj(v)
        + 2.0 * ((uu + 2.0 * vv) * u + conj(u) * v * v),
    ]


def scalar_form(p: Any, a: Value) -> Value:
    """Return i da/dtau of the scalar equation to which (4) reduces by (5)."""
    return p.epsilon * lap(a) + p.omega * a + 0.5 * abs2(a) * a


PT = Model(fields=("u", "v"), parameters=dict.fromkeys(CONSTANTS, 1.0), i_dt=pt_form)
SCALAR = Model(fields=("a",), parameters=dict.fromkeys(CONSTANTS, 1.0), i_dt=scalar_form)


def from_pt(w: np.ndarray) -> np.ndarray:
    """Return (A, B) of (u, v) by (9): A = 2 (u + v), conj B = 2i (u - v)."""
    return np.stack([2 * (w[0] + w[1]), conjugate(times(0, 2, w[:1] - w[1:]))[0]])


# --- Symmetries -----------------------------------------------------------------------------------


def exchanged(state: np.ndarray) -> np.ndarray:
    return state[::-1]


def turned(state: np.ndarray) -> np.ndarray:
    return times(*TURN, state)


def times_i(state: np.ndarray) -> np.ndarray:
    return times(0, 1, state)


def equal_phases(factor: int) -> np.ndarray:
    """Return a state with B = `factor` A."""
    return np.stack([STATE[0], factor * STATE[0]])


def equivariance(
    ends: str, image: Callable, state: np.ndarray = STATE, direction: int = 1, **constants: Any
) -> Residual:
    """Return the residual of the symmetry w -> image(w); a `direction` of -1 reverses time."""
    return rates(ends, image(state), **constants) - direction * image(
        rates(ends, state, **constants)
    )


def p_and_t(ends: str, direction: int) -> Residual:
    """Return the residual of (10) under P and T if `direction` is -1, else under P alone."""
    image = exchanged if direction > 0 else lambda w: conjugate(exchanged(w))
    return equivariance(ends, image, direction=direction, model=PT)


def phases(ends: str, gamma: fmpq_mpoly, **constants: Any) -> Residual:
    """Return the residual of the symmetry under a shift of all phases, with the drive `gamma`."""
    return equivariance(ends, turned, gamma=gamma, **constants)


def phases_alike(ends: str, factor: int) -> Residual:
    """Return the residual of gauge symmetry of (4) on B = `factor` A."""
    return equivariance(ends, turned, equal_phases(factor))


def hamiltonian(ends: str, omega: fmpq_mpoly) -> Residual:
    """Return the rates of (4) minus those of (7), where d/d(conj A) is half of (d/dRe, d/dIm)."""
    return rates(ends) - HALF * times(0, -1, gradient(energy(ends, omega=omega)))


def rate_of_energy(ends: str, omega: fmpq_mpoly) -> Residual:
    return (gradient(energy(ends, omega=omega)) * rates(ends)).sum()


def reduction(ends: str, factor: int) -> Residual:
    """Return the rates of A in (4) on B = `factor` A, minus those of the scalar equation."""
    return rates(ends, equal_phases(factor))[0] - rates(ends, STATE[:1], SCALAR)[0]


def of_pt(ends: str, gamma: fmpq_mpoly) -> Residual:
    """Return the rates of (4) minus those of (10) transformed by (9)."""
    return from_pt(rates(ends, model=PT)) - rates(ends, from_pt(STATE), gamma=gamma)


def pt_hamiltonian(ends: str, image: Callable) -> Residual:
    """Return the rates of (10) minus the rates that follow from the energy K = H / 8.

    If `image` exchanges u and v, they are i u' = dK/d(conj v) and i v' = dK/d(conj u).
    """
    slope = gradient(fmpq(1, 8) * put(energy(ends), from_pt(STATE)))
    return rates(ends, model=PT) - HALF * times(0, -1, image(slope))


def sign_of_gamma(ends: str, image: Callable) -> Residual:
    """Return the residual of the statement that w -> image(w) changes the sign of gamma."""
    return rates(ends, image(STATE), gamma=-GAMMA) - image(rates(ends))


# --- The linear equations -------------------------------------------------------------------------


def of_a_wave(ends: str, kappa: fmpq_mpoly) -> Residual:
    """Return the linear rates at a site of a wave minus the rates by (14).

    The linear equation (14) is i A' + kappa A = gamma (conj B - conj A). Each neighbour of the site
    has its amplitudes times cos(theta), and SINE is sin(theta / 2).
    """
    site = STATE[..., :1]
    neighbour = scaled(1 - 2 * SINE**2, site)
    at_site = linear_rates("dirichlet", np.concatenate([neighbour, site, neighbour], axis=-1))[
        ..., 1:2
    ]
    flipped = conjugate(exchanged(site) - site)
    return at_site - times(0, -1, scaled(GAMMA, flipped) - scaled(kappa, site))


def determinant(ends: str, drive: int) -> Residual:
    """Return the determinant before (15) minus the product of its factors with `drive` * gamma."""
    k, g, w = KAPPA, GAMMA, OMEGA
    rows = [[k - w, g, ZERO, -g], [g, k + w, -g, ZERO], [ZERO, -g, k - w, g], [-g, ZERO, g, k + w]]
    total = ZERO
    for order in permutations(range(4)):
        swaps = sum(i > j for i, j in combinations(order, 2))
        total += (-1) ** swaps * prod((rows[i][order[i]] for i in range(4)), start=ZERO + 1)
    difference = w**2 - k**2
    return total - difference * (difference + (drive * g) ** 2)


def balance(ends: str, factor: int) -> Residual:
    """Return dP/dtau minus `factor` times the balance equation in the proof of Lemma 2."""
    x, y = STATE[0] - STATE[1]
    return 2 * (STATE * rates(ends)).sum() - factor * 4 * GAMMA * (x * y).sum()


# --- All of them ----------------------------------------------------------------------------------

IDENTITIES: Mapping[str, tuple[Callable, Any, Any]] = {
    "(7)": (hamiltonian, OMEGA, OMEGA + 1),
    "conservation of (8)": (rate_of_energy, OMEGA, OMEGA + 1),
    "exchange of A and B": (equivariance, exchanged, lambda w: times_i(exchanged(w))),
    "sign of gamma": (sign_of_gamma, times_i, lambda w: -w),
    "phases of (4) without drive": (phases, ZERO, GAMMA),
    "phases of (10) without drive": (partial(phases, model=PT), ZERO, GAMMA),
    "(5) without drive": (reduction, 1, -1),
    "phases on A = B": (phases_alike, 1, -1),
    "(10)": (of_pt, GAMMA, 2 * GAMMA),
    "(11)": (p_and_t, -1, 1),
    "energy of (10)": (pt_hamiltonian, exchanged, lambda slope: slope),
    "(14)": (of_a_wave, 4 * EPSILON * SINE**2 - OMEGA, 2 * EPSILON * SINE**2 - OMEGA),
    "(15)": (determinant, 2, 1),
    "balance of P": (balance, 1, 2),
    **derivation.IDENTITIES,
    **inequalities.IDENTITIES,
}
"""For each statement a function of a kind of ends and an argument, which returns the residual; the
argument for the statement; and the argument for its wrong twin."""


def prove_identities() -> xr.Dataset:
    """Return the number of terms in the residuals of statements and of twins, by kind of ends."""
    dims = ("identity", "boundary")
    right, wrong = (
        [
            [terms_left(residual(ends, arguments[i])) for ends in BOUNDARIES]
            for residual, *arguments in IDENTITIES.values()
        ]
        for i in (0, 1)
    )
    check = table(
        "Identities and inequalities of the paper, proved as polynomials over the rationals",
        {"identity": list(IDENTITIES), "boundary": list(BOUNDARIES)},
        terms=variable(right, dims, "terms that the statement leaves", tolerance=0),
        twin_terms=variable(wrong, dims, "terms that its wrong twin leaves"),
    )
    print(describe("identities", check))
    return xr.Dataset.from_dict(check).assign_attrs(sites=SITES)
