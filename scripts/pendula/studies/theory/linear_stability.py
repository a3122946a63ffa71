"""Lemma 1: the dispersion relation (15), the threshold gamma_0 (12), and those of finite chains.

Rates are per unit of tau. A mode of curvature lambda has kappa = epsilon lambda - Omega; on the
infinite chain lambda covers [0, 4], on N sites it takes N values of its own. The relation is
tested on the linearised operator, assembled from the library's right-hand side.
"""

import numpy as np

from pendula.datasets.checks import table, variable
from pendula.models.amplitudes import rates
from pendula.models.linear_chain import curvatures, squared_frequencies
from pendula.problem import Constants
from pendula.simulation.lattice import WHOLE, pack
from pendula.simulation.simulate import make_chain

from .equations import BOUNDARIES

TINY = 2.0**-200
"""A power of two so small that the cubic terms vanish below rounding: scaling by it is exact."""


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


def jacobian(constants: Constants, sites: int, boundary: str) -> np.ndarray:
    """Return the real matrix (4N, 4N) of the right-hand side linearised at zero."""
    chain = make_chain(constants, boundary, WHOLE)
    y = pack(np.zeros((2, sites), complex), WHOLE)
    dy = np.zeros_like(y)
    columns = []
    for row in range(4):
        for site in range(sites):
            y[:] = 0.0
            y[row, 1 + site] = TINY
            rates(chain, y, dy)
            columns.append(dy[:, 1:-1].ravel() / TINY)
    return np.array(columns).T


def predicted_squares(constants: Constants, sites: int, boundary: str) -> np.ndarray:
    """Return the squares -omega_1^2, -omega_2^2 of the eigenvalues, each twice, in order."""
    kappa = constants.epsilon * curvatures(sites, boundary) - constants.omega
    return np.sort(-np.concatenate(2 * squared_frequencies(kappa, constants.gamma)))


def printed_determinant(kappa: float, gamma: float, omega: float) -> float:
    """Return the determinant of the matrix printed above (15)."""
    g = gamma
    matrix = [
        [kappa - omega, g, 0.0, -g],
        [g, kappa + omega, -g, 0.0],
        [0.0, -g, kappa - omega, g],
        [-g, 0.0, g, kappa + omega],
    ]
    return float(np.linalg.det(np.array(matrix)))


def factorisation_error(samples: int = 200, seed: int = 4) -> float:
    """Return the largest error of the factorised form (15) of that determinant."""
    rng = np.random.default_rng(seed)
    worst = 0.0
    for kappa, gamma, omega in rng.uniform(-3.0, 3.0, (samples, 3)):
        factors = (omega**2 - kappa**2) * (omega**2 - kappa**2 + 4.0 * gamma**2)
        worst = max(worst, abs(printed_determinant(kappa, gamma, omega) - factors))
    return worst


def check_dispersion(points, epsilon: float, sites: int) -> dict:
    """Compare the eigenvalues at `points` of (Omega, gamma) with (15) for each kind of ends.

    Squares of eigenvalues are compared: they are real, so that sorting pairs them safely, and
    where two eigenvalues merge their squares keep all digits.
    """
    points = np.asarray(points, float)
    error = np.zeros((len(BOUNDARIES), len(points)))
    largest = np.zeros(error.shape)
    for i, boundary in enumerate(BOUNDARIES):
        for j, (omega, gamma) in enumerate(points):
            constants = Constants(epsilon=epsilon, gamma=gamma, omega=omega)
            found = np.linalg.eigvals(jacobian(constants, sites, boundary))
            squares = predicted_squares(constants, sites, boundary)
            scale = np.abs(squares).max() + 4.0 * gamma**2
            matched = np.sort((found**2).real) - squares
            error[i, j] = max(np.abs(matched).max(), np.abs((found**2).imag).max()) / scale
            largest[i, j] = found.real.max()
    dims = ("boundary", "point")
    return table(
        "Eigenvalues of the linearised right-hand side against the dispersion relation (15)",
        {"boundary": list(BOUNDARIES), "point": np.arange(len(points))},
        omega=variable(points[:, 0], ("point",), "detuning Omega"),
        gamma=variable(points[:, 1], ("point",), "drive gamma"),
        largest_real_part=variable(
            largest, dims, "largest real part of an eigenvalue, per unit of tau"
        ),
        error=variable(error, dims, "relative error of the squared eigenvalues", tolerance=1e-12),
        factorisation=variable(
            factorisation_error(), (), "printed determinant minus (15)", tolerance=1e-11
        ),
    )
