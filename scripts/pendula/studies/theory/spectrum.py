"""The linearised operator, assembled from the library's right-hand side, against (15)."""

import numpy as np

from pendula.datasets.checks import table, variable
from pendula.models.amplitudes import rates
from pendula.models.linear_flow import curvatures
from pendula.simulation.lattice import WHOLE, pack

from .linear import squared_frequencies
from .runs import BOUNDARIES, make_chain

TINY = 2.0**-200
"""A power of two so small that the cubic terms vanish below rounding: scaling by it is exact."""


def jacobian(constants, sites: int, boundary: str) -> np.ndarray:
    """Return the real matrix (4N, 4N) of the right-hand side linearised at zero."""
    chain = make_chain(constants, boundary)
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


def predicted_squares(constants, sites: int, boundary: str) -> np.ndarray:
    """Return the squares -omega_1^2, -omega_2^2 of the eigenvalues, each twice, in order."""
    epsilon, gamma, omega = constants
    kappa = epsilon * curvatures(sites, boundary) - omega
    return np.sort(-np.concatenate(2 * squared_frequencies(kappa, gamma)))


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
            constants = (epsilon, gamma, omega)
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
        largest_real_part=variable(largest, dims, "largest real part of an eigenvalue", "1/tau"),
        error=variable(error, dims, "relative error of the squared eigenvalues", tolerance=1e-12),
        factorisation=variable(
            factorisation_error(), (), "printed determinant minus (15)", tolerance=1e-11
        ),
    )
