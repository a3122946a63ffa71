"""The chain without the cubic terms of (4): its modes, its exact flow, and Lemma 1.

The lattice Laplacian has real orthonormal modes with the eigenvalues -lambda_k, and the modes
decouple: the sum S = A + B obeys i S' = -kappa S, and the difference D = A - B obeys
i D' = -kappa D - 2 gamma conj(D), where kappa = epsilon lambda_k - Omega as in (14). This gives
Lemma 1: the dispersion relation (15), the threshold gamma_0 (12), and thresholds of finite chains.
Rates are per unit of tau. lambda covers [0, 4] on the infinite chain and has N values on N sites.
"""

from functools import lru_cache

import numpy as np
from latticode.equations.ends import ends_of
from latticode.numerics import elementary
from latticode.numerics.elementary import complex_of
from latticode.numerics.matrices import times

Reals = float | np.ndarray


@lru_cache(maxsize=16)
def curvatures(sites: int, boundary: str) -> np.ndarray:
    """Return lambda_k = 4 sin^2(theta_k / 2) of every mode, shape (sites,), read-only."""
    half_angle = ends_of(boundary).half_angle(np.arange(sites), sites)
    return _read_only(4.0 * elementary.sin(half_angle) ** 2)


@lru_cache(maxsize=16)
def modes(sites: int, boundary: str) -> np.ndarray:
    """Return the orthonormal modes of the lattice Laplacian, (mode, site), read-only."""
    k, j = np.arange(sites)[:, None], np.arange(sites)
    return _read_only(ends_of(boundary).mode(k, j, sites))


def _read_only(values: np.ndarray) -> np.ndarray:
    """Return the array, made read-only because all callers share it."""
    values.flags.writeable = False
    return values


def driven(kappa: np.ndarray, gamma: float, tau: float) -> tuple[np.ndarray, np.ndarray]:
    """Return (C, S) with D'' = (4 gamma^2 - kappa^2) D: C = cosh(s tau), S = sinh(s tau) / s.

    If 4 gamma^2 < kappa^2, these are cosine and sine. At equality, the threshold of Lemma 1, C = 1
    and S = tau: the growth is linear in time.
    """
    square = (2 * gamma - kappa) * (2 * gamma + kappa)
    rate = np.sqrt(np.abs(square))
    nonzero = np.where(rate > 0, rate, 1.0)
    grows = square > 0
    angle = rate * tau
    hyperbolic = np.where(grows, angle, 0.0)
    sine, cosine = elementary.sine_and_cosine(np.where(grows, 0.0, angle))
    even = np.where(grows, elementary.cosh(hyperbolic), cosine)
    odd = np.where(grows, elementary.sinh(hyperbolic), sine)
    return even, np.where(rate > 0, odd / nonzero, tau)


def flow(
    amplitudes: np.ndarray, tau: float, epsilon: float, gamma: float, omega: Reals, boundary: str
) -> np.ndarray:
    """Return the solution (A, B) of the linear equations at `tau`, shape (2, N), from `amplitudes`.

    `amplitudes` is complex, shape (2, N), and `tau` may be negative. The result is exact up to
    rounding. If `omega` is an array, the result has the shape (..., 2, N).
    """
    sites = amplitudes.shape[1]
    basis = modes(sites, boundary)
    kappa = epsilon * curvatures(sites, boundary) - np.asarray(omega)[..., None]
    total = times(basis, amplitudes[0] + amplitudes[1])
    difference = times(basis, amplitudes[0] - amplitudes[1])
    total = elementary.product(elementary.turn(kappa * tau), total)
    even, odd = driven(kappa, gamma, tau)
    p, q = difference.real, difference.imag
    real = even * p + (2 * gamma - kappa) * odd * q
    imaginary = even * q + (2 * gamma + kappa) * odd * p
    total = times(basis.T, total)
    difference = times(basis.T, complex_of(real, imaginary))
    return 0.5 * np.stack([total + difference, total - difference], axis=-2)


def growth_rate(kappa: Reals, gamma: Reals) -> Reals:
    """Return the growth rate sqrt(4 gamma^2 - kappa^2) of a mode, or 0 if the mode is stable."""
    return np.sqrt(np.maximum(0.0, (2.0 * np.abs(gamma) - kappa) * (2.0 * np.abs(gamma) + kappa)))


def gamma_0(omega: Reals, epsilon: float) -> Reals:
    """Return the threshold (12) of the infinite chain. It is zero for Omega in [0, 4 epsilon].

    With epsilon < 0, which the paper does not treat, the band is [4 epsilon, 0].
    """
    low, high = min(0.0, 4.0 * epsilon), max(0.0, 4.0 * epsilon)
    return 0.5 * np.maximum(0.0, np.maximum(low - np.asarray(omega), omega - high))


def infinite_rate(omega: Reals, gamma: Reals, epsilon: float) -> Reals:
    """Return the largest growth rate over all wave numbers of the infinite chain."""
    return growth_rate(2.0 * gamma_0(omega, epsilon), gamma)


def finite_threshold(omega: Reals, epsilon: float, sites: int, boundary: str) -> Reals:
    """Return the threshold min_k |kappa_k| / 2 of a chain of N sites, of the shape of `omega`."""
    kappa = epsilon * curvatures(sites, boundary) - np.asarray(omega)[..., None]
    return 0.5 * np.abs(kappa).min(axis=-1)


def finite_rate(omega: Reals, gamma: Reals, epsilon: float, sites: int, boundary: str) -> Reals:
    """Return the largest growth rate of a chain of N sites."""
    return growth_rate(2.0 * finite_threshold(omega, epsilon, sites, boundary), gamma)
