"""From Newton's equations (1) to (4): the straightforward computations that the paper omits.

The angles of (3) are x = 2 mu (Re A cos omega t - Im A sin omega t), and y with B in place of A.
Here cos omega t and sin omega t are indeterminates, and A and B depend on the slow time. The
residual of (1) at mu^3 must have no first harmonic, because the remainder would otherwise grow with
time. This gives (4). The energy of (1), averaged over a period in the frame that rotates with the
pendula, is -H at mu^4.
"""

from collections.abc import Callable, Mapping
from math import prod
from types import SimpleNamespace
from typing import Any

import numpy as np
from flint import fmpq, fmpq_mpoly

from pendula.models.equations import KERNEL_MODEL

from .polynomials import (
    COSINE,
    EPSILON,
    GAMMA,
    GENS,
    MU,
    OMEGA,
    SINE,
    STATE,
    ZERO,
    energy,
    joined,
    object_array,
    rates,
    scaled,
)

HALF = fmpq(1, 2)
MU_AT, COSINE_AT, SINE_AT = (GENS.index(generator) for generator in (MU, COSINE, SINE))
SLOW = HALF
"""d tau / d(mu^2 t), the rate of the slow time tau."""
DOUBLE = COSINE**2 - SINE**2
"""The cosine of 2 omega t, the time dependence of the drive."""
SINES = SimpleNamespace(sin=lambda x: x - fmpq(1, 6) * x * x * x)
"""The sine of an angle of order mu, up to mu^4."""


def at_order(polynomial: fmpq_mpoly, order: int) -> fmpq_mpoly:
    """Return the coefficient of mu^order of a polynomial."""
    terms = {e: c for e, c in polynomial.to_dict().items() if e[MU_AT] == order}
    return polynomial.context().from_dict(terms).subs({"mu": 1})


def averaged(polynomial: fmpq_mpoly) -> fmpq_mpoly:
    """Return the mean over a period of a polynomial in cos and sin of the fast time."""
    mean = ZERO
    for powers, coefficient in polynomial.to_dict().items():
        j, k = powers[COSINE_AT], powers[SINE_AT]
        if j % 2 == k % 2 == 0:
            other_powers = list(powers)
            other_powers[COSINE_AT] = other_powers[SINE_AT] = 0
            mean += polynomial.context().from_dict(
                {tuple(other_powers): coefficient * mean_of_powers(j, k)}
            )
    return mean


def mean_of_powers(j: int, k: int) -> fmpq:
    """Return the mean of cos^j sin^k over a period, for even j and k."""
    odd, even = (*range(1, j, 2), *range(1, k, 2)), range(2, j + k + 1, 2)
    return fmpq(prod(odd), prod(even))


def angles(state: np.ndarray = STATE) -> np.ndarray:
    """Return x and y of (3), (component, site)."""
    return scaled(2 * MU, turning(state[:, 0], state[:, 1]))


def turning(re: np.ndarray, im: np.ndarray) -> np.ndarray:
    """Return the real part of amplitudes times e^{i omega t}."""
    return scaled(COSINE, re) - scaled(SINE, im)


def accelerations(ends: str, x: np.ndarray, drive: fmpq_mpoly = DOUBLE) -> np.ndarray:
    """Return x'' and y'' of (1), (component, site), at the angles `x` of the same shape."""
    state = np.stack([x, 0 * x], axis=1)
    constants = {"coupling": EPSILON * MU**2, "drive": 2 * GAMMA * MU**2 * drive}
    return rates(ends, state, KERNEL_MODEL, SINES, **constants)[:, 1]


def first_harmonic(ends: str, slow: fmpq, drive: fmpq_mpoly = DOUBLE) -> list[fmpq_mpoly]:
    """Return the cosine and sine parts of the first harmonic in the residual of (1) at mu^3.

    The amplitudes obey (4) with tau = `slow` mu^2 t.
    """
    change = slow * rates(ends)
    # x'' + x at mu^3: from omega^2 = 1 + mu^2 Omega, and from the mixed fast and slow derivative
    inertia = -scaled(OMEGA, turning(STATE[:, 0], STATE[:, 1]))
    inertia = inertia - 2 * turning(change[:, 1], -change[:, 0])
    forces = accelerations(ends, angles(), drive=drive)
    return [
        averaged((2 * a - at_order(f, 3)) * wave)
        for a, f in zip(inertia.ravel(), forces.ravel(), strict=True)
        for wave in (COSINE, SINE)
    ]


def resonance(ends: str, drive: fmpq_mpoly) -> list[fmpq_mpoly]:
    """Return the first harmonic for another time dependence of the drive."""
    return first_harmonic(ends, SLOW, drive)


def newtons_energy(ends: str, x: np.ndarray) -> fmpq_mpoly:
    """Return the potential energy of (1) up to the fourth order of the angles."""
    right, left = joined(ends, x)
    squares = x * x
    gravity = (HALF * squares - fmpq(1, 24) * squares * squares).sum()
    coupled = HALF * EPSILON * MU**2 * ((right - left) ** 2).sum()
    return gravity + coupled + GAMMA * MU**2 * DOUBLE * ((x[0] - x[1]) ** 2).sum()


def inherited(ends: str, omega: fmpq_mpoly) -> list[fmpq_mpoly]:
    """Return the averaged energy of (1) plus H, then x'' and y'' plus the energy's gradient."""
    x = angles()
    turning = newtons_energy(ends, x) - HALF * (1 + MU**2 * OMEGA) * (x**2).sum()
    generic = STATE[:, 0]
    forces = object_array(
        (
            newtons_energy(ends, generic).derivative(GENS.index(generator))
            for generator in generic.ravel()
        ),
        generic.shape,
    )
    left = (accelerations(ends, generic) + forces).ravel()
    return [averaged(at_order(turning, 4)) + energy(ends, omega=omega), *left]


def synchronised(ends: str, sign: int) -> list[fmpq_mpoly]:
    """Return y'' - `sign` x'' of (1) on y = `sign` x, and the terms of the drive in x'' and y''.

    The sine acts on each angle separately, so the result holds for any odd function.
    """
    x = np.stack([STATE[0, 0], sign * STATE[0, 0]])
    driven, free = (accelerations(ends, x, drive) for drive in (DOUBLE, ZERO))
    return [*(driven[1] - sign * driven[0]), *(driven - free).ravel()]


IDENTITIES: Mapping[str, tuple[Callable, Any, Any]] = {
    "(4) from (1) by (3)": (first_harmonic, SLOW, 2 * SLOW),
    "1:2 resonance": (resonance, DOUBLE, COSINE),
    "H from the energy of (1)": (inherited, OMEGA, OMEGA + 1),
    "x = y is kept": (synchronised, 1, -1),
}
"""Statements with their residuals, as in `identities.IDENTITIES`."""
