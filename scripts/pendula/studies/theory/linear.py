"""Lemma 1: the dispersion relation (15), the threshold gamma_0 (12), and those of finite chains.

Rates are per unit of tau. A mode of curvature lambda has kappa = epsilon lambda - Omega; on the
infinite chain lambda covers [0, 4], on N sites it takes N values of its own.
"""

import numpy as np

from pendula.datasets.checks import table, variable
from pendula.models.linear_flow import curvatures


def squared_frequencies(kappa, gamma: float):
    """Return (omega_1^2, omega_2^2) = (kappa^2, kappa^2 - 4 gamma^2) of (15)."""
    kappa = np.asarray(kappa, dtype=float)
    return kappa**2, (kappa - 2.0 * gamma) * (kappa + 2.0 * gamma)


def growth_rate(kappa, gamma):
    """Return the growth rate sqrt(4 gamma^2 - kappa^2) of a mode, 0 where it is stable."""
    return np.sqrt(np.maximum(0.0, (2.0 * np.abs(gamma) - kappa) * (2.0 * np.abs(gamma) + kappa)))


def gamma_0(omega, epsilon: float):
    """Return the threshold (12) of the infinite chain; inside [0, 4 epsilon] it is zero.

    With epsilon < 0, which the paper leaves out, the band is [4 epsilon, 0].
    """
    low, high = min(0.0, 4.0 * epsilon), max(0.0, 4.0 * epsilon)
    return 0.5 * np.maximum(0.0, np.maximum(low - np.asarray(omega), omega - high))


def infinite_rate(omega, gamma, epsilon: float):
    """Return the largest growth rate over all wave numbers of the infinite chain."""
    return growth_rate(2.0 * gamma_0(omega, epsilon), gamma)


def finite_threshold(omega, epsilon: float, sites: int, boundary: str):
    """Return the threshold min_k |kappa_k| / 2 of a chain of N sites, of the shape of `omega`."""
    kappa = epsilon * curvatures(sites, boundary) - np.asarray(omega)[..., None]
    return 0.5 * np.abs(kappa).min(axis=-1)


def finite_rate(omega, gamma, epsilon: float, sites: int, boundary: str):
    """Return the largest growth rate of a chain of N sites."""
    return growth_rate(2.0 * finite_threshold(omega, epsilon, sites, boundary), gamma)


def stable_windows(gamma: float, epsilon: float, sites: int, boundary: str) -> np.ndarray:
    """Return the intervals of Omega in [0, 4 epsilon] where the finite chain is stable, (., 2).

    Between two neighbouring eigenvalues of the Laplacian Omega is stable as long as it keeps a
    distance of more than 2 |gamma| from both; the band's edges are no eigenvalues of a Dirichlet
    chain, so that a window may reach them.
    """
    levels = np.unique(np.round(epsilon * curvatures(sites, boundary), 14))
    low = np.concatenate([[0.0], levels + 2.0 * abs(gamma)])
    high = np.concatenate([levels - 2.0 * abs(gamma), [4.0 * epsilon]])
    windows = np.stack([np.maximum(low, 0.0), np.minimum(high, 4.0 * epsilon)], axis=1)
    return windows[windows[:, 1] > windows[:, 0]]


def widest_gamma(epsilon: float, sites: int, boundary: str) -> float:
    """Return the largest |gamma| at which any window of stability is left in [0, 4 epsilon]."""
    levels = epsilon * np.sort(curvatures(sites, boundary))
    inner = np.diff(levels).max(initial=0.0) / 4.0
    return float(max(inner, levels[0] / 2.0, (4.0 * epsilon - levels[-1]) / 2.0))


def check_windows(epsilon: float, boundary: str, half_widths, gammas) -> dict:
    """Tabulate the windows of stability that finite chains keep inside [0, 4 epsilon].

    Lemma 1 says that the infinite chain has none for gamma not zero; the share of the band that
    is stable on 2M + 1 sites falls as M grows.
    """
    count = np.zeros((len(half_widths), len(gammas)), int)
    share = np.zeros(count.shape)
    for i, half_width in enumerate(half_widths):
        for j, gamma in enumerate(gammas):
            windows = stable_windows(gamma, epsilon, 2 * half_width + 1, boundary)
            count[i, j] = len(windows)
            share[i, j] = np.sum(windows[:, 1] - windows[:, 0]) / (4.0 * epsilon)
    dims = ("half_width", "gamma")
    largest = [widest_gamma(epsilon, 2 * m + 1, boundary) for m in half_widths]
    return table(
        "Windows of stability of finite chains inside [0, 4 epsilon]",
        {"half_width": np.asarray(half_widths), "gamma": np.asarray(gammas, float)},
        count=variable(count, dims, "number of windows of stability"),
        share=variable(share, dims, "stable share of [0, 4 epsilon]"),
        largest_gamma=variable(largest, ("half_width",), "drive at which the last window closes"),
    )
