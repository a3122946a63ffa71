"""Lemma 1 by its proof: the roots (15), the waves that grow, and how sharp its threshold is."""

from itertools import combinations, permutations, product
from math import prod

import numpy as np

from pendula.datasets.checks import table, tabulate, variable
from pendula.models.amplitudes import rates
from pendula.models.linear_chain import (
    curvatures,
    finite_threshold,
    gamma_0,
    modes,
    squared_frequencies,
)
from pendula.numerics.draws import uniform
from pendula.numerics.elementary import log, modulus
from pendula.numerics.matrices import growth_bound, multiply, symmetric_eigenvalues, times
from pendula.problem import Constants
from pendula.simulation.lattice import WHOLE, pack
from pendula.simulation.models import make_chain

from .equations import BOUNDARIES, misstated, random_amplitudes, right_hand_sides, run

TINY = 2.0**-200
"""A power of two so small that the cubic terms vanish below rounding: scaling by it is exact."""
EDGE = 1e-9
"""Nearer than this to |kappa| = 2 |gamma| rounding decides whether a root is real."""


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


def halves(matrix: np.ndarray) -> np.ndarray:
    """Return what the matrix (4N, 4N) is on A = B and on A = -B, shape (2, 2N, 2N)."""
    half = len(matrix) // 2
    own, other = matrix[:half, :half], matrix[:half, half:]
    return np.stack([own + other, own - other])


def lack_of_structure(matrix: np.ndarray) -> float:
    """Return how far the matrix is from what `halves` and `symmetric_eigenvalues` take for granted.

    Exchanging A and B must not change it, and the squares of its halves must be symmetric.
    """
    exchanged = np.roll(matrix, len(matrix) // 2, axis=(0, 1))
    square = multiply(halves(matrix), halves(matrix))
    return max(np.abs(matrix - exchanged).max(), np.abs(square - square.swapaxes(1, 2)).max())


def contradictions(second: np.ndarray, constants: Constants, boundary: str) -> int:
    """Count `second` squared roots that have another sign than 2 |gamma| - |kappa|.

    Those squares and the ones of kappa have one order, both twice.
    """
    kappa = constants.epsilon * curvatures(len(second) // 2, boundary) - constants.omega
    distance = np.repeat(np.sort(2.0 * abs(constants.gamma) - np.abs(kappa)), 2)
    return int(np.sum((np.abs(distance) > EDGE) & ((second > 0.0) != (distance > 0.0))))


def printed_determinant(kappa: float, gamma: float, omega: float) -> float:
    """Return the determinant of the matrix printed above (15)."""
    g = gamma
    matrix = [
        [kappa - omega, g, 0.0, -g],
        [g, kappa + omega, -g, 0.0],
        [0.0, -g, kappa - omega, g],
        [-g, 0.0, g, kappa + omega],
    ]
    total = 0.0
    for order in permutations(range(4)):
        swaps = sum(i > j for i, j in combinations(order, 2))
        total += (-1) ** swaps * prod(matrix[row][order[row]] for row in range(4))
    return total


def factorisation_error(gamma_times: float, samples: int = 200, seed: int = 4) -> float:
    """Return the largest error of the factorised form (15) of that determinant."""
    rng = np.random.default_rng(seed)
    worst = 0.0
    for kappa, gamma, omega in uniform(rng, -3.0, 3.0, (samples, 3)):
        drive, apart = 2.0 * gamma_times * gamma, omega * omega - kappa * kappa
        factors = apart * (apart + drive * drive)
        worst = max(worst, abs(printed_determinant(kappa, gamma, omega) - factors))
    return worst


def check_dispersion(points, epsilon: float, sites: int, gamma_times: float = 1.0) -> dict:
    """Compare the eigenvalues at `points` of (Omega, gamma) with (15) for each kind of ends.

    The linearised operator is assembled from the library's right-hand side. It is not symmetric,
    but its square on A = B and on A = -B is: so squares of eigenvalues are compared, which are
    real, and where two eigenvalues merge their squares keep all digits.
    """
    asked = list(product(BOUNDARIES, points))
    chosen = [Constants(epsilon=epsilon, gamma=gamma, omega=omega) for _, (omega, gamma) in asked]
    matrices = [
        jacobian(constants, sites, boundary)
        for constants, (boundary, _) in zip(chosen, asked, strict=True)
    ]
    parts = np.array([halves(matrix) for matrix in matrices])
    found, rows = symmetric_eigenvalues(multiply(parts, parts)), []
    for constants, (boundary, _), matrix, roots in zip(chosen, asked, matrices, found, strict=True):
        stated = misstated(constants, gamma_times=gamma_times)
        squares = predicted_squares(stated, sites, boundary)
        scale = np.abs(squares).max() + 4.0 * constants.gamma * constants.gamma
        missed = np.abs(np.sort(roots.ravel()) - squares).max()
        rows.append(
            {
                "eigenvalue_error": max(missed, lack_of_structure(matrix)) / scale,
                "first_growth": growth_bound(halves(matrix)[0]),
                "second_growth": np.sqrt(max(0.0, roots[1, -1])),
                "contradictions": contradictions(roots[1], stated, boundary),
            }
        )
    omegas, gammas = zip(*points, strict=True)
    return tabulate(
        "Eigenvalues of the linearised right-hand side against the dispersion relation (15)",
        {"boundary": BOUNDARIES, "point": np.arange(len(points))},
        rows,
        {
            "eigenvalue_error": ("relative error of the squared eigenvalues", 1e-12),
            "first_growth": ("bound of the growth rate of the first pair, per unit of tau", 1e-12),
            "second_growth": ("largest growth rate of the second pair, per unit of tau", None),
            "contradictions": ("second roots that are real or not against |kappa| > 2 gamma", 0),
        },
        omega=variable(omegas, ("point",), "detuning Omega"),
        gamma=variable(gammas, ("point",), "strength of the drive, gamma"),
        factorisation=variable(
            factorisation_error(gamma_times), (), "printed determinant minus (15)", tolerance=1e-11
        ),
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
    states = np.zeros((2 * sites, 2, sites), complex)
    states[range(sites), :, range(sites)] = (TINY, -TINY)
    states[range(sites, 2 * sites), :, range(sites)] = (1j * TINY, -1j * TINY)
    found = right_hand_sides(constants, "dirichlet", states)[:, 0] / TINY
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
    stated = gamma_0(np.asarray(omegas, float) + omega_off, epsilon)
    squares = 1.0 / ((sizes + 1.0) * (sizes + 1.0))
    slope = (found[:, -2] - found[:, -1]) / (squares[-2] - squares[-1])
    limit = found[:, -1] - slope * squares[-1]
    gaps = log(found - limit[:, None])
    orders = (gaps[:, 0] - gaps[:, 1]) / log((sizes[1] + 1) / (sizes[0] + 1))
    theta = np.pi / (sizes[-2] + 1.0)
    left = abs(epsilon) * theta * theta * theta * theta
    return table(
        "The drive at which chains at rest lose their stability, against gamma_0",
        {"omega": omegas, "sites": sizes},
        threshold_found=variable(found, ("omega", "sites"), "measured threshold of N sites"),
        threshold_limit=variable(limit, ("omega",), "threshold continued to the infinite chain"),
        threshold_order=variable(
            orders, ("omega",), "order in 1 / (N + 1) of the distance to that"
        ),
        threshold_error=variable(
            np.abs(limit - stated), ("omega",), "distance of that to gamma_0", tolerance=left
        ),
    )


def check_unstable_waves(
    epsilon: float,
    omegas,
    above: float,
    sites: int,
    end_time: float,
    seed: int,
    omega_off: float = 0.0,
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
    at_zero = np.asarray(omegas) + omega_off < 0.0
    nearest = np.where(at_zero, waves[0], waves[-1])
    return table(
        "The wave that grows first above the threshold",
        {"omega": omegas},
        leading_wave=variable(leading, ("omega",), "wave number that leads the growth", "rad"),
        waves_nearer=variable(
            np.round(np.abs(leading - nearest) / waves[0]),
            ("omega",),
            "waves of the chain nearer to the edge of the band that Lemma 1 names",
            tolerance=0,
        ),
    )
