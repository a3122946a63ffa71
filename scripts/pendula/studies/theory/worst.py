"""How sharp Theorems 1 to 3 are: the largest P over its bound, searched for by optimisation."""

import numpy as np

from pendula.datasets.checks import table, variable
from pendula.models.linear_flow import curvatures

from .bounds import extent, theorem_2_constants, theorem_2_gap
from .runs import mean_spacing, run_powers
from .sampling import FAMILIES, bound, largest_power
from .search import maximise

OMEGAS = {"theorem_1": 8.0, "theorem_2": -4.0, "theorem_3": -4.0}
QUESTIONS = [
    (family, boundary)
    for boundary in ("dirichlet", "periodic")
    for family in FAMILIES
    if (family, boundary) != ("theorem_2_widened", "periodic")  # it needs ends at rest
]


def decode(point: np.ndarray, family: str, constants) -> np.ndarray:
    """Return the amplitudes (2, N) that a point of the search (4N + 1 numbers) stands for.

    The last number sets P(0): squeezed into the allowed range where there is one.
    """
    raw = point[:-1].reshape(4, -1)
    shape = np.stack([raw[0] + 1j * raw[1], raw[2] + 1j * raw[3]])
    shape = shape / np.sqrt(np.sum(np.abs(shape) ** 2))
    if family in ("theorem_1", "theorem_3"):
        return np.exp(np.clip(point[-1], -8.0, 2.7)) * shape
    share = 1.0 / (1.0 + np.exp(-np.clip(point[-1], -30.0, 30.0)))
    return np.sqrt(share * largest_power(family, constants)) * shape


def ratios(points: np.ndarray, family: str, constants, boundary: str, times) -> np.ndarray:
    """Return the largest P over its bound for each point; negative outside the region."""
    amplitudes = [decode(point, family, constants) for point in points]
    count, sites = len(points), amplitudes[0].shape[1]
    powers, energies = run_powers([constants] * count, [boundary] * count, amplitudes, times)
    limits = bound(family, energies, powers[:, 0], sites, constants)
    inside = np.isfinite(limits)
    # outside, the energy leads back to where it lies below the barrier
    return np.where(inside, powers.max(axis=1) / np.where(inside, limits, 1.0), -np.abs(energies))


def supremum(family: str, constants, sites: int, boundary: str) -> float:
    """Return the ratio that tiny data reach in the mode nearest to the theorem's estimate.

    For Theorem 1 the mode of largest curvature, for Theorem 2 that of the smallest; the ball of
    Theorem 2 asks for growth, whose linear value is (kappa + 2 gamma) / (kappa - 2 gamma). The
    constant of Theorem 3 is reached by |A_n| = |B_n|, A = -B, alternating, on an even ring.
    """
    epsilon, gamma, omega = constants
    kappa = epsilon * curvatures(sites, boundary) - omega
    if family == "theorem_1":
        return (omega - 2 * gamma - 4 * epsilon) / (np.abs(kappa).min() - 2 * gamma)
    least = np.abs(kappa).min()
    if family == "theorem_2_ball":
        return (least + 2 * gamma) / (least - 2 * gamma) / theorem_2_constants(constants)[1]
    if family == "theorem_3":
        return 1.0
    return theorem_2_gap(constants) / (least - 2 * gamma)


def check_worst(
    gamma: float, epsilon: float, sites: int, end_time: float, generations: int, seed: int = 10
) -> dict:
    """Search data on N sites, ends at rest or joined, for the largest P over each bound."""
    times = mean_spacing(round(10 * end_time), end_time)
    found, known, history = [], [], []
    for number, (family, boundary) in enumerate(QUESTIONS):
        constants = (epsilon, gamma, OMEGAS[family[:9]])
        start = np.random.default_rng([seed, number]).normal(size=4 * sites + 1)
        best = maximise(
            lambda points, f=family, k=constants, b=boundary: ratios(points, f, k, b, times),
            start,
            1.0,
            generations,
            24,
            seed,
        )
        found.append(best[1])
        history.append(best[2])
        known.append(supremum(family, constants, sites, boundary))
    dims = ("question",)
    families, boundaries = zip(*QUESTIONS, strict=True)
    return table(
        f"The worst data found on {sites} sites for the bounds of Theorems 1 to 3",
        {
            "question": [f"{family}, {boundary}" for family, boundary in QUESTIONS],
            "generation": np.arange(1, generations + 1),
        },
        sites=variable(sites, (), "number of sites N"),
        family=variable(families, dims, "which bound"),
        boundary=variable(boundaries, dims, "ends of the chain"),
        worst=variable(found, dims, "largest P over its bound found", tolerance=1.0 + 1e-7),
        small_data=variable(known, dims, "its value for tiny data in the nearest mode"),
        progress=variable(history, ("question", "generation"), "best after each generation"),
        attained=variable(attained_theorem_3(epsilon, gamma), (), "P over C_N on a ring of two"),
    )


def attained_theorem_3(epsilon: float, gamma: float, omega: float = -4.0) -> float:
    """Return P / C_N for the state at which Theorem 3's bound is attained: it must be one.

    On a ring of two sites A = -B = (x, -x) with x^2 = 2 c, which is the larger root of
    P^2 / (8 N) - c P = H.
    """
    constants = (epsilon, gamma, omega)
    x = np.sqrt(2.0 * extent(constants)) * np.array([1.0, -1.0])
    amplitudes = np.stack([x, -x]).astype(complex)
    energy = ring_energy(constants, amplitudes)
    return float(np.sum(np.abs(amplitudes) ** 2) / bound("theorem_3", energy, 0.0, 2, constants))


def ring_energy(constants, amplitudes: np.ndarray) -> float:
    """Return H of (8) on a ring with any number of sites, written apart from the library's."""
    epsilon, gamma, omega = constants
    density = np.abs(amplitudes) ** 2
    difference = amplitudes[0] - amplitudes[1]
    bonds = np.sum(np.abs(np.roll(amplitudes, -1, axis=1) - amplitudes) ** 2)
    drive = gamma * np.sum((difference**2).real)
    return float(np.sum(0.25 * density**2 + omega * density) - drive - epsilon * bonds)
