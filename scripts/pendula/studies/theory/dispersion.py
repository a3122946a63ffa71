"""Lemma 1 by its proof: the roots (15), the waves that grow, and how sharp its threshold is."""

from itertools import combinations, permutations, product
from math import prod

import numpy as np

from pendula.datasets.checks import table, tabulate, variable
from pendula.models.linear_chain import (
    curvatures,
    finite_threshold,
    gamma_0,
    modes,
    squared_frequencies,
)
from pendula.numerics.draws import uniform
from pendula.numerics.elementary import complex_of, log, modulus
from pendula.numerics.matrices import growth_bound, multiply, symmetric_eigenvalues, times
from pendula.problem import Constants

from .equations import BOUNDARIES, misstated, random_amplitudes, right_hand_side, run

TINY = 2.0**-200
"""A power of two so small that the cubic terms vanish below rounding: scaling by it is exact."""
EDGE = 1e-9
"""Nearer than this to |kappa| = 2 |gamma| rounding decides whether a root is real."""


def jacobian(constants: Constants, sites: int, boundary: str) -> np.ndarray:
    """Return the real matrix (4N, 4N) of the right-hand side linearised at zero."""
    units = TINY * np.eye(4 * sites).reshape(-1, 2, 2, sites)  # of A and B, real and imaginary part
    data = complex_of(units[:, :, 0], units[:, :, 1])
    found = right_hand_side(constants, boundary, data) / TINY
    return np.stack([found.real, found.imag], axis=2).reshape(4 * sites, -1).T


def halves(matrix: np.ndarray) -> np.ndarray:
    """Return what the matrix (4N, 4N) is on A = B and on A = -B, shape (2, 2N, 2N)."""
    half = len(matrix) // 2
    own, other = matrix[:half, :half], matrix[:half, half:]
    return np.stack([own + other, own - other])


def asymmetry(matrix: np.ndarray) -> float:
    """Return how far the matrix is from what `halves` and `symmetric_eigenvalues` require.

    Exchanging A and B must not change it, and the squares of its halves must be symmetric.
    """
    exchanged = np.roll(matrix, len(matrix) // 2, axis=(0, 1))
    square = multiply(halves(matrix), halves(matrix))
    return max(np.abs(matrix - exchanged).max(), np.abs(square - square.swapaxes(1, 2)).max())


def factorisation_error(gamma_times: float) -> float:
    """Return the largest error of the factorised form (15) of the determinant printed above it."""
    worst = 0.0
    for kappa, g, omega in uniform(np.random.default_rng(4), -3.0, 3.0, (200, 3)):
        matrix = [
            [kappa - omega, g, 0.0, -g],
            [g, kappa + omega, -g, 0.0],
            [0.0, -g, kappa - omega, g],
            [-g, 0.0, g, kappa + omega],
        ]
        printed = 0.0
        for order in permutations(range(4)):
            swaps = sum(i > j for i, j in combinations(order, 2))
            printed += (-1) ** swaps * prod(matrix[row][order[row]] for row in range(4))
        drive, apart = 2.0 * gamma_times * g, omega * omega - kappa * kappa
        worst = max(worst, abs(printed - apart * (apart + drive * drive)))
    return worst


def check_dispersion(points, epsilon: float, sites: int, gamma_times: float = 1.0) -> dict:
    """Compare the eigenvalues at `points` of (Omega, gamma) with (15) for each kind of ends.

    The linearised operator is assembled from the library's right-hand side. It is not symmetric,
    but its square on A = B and on A = -B is: so squares of eigenvalues are compared, which are
    real, and where two eigenvalues merge their squares keep all digits.
    """
    asked = [
        (boundary, Constants(epsilon=epsilon, gamma=gamma, omega=omega))
        for boundary, (omega, gamma) in product(BOUNDARIES, points)
    ]
    matrices = [jacobian(constants, sites, boundary) for boundary, constants in asked]
    parts = np.array([halves(matrix) for matrix in matrices])
    found, rows = symmetric_eigenvalues(multiply(parts, parts)), []
    for (boundary, constants), matrix, roots in zip(asked, matrices, found, strict=True):
        stated = misstated(constants, gamma_times=gamma_times)
        kappa = epsilon * curvatures(sites, boundary) - stated.omega
        squares = np.sort(-np.concatenate(2 * squared_frequencies(kappa, stated.gamma)))
        scale = np.abs(squares).max() + 4.0 * constants.gamma * constants.gamma
        missed = np.abs(np.sort(roots.ravel()) - squares).max()
        # the second roots and the squares of kappa have one order, both twice
        distance = np.repeat(np.sort(2.0 * abs(stated.gamma) - np.abs(kappa)), 2)
        contradicts = (np.abs(distance) > EDGE) & ((roots[1] > 0.0) != (distance > 0.0))
        row = {
            "eigenvalue_error": max(missed, asymmetry(matrix)) / scale,
            "first_growth": growth_bound(halves(matrix)[0]),
            "second_growth": np.sqrt(max(0.0, roots[1, -1])),
            "contradictions": int(np.sum(contradicts)),
        }
        rows.append(row)
    omegas, gammas = zip(*points, strict=True)
    about = {
        "eigenvalue_error": ("relative error of the squared eigenvalues", 1e-12),
        "first_growth": ("bound of the growth rate of the first pair, per unit of tau", 1e-12),
        "second_growth": "largest growth rate of the second pair, per unit of tau",
        "contradictions": ("second roots that are real or not against |kappa| > 2 gamma", 0),
    }
    error = factorisation_error(gamma_times)
    return tabulate(
        "Eigenvalues of the linearised right-hand side against the dispersion relation (15)",
        {"boundary": BOUNDARIES, "point": np.arange(len(points))},
        rows,
        about,
        omega=variable(omegas, ("point",), "detuning Omega"),
        gamma=variable(gammas, ("point",), "strength of the drive, gamma"),
        factorisation=variable(error, (), "printed determinant minus (15)", tolerance=1e-11),
    )


def is_definite(diagonal: np.ndarray, beside: np.ndarray, sign: float) -> bool:
    """Return whether `sign` times a symmetric tridiagonal matrix has positive pivots only."""
    pivot = sign * diagonal[0]
    for entry, link in zip(diagonal[1:], beside, strict=True):
        if pivot <= 0.0:
            return False
        pivot = sign * entry - link * link / pivot
    return pivot > 0.0


def is_stable(constants: Constants, sites: int) -> bool:
    """Return whether a Dirichlet chain is stable at rest, for Omega outside [0, 4 epsilon].

    On A = -B the real part drives the imaginary one by kappa + 2 gamma, and that drives the real
    part by 2 gamma - kappa; the matrices, which commute, are read off the library's right-hand
    side. Nothing grows if kappa + 2 gamma and kappa - 2 gamma are both positive or both negative.
    """
    units = TINY * np.eye(sites)
    data = np.concatenate([units, 1j * units])[:, None] * [[1.0], [-1.0]]
    found = right_hand_side(constants, "dirichlet", data)[:, 0] / TINY
    from_real, from_imaginary = found[:sites].imag, -found[sites:].real
    sign = 1.0 if constants.omega < 0.0 else -1.0
    return all(
        is_definite(np.diag(matrix), np.diag(matrix, 1), sign)
        for matrix in (from_real, from_imaginary)
    )


def measured_threshold(epsilon: float, omega: float, sites: int) -> float:
    """Return the drive at which a Dirichlet chain at rest loses its stability, by bisection."""
    low, high = 0.0, 2.0 * abs(omega) + 1.0
    while high - low > 1e-9:
        middle = 0.5 * (low + high)
        stable = is_stable(Constants(epsilon=epsilon, gamma=middle, omega=omega), sites)
        low, high = (middle, high) if stable else (low, middle)
    return 0.5 * (low + high)


def check_sharp_threshold(epsilon: float, omegas, sizes, omega_off: float = 0.0) -> dict:
    """Measure thresholds of ever longer chains and continue them to the infinite one.

    The nearest wave of a chain has its wave number pi / (N + 1) off the band's edge, so that its
    threshold lies above gamma_0 by about a square of it. From the last two chains that square is
    taken off; what is left is its square again.
    """
    sizes = np.asarray(sizes)
    found = np.array([[measured_threshold(epsilon, w, int(n)) for n in sizes] for w in omegas])
    squares = 1.0 / ((sizes + 1.0) * (sizes + 1.0))
    slope = (found[:, -2] - found[:, -1]) / (squares[-2] - squares[-1])
    limit = found[:, -1] - slope * squares[-1]
    gaps = log(found - limit[:, None])
    orders = (gaps[:, 0] - gaps[:, 1]) / log((sizes[1] + 1) / (sizes[0] + 1))
    missed = np.abs(limit - gamma_0(np.asarray(omegas, float) + omega_off, epsilon))
    theta = np.pi / (sizes[-2] + 1.0)
    left, dims = abs(epsilon) * theta * theta * theta * theta, ("omega",)
    return table(
        "The drive at which chains at rest lose their stability, against gamma_0",
        {"omega": omegas, "sites": sizes},
        threshold_found=variable(found, ("omega", "sites"), "measured threshold of N sites"),
        threshold_limit=variable(limit, dims, "threshold continued to the infinite chain"),
        threshold_order=variable(orders, dims, "order in 1 / (N + 1) of the distance to that"),
        threshold_error=variable(missed, dims, "distance of that to gamma_0", tolerance=left),
    )


def check_unstable_waves(
    epsilon: float, omegas, above: float, sites: int, end_time: float, seed: int, omega_off=0.0
) -> dict:
    """Find the wave that leads the growth of tiny random data, `above` the chain's threshold.

    Lemma 1 says which: near theta = 0 if Omega < 0, near pi if Omega > 4 epsilon.
    """
    data = 1e-130 * random_amplitudes(np.random.default_rng(seed), sites, 1.0)
    waves = np.pi * np.arange(1, sites + 1) / (sites + 1)
    solver = {"name": "dop853", "rtol": 1e-9, "atol": 1e-140}
    leading = []
    for omega in omegas:
        gamma = above + float(finite_threshold(omega, epsilon, sites, "dirichlet"))
        constants = Constants(epsilon=epsilon, gamma=gamma, omega=omega)
        final = run(constants, "dirichlet", data, end_time, solver=solver).final
        parts = modulus(times(modes(sites, "dirichlet"), final[0] - final[1]))
        leading.append(waves[np.argmax(parts)])
    nearest = np.where(np.asarray(omegas) + omega_off < 0.0, waves[0], waves[-1])
    nearer = np.round(np.abs(leading - nearest) / waves[0])
    says = "waves of the chain nearer to the edge of the band that Lemma 1 names"
    return table(
        "The wave that grows first above the threshold",
        {"omega": omegas},
        leading_wave=variable(leading, ("omega",), "wave number that leads the growth", "rad"),
        waves_nearer=variable(nearer, ("omega",), says, tolerance=0),
    )
