"""Periodic breathers: localised states that swing at a frequency lambda, and their stability.

    A_n(tau) = sum over odd m of a_{n,m} exp(-i m lambda tau) with real coefficients,

B_n alike. The equations (4) are reversible, conj A(-tau) solves them with A(tau), and odd, -A
solves them with A. Real coefficients make A and B real at tau = 0, odd harmonics turn their sign
after half a period T / 2 = pi / lambda, and both together make A and B imaginary at T / 4.
Conversely, a solution that is real at 0 and imaginary at T / 4 is reflected at both times, hence
has the period T and both symmetries. So a breather is found by shooting over a quarter of its
period: Re A(T / 4) = Re B(T / 4) = 0 for the real unknowns A(0), B(0), by Newton's method, which
needs the perturbations of these data alone.

Stability. Let perturbations of real and imaginary parts go over T / 4 as

    p -> P p + Q q,    q -> S p + W q,

symplectic in p, q: W^T P - Q^T S = 1 (sums over the whole chain). The reflection at T / 4 gives the
map over T / 2, and with the change of sign there the multipliers mu over half a period are the
eigenvalues of minus

    [ W^T P + Q^T S    2 W^T Q ]
    [ 2 P^T S    P^T W + S^T Q ].

This is a product of two reflections, so that mu and 1 / mu come together, and (mu + 1 / mu) / 2 =
nu are the eigenvalues of -(W^T P + Q^T S) = -(1 + 2 Q^T S): half as many, and a breather is stable
if all nu lie in [-1, 1]. The shift along the solution has nu = 1. There mu has a Jordan block, and
an error d of the map would show as sqrt(d); nu is simple and exact, so that it is set to 1.

Existence. On an infinite chain the tails decay if no odd multiple of lambda meets the frequencies
of linear waves, equation (15): with kappa between Omega - 4 epsilon and Omega, +-kappa for A + B
and +-sqrt(kappa^2 - 4 gamma^2) for A - B.
"""

from collections.abc import Mapping
from typing import NamedTuple

import numpy as np

from pendula.numerics.elementary import log
from pendula.problem import Constants

from .quarter_period import flow
from .steady import NotFoundError
from .waves import distance_from_bands

FAMILIES = ("A only", "A = -B", "A = B")
"""B = 0 where gamma = 0, and follows by the drive; B opposite to A; B equal to A."""
TOLERANCE = 1e-13
"""Largest |Re A| and |Re B| at a quarter of a period, relative to the largest at the start."""
ITERATIONS = 20


class Breather(NamedTuple):
    """A periodic breather at the instant when A and B are real: (component, site 0..M)."""

    constants: Constants
    frequency: float
    data: np.ndarray

    @property
    def quarter(self) -> float:
        """A quarter of the period."""
        return 0.5 * np.pi / self.frequency


def single_site(constants: Constants, frequency: float, family: str, half_width: int) -> np.ndarray:
    """Return a first guess: the motion of one pair whose neighbours follow it weakly."""
    binding = frequency - constants.omega + 2.0 * constants.epsilon
    if binding <= 0.0:
        raise NotFoundError(f"no localised motion of frequency {frequency:g}")
    data = np.zeros((2, half_width + 1))
    data[0, :2] = np.sqrt(2.0 * binding) * np.array([1.0, constants.epsilon / binding])
    if family == "A only":
        data[1] = -constants.gamma / (frequency + constants.omega) * data[0]
    else:
        data[1] = data[0] if family == "A = B" else -data[0]
    return data


def shoot(constants: Constants, frequency: float, start: np.ndarray) -> Breather:
    """Return the breather that Newton's method finds from real data, (component, site)."""
    data, (rows, sites) = start, start.shape
    directions = np.zeros((rows * sites, 4, sites))
    directions[:, ::2] = np.eye(rows * sites).reshape(-1, rows, sites)
    nothing, largest = np.empty((0, 4, sites)), np.inf
    for _ in range(ITERATIONS):
        ends = flow(constants, _real(data), directions, nothing, 0.5 * np.pi / frequency)
        real = ends[:, ::2].reshape(len(ends), -1)
        last, largest = largest, np.abs(real[0]).max() / np.abs(data).max()
        if largest <= TOLERANCE and largest >= 0.1 * last:
            return Breather(constants, frequency, data)
        if not largest < 10.0:
            break
        data = data - np.linalg.solve(real[1:].T, real[0]).reshape(data.shape)
    raise NotFoundError(f"no breather at the frequency {frequency:g}: {largest:.1e} is left")


LARGEST_RATIO = 1.5
"""Of a frequency and the next one, between which Newton's method does not lose a family."""
DECAY = 34.0
"""A tail falls by this exponent before the chain ends: to 2e-15 of the centre."""


def half_width_for(constants: Constants, frequency: float, least: int, most: int) -> int:
    """Return the half-width that the tails need, from their decay beside the nearest band."""
    away = distance_from_bands(constants, frequency) / (2.0 * constants.epsilon)
    if not away:
        return most
    decay = log(1.0 + away + np.sqrt(away * (2.0 + away)))  # the inverse of cosh at 1 + away
    return int(np.clip(np.ceil(DECAY / decay), least, most))


def family_of(constants: Constants, family: str, frequencies, half_widths: Mapping[str, int]):
    """Yield the breathers of a family from the highest frequency down to where it ends.

    Each starts from the one before. A frequency whose odd multiples meet a band has no breather.
    """
    wanted = sorted(frequencies, reverse=True)
    half_width = half_width_for(constants, wanted[0], **half_widths)
    data = single_site(constants, wanted[0], family, half_width)
    for before, frequency in zip([wanted[0], *wanted], wanted, strict=False):
        for step in _between(before, frequency):
            if distance_from_bands(constants, step) == 0.0:
                return
            half_width = half_width_for(constants, step, **half_widths)
            data = np.pad(data, ((0, 0), (0, max(0, half_width + 1 - data.shape[1]))))
            breather = shoot(constants, step, data)
            data = breather.data
        yield breather


def _between(start: float, end: float) -> list[float]:
    """Return frequencies after `start` down to `end`, so close that each leads to the next."""
    count = max(1, int(np.ceil(log(start / end) / log(LARGEST_RATIO))))
    return [start + (end - start) * k / count for k in range(1, count)] + [end]


def half_traces(breather: Breather) -> dict[str, np.ndarray]:
    """Return the numbers nu of the module's text for even and odd perturbations, complex."""
    sites = breather.data.shape[1]
    evens, odds = _directions(sites, 0), _directions(sites, 1)
    ends = flow(breather.constants, _real(breather.data), evens, odds, breather.quarter)[1:]
    weights = np.tile([1.0] + [2.0] * (sites - 1), 2)[:, None]  # a site stands for its image too
    even = _nu(ends[: len(evens)], 0, weights)
    even[np.argmin(np.abs(even - 1.0))] = 1.0
    return {"even": even, "odd": _nu(ends[len(evens) :], 1, np.ones((2 * sites - 2, 1)))}


def _real(data: np.ndarray) -> np.ndarray:
    return np.stack([data[0], 0.0 * data[0], data[1], 0.0 * data[1]])


def _directions(sites: int, first: int) -> np.ndarray:
    """Return unit perturbations on the sites `first`..M: of real parts, then of imaginary ones."""
    units = np.eye(2 * sites).reshape(2, sites, 2, sites)[:, first:].reshape(-1, 2, sites)
    found = np.zeros((2, len(units), 4, sites))
    found[0][:, ::2] = found[1][:, 1::2] = units
    return found.reshape(-1, 4, sites)


def _nu(ends: np.ndarray, first: int, weights: np.ndarray) -> np.ndarray:
    count = len(ends) // 2
    real_to_imaginary = ends[:count, 1::2, first:].reshape(count, -1).T
    imaginary_to_real = ends[count:, ::2, first:].reshape(count, -1).T
    product = (imaginary_to_real.T @ (weights * real_to_imaginary)) / weights
    return -1.0 - 2.0 * np.linalg.eigvals(product).astype(complex)


NOISE = 1e-7
"""Where bands of both signatures meet, nu has nearly double values, which rounding splits by the
square root of its size. Growth by less than this counts as none."""


def growth(frequency: float, traces: np.ndarray) -> float:
    """Return the rate at which the worst perturbation grows per unit of tau; 0 if none does."""
    root = np.sqrt(traces**2 - 1.0)
    largest = float(np.maximum(np.abs(traces + root), np.abs(traces - root)).max())
    rate = float(log(largest)) * frequency / np.pi
    return rate if rate > NOISE else 0.0
