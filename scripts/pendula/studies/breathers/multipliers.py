"""Floquet multipliers of periodic breathers, and the growth rates of their perturbations.

Over a quarter of the period T perturbations p + i q of the solution change as

    p -> P p + Q q,    q -> S p + W q,

symplectic in p, q: W^T P - Q^T S = 1 (transposes are for sums over the whole chain). The reflection
at T / 4 gives the map over T / 2,

    [ a  b  ]        a = W^T P + Q^T S = 1 + 2 Q^T S,
    [ c a^T ]

and the solution changes its sign over T / 2, so the multipliers mu over half a period are the
eigenvalues of minus this map. It is a product of two reflections, so mu and 1 / mu come in pairs.
Their half-traces nu = (mu + 1 / mu) / 2, half as many, are the eigenvalues of -a. A breather is
stable if all nu lie in [-1, 1]. The multipliers over a whole period are the squares of mu. The
shift along the solution has nu = 1. There mu has a Jordan block, and an error d of the map would
change it by sqrt(d); nu is simple and known, and is set to 1.
"""

import numpy as np
from latticode.numerics.elementary import log

from .periodic import Breather, exchange_sign, real_data
from .quarter_period import STEPS, integrate_bundle

PARITIES = ("even", "odd")
NOISE = 1e-5
"""Smaller rates count as zero: an error of nu near 1 enters as its square root, and rounding splits
two waves of nearly equal nu. At this rate a perturbation grows by 10 % until tau = 1e4; the slowest
growth of a breather here is 0.03."""


def half_traces(breather: Breather, parity: str) -> np.ndarray:
    """Return nu of all even or odd perturbations, complex.

    If A = B or A = -B, perturbations with b = a and with b = -a decouple.
    """
    sites, first = breather.data.shape[1], PARITIES.index(parity)
    is_symmetric = exchange_sign(breather.data) != 0
    directions, nothing = _directions(sites, first, is_symmetric), np.empty((0, 4, sites))
    bundle = (nothing, directions) if first else (directions, nothing)
    state = real_data(breather.data)
    ends = integrate_bundle(breather.constants, state, *bundle, breather.quarter, STEPS)[1:]
    ends = ends[:, :, first:].reshape(
        2, -1, 2, 2, sites - first
    )  # (Re or Im, start, A or B, Re or Im, n)
    if is_symmetric:
        ends = np.concatenate([ends, ends[:, :, ::-1]], axis=1)
    _, s, q, _ = ends.transpose(0, 3, 2, 4, 1).reshape(4, -1, ends.shape[1])
    # each site but the centre also represents its mirror image
    weights = np.tile([1.0] * (1 - first) + [2.0] * (sites - 1), 2)[:, None]
    a = np.eye(len(s)) + 2.0 * (q.T @ (weights * s)) / weights
    n = len(a) // 2
    blocks = [a[:n, :n] + sign * a[:n, n:] for sign in (1.0, -1.0)] if is_symmetric else [a]
    nu = np.concatenate([-np.linalg.eigvals(block).astype(complex) for block in blocks])
    if parity == "even":  # the shift along the solution
        nu[np.argmin(np.abs(nu - 1.0))] = 1.0
    return nu


def _directions(sites: int, first: int, is_symmetric: bool) -> np.ndarray:
    """Return unit perturbations on `first`..M, real ones first; only those of A if symmetric."""
    units = np.eye(2 * sites).reshape(2, sites, 2, sites)[: 2 - is_symmetric, first:]
    units = units.reshape(-1, 2, sites)
    directions = np.zeros((2, len(units), 4, sites))
    directions[0][:, ::2] = directions[1][:, 1::2] = units
    return directions.reshape(-1, 4, sites)


def growth_rate_of_traces(frequency: float, nu: np.ndarray) -> float:
    """Return the growth rate of the fastest perturbation, per unit of tau, or 0 if none grows.

    A negative frequency means the time-reversed motion, which has the same growth rate.
    """
    root = np.sqrt(nu.astype(complex) ** 2 - 1.0)
    largest = np.maximum(np.abs(nu + root), np.abs(nu - root)).max()
    rate = float(log(largest)) * abs(frequency) / np.pi
    return rate if rate > NOISE else 0.0


def growth_rate(breather: Breather) -> float:
    """Return the growth rate of the fastest perturbation of a breather, per unit of tau, or 0."""
    return max(
        growth_rate_of_traces(breather.frequency, half_traces(breather, parity))
        for parity in PARITIES
    )
