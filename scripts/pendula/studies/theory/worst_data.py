"""How near data come to the bounds of Theorems 1 to 3: data drawn at random, and the worst found.

Random data lie inside the proven regions, where no bound may be broken. A search finds the worst
ones, which tell how sharp the bounds are. It is the evolution strategy CMA-ES (N. Hansen, The CMA
Evolution Strategy: A Tutorial, arXiv 1604.00772, with its default constants).

The search stands here although the package `cma` has it: its defaults (negative weights) take
another path, so that published numbers would move, it seeds NumPy's global generator, and it would
be one more pin, of 25,000 lines, in place of 70 that one reads beside the tutorial.
"""

from dataclasses import astuple
from functools import partial
from typing import NamedTuple

import numpy as np

from pendula.datasets.checks import table, variable
from pendula.models.bounds import (
    extent,
    theorem_1_bound,
    theorem_2_bound,
    theorem_2_constants,
    theorem_2_gap,
    theorem_3_bound,
    widened_barrier,
    widened_bound,
)
from pendula.models.linear_chain import curvatures
from pendula.problem import Constants

from .equations import BOUNDARIES, draw_shape, misstated, run_powers, total_energy

FAMILIES = ("theorem_1", "theorem_2_ball", "theorem_2_energy", "theorem_2_widened", "theorem_3")


def draw_constants(rng: np.random.Generator, family: str) -> Constants:
    """Return constants inside the range of parameters of a family."""
    epsilon, gamma = rng.uniform(0.2, 2.0), rng.uniform(0.0, 2.0)
    if family == "theorem_1":
        omega = 2.0 * gamma + 4.0 * epsilon + rng.exponential(1.0)
    elif family == "theorem_3":
        omega = rng.uniform(-6.0, 10.0)
    else:
        omega = -2.0 * gamma - rng.uniform(0.1, 4.0)
    return Constants(epsilon=epsilon, gamma=gamma, omega=omega)


def largest_power(family: str, constants: Constants) -> float:
    """Return the largest P(0) to draw for a family."""
    if family == "theorem_2_ball":
        return 0.999 * theorem_2_constants(constants)[0]
    if family == "theorem_2_energy":
        return 2.0 * theorem_2_gap(constants)
    if family == "theorem_2_widened":
        return widened_barrier(constants)[0]
    return 60.0


def bound(family: str, energy, start, sites: int, constants: Constants):
    """Return the bound on P that a family's theorem gives data with this H and P(0), as arrays."""
    if family == "theorem_1":
        return theorem_1_bound(energy, constants)
    if family == "theorem_2_ball":
        return theorem_2_constants(constants)[1] * np.asarray(start)
    if family == "theorem_2_energy":
        return theorem_2_bound(energy, start, constants)
    if family == "theorem_2_widened":
        return widened_bound(energy, start, constants)
    return theorem_3_bound(energy, sites, constants)


def draw_case(rng: np.random.Generator, family: str, sites: int, gamma_times: float):
    """Return (constants, boundary, amplitudes, bound on P) inside a family's region.

    The bound is that of a statement whose gamma is `gamma_times` the right one.
    """
    while True:
        constants = draw_constants(rng, family)
        boundary = "dirichlet" if family == "theorem_2_widened" else str(rng.choice(BOUNDARIES))
        power = largest_power(family, constants) * rng.uniform(1e-3, 1.0) ** 2
        amplitudes = np.sqrt(power) * draw_shape(rng, sites)
        energy = total_energy(constants, boundary, amplitudes)
        stated = misstated(constants, gamma_times=gamma_times)
        limit = float(bound(family, energy, power, sites, stated))
        if np.isfinite(limit):
            return constants, boundary, amplitudes, limit


def check_samples(count: int, end_time: float, sizes, seed: int, gamma_times: float = 1.0) -> dict:
    """Run `count` random cases of each size inside each region; compare the largest P and bound.

    The parameters are drawn too, and ends of all kinds.
    """
    ratio = np.zeros((len(FAMILIES), len(sizes), count))
    outputs = round(10 * end_time)
    for i, family in enumerate(FAMILIES):
        for j, sites in enumerate(sizes):
            rng = np.random.default_rng([seed, i, j])
            drawn = [draw_case(rng, family, sites, gamma_times) for _ in range(count)]
            constants, boundaries, amplitudes, limits = zip(*drawn, strict=True)
            powers, _ = run_powers(constants, boundaries, amplitudes, end_time, outputs)
            ratio[i, j] = powers.max(axis=1) / limits
    return table(
        "Largest P over its bound for random data inside the proven regions",
        {"family": FAMILIES, "sites": sizes, "sample": np.arange(count)},
        sampled=variable(
            ratio, ("family", "sites", "sample"), "largest P over its bound", tolerance=1 + 1e-7
        ),
        worst_sample=variable(ratio.max(axis=(1, 2)), ("family",), "the worst of each family"),
    )


OMEGAS = {"theorem_1": 8.0, "theorem_2": -4.0, "theorem_3": -4.0}
QUESTIONS = [
    (family, boundary)
    for boundary in ("dirichlet", "periodic")
    for family in FAMILIES
    if (family, boundary) != ("theorem_2_widened", "periodic")  # it needs ends at rest
]


def decode(point: np.ndarray, family: str, constants: Constants) -> np.ndarray:
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


def ratios(
    family: str,
    constants: Constants,
    stated: Constants,
    boundary: str,
    end_time: float,
    points: np.ndarray,
) -> np.ndarray:
    """Return the largest P over its bound for each point; negative outside the region."""
    amplitudes = [decode(point, family, constants) for point in points]
    count, sites = len(points), amplitudes[0].shape[1]
    powers, energies = run_powers(
        [constants] * count, [boundary] * count, amplitudes, end_time, round(10 * end_time)
    )
    limits = bound(family, energies, powers[:, 0], sites, stated)
    inside = np.isfinite(limits)
    # outside, the energy leads back to where it lies below the barrier
    return np.where(inside, powers.max(axis=1) / np.where(inside, limits, 1.0), -np.abs(energies))


def supremum(family: str, constants: Constants, sites: int, boundary: str) -> float:
    """Return the ratio that tiny data reach in the mode nearest to the theorem's estimate.

    For Theorem 1 the mode of largest curvature, for Theorem 2 that of the smallest; the ball of
    Theorem 2 asks for growth, whose linear value is (kappa + 2 gamma) / (kappa - 2 gamma). The
    constant of Theorem 3 is reached by |A_n| = |B_n|, A = -B, alternating, on an even ring.
    """
    epsilon, gamma, omega = astuple(constants)
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
    gamma: float,
    epsilon: float,
    sites: int,
    end_time: float,
    generations: int,
    population: int,
    seed: int,
    gamma_times: float = 1.0,
) -> dict:
    """Search data on N sites, ends at rest or joined, for the largest P over each bound."""
    searches, known = [], []
    for number, (family, boundary) in enumerate(QUESTIONS):
        constants = Constants(epsilon=epsilon, gamma=gamma, omega=OMEGAS[family[:9]])
        start = np.random.default_rng([seed, number]).normal(size=4 * sites + 1)
        stated = misstated(constants, gamma_times=gamma_times)
        objective = partial(ratios, family, constants, stated, boundary, end_time)
        searches.append(maximise(objective, start, 1.0, generations, population, seed))
        known.append(supremum(family, constants, sites, boundary))
    dims = ("question",)
    _, found, history = zip(*searches, strict=True)
    families, boundaries = zip(*QUESTIONS, strict=True)
    return table(
        f"The worst data found on {sites} sites for the bounds of Theorems 1 to 3",
        {
            "question": [f"{family}, {boundary}" for family, boundary in QUESTIONS],
            "generation": np.arange(1, generations + 1),
        },
        sites=variable(sites, (), "number of sites N"),
        searched_family=variable(families, dims, "family of the bound"),
        boundary=variable(boundaries, dims, "ends of the chain"),
        worst=variable(found, dims, "largest P over its bound found", tolerance=1.0 + 1e-7),
        small_data=variable(known, dims, "its value for tiny data in the nearest mode"),
        progress=variable(history, ("question", "generation"), "best after each generation"),
        attained=variable(
            attained_theorem_3(epsilon, gamma, gamma_times),
            (),
            "P over C_N on a ring of two",
            tolerance=1.0 + 1e-7,
        ),
    )


def attained_theorem_3(epsilon: float, gamma: float, gamma_times: float = 1.0) -> float:
    """Return P / C_N for the state at which Theorem 3's bound is attained: it must be one.

    On a ring of two sites A = -B = (x, -x) with x^2 = 2 c, which is the larger root of
    P^2 / (8 N) - c P = H.
    """
    constants = Constants(epsilon=epsilon, gamma=gamma, omega=OMEGAS["theorem_3"])
    x = np.sqrt(2.0 * extent(constants)) * np.array([1.0, -1.0])
    amplitudes = np.stack([x, -x]).astype(complex)
    energy = ring_energy(constants, amplitudes)
    stated = misstated(constants, gamma_times=gamma_times)
    return float(np.sum(np.abs(amplitudes) ** 2) / bound("theorem_3", energy, 0.0, 2, stated))


def ring_energy(constants: Constants, amplitudes: np.ndarray) -> float:
    """Return H of (8) on a ring with any number of sites, written apart from the library's."""
    epsilon, gamma, omega = astuple(constants)
    density = np.abs(amplitudes) ** 2
    difference = amplitudes[0] - amplitudes[1]
    bonds = np.sum(np.abs(np.roll(amplitudes, -1, axis=1) - amplitudes) ** 2)
    drive = gamma * np.sum((difference**2).real)
    return float(np.sum(0.25 * density**2 + omega * density) - drive - epsilon * bonds)


class Settings(NamedTuple):
    """The strategy's constants, all functions of the dimension and the size of a generation."""

    weights: np.ndarray
    mu_eff: float
    path_sigma: float
    damping: float
    path_c: float
    rank_one: float
    rank_mu: float
    typical_length: float


def settings(n: int, size: int) -> Settings:
    """Return the tutorial's default constants for n dimensions and generations of `size`."""
    weights = np.log(0.5 * (size + 1)) - np.log(np.arange(1, size // 2 + 1))
    weights /= weights.sum()
    mu = 1.0 / np.sum(weights**2)
    path_sigma = (mu + 2.0) / (n + mu + 5.0)
    damping = 1.0 + 2.0 * max(0.0, np.sqrt((mu - 1.0) / (n + 1.0)) - 1.0) + path_sigma
    path_c = (4.0 + mu / n) / (n + 4.0 + 2.0 * mu / n)
    rank_one = 2.0 / ((n + 1.3) ** 2 + mu)
    rank_mu = min(1.0 - rank_one, 2.0 * (mu - 2.0 + 1.0 / mu) / ((n + 2.0) ** 2 + mu))
    length = np.sqrt(n) * (1.0 - 1.0 / (4.0 * n) + 1.0 / (21.0 * n * n))
    return Settings(weights, mu, path_sigma, damping, path_c, rank_one, rank_mu, length)


def maximise(objective, start: np.ndarray, spread: float, generations: int, size: int, seed: int):
    """Return (best point, best value, best value after each generation).

    `objective` maps points (size, n) to values (size,). Starts from `start` with steps of
    `spread` in every direction.
    """
    rng = np.random.default_rng(seed)
    n, mean, sigma = len(start), np.array(start, float), spread
    s = settings(n, size)
    covariance, drift, path = np.eye(n), np.zeros(n), np.zeros(n)
    best_point, best, history = mean, -np.inf, []
    for generation in range(generations):
        scales, axes = np.linalg.eigh(covariance)
        scales = np.sqrt(np.maximum(scales, 1e-30))
        steps = (rng.normal(size=(size, n)) * scales) @ axes.T
        values = objective(mean + sigma * steps)
        order = np.argsort(-values)
        if values[order[0]] > best:
            best, best_point = float(values[order[0]]), mean + sigma * steps[order[0]]
        history.append(best)
        kept = steps[order[: len(s.weights)]]
        move = s.weights @ kept
        mean = mean + sigma * move
        white = axes @ ((axes.T @ move) / scales)
        drift = (1 - s.path_sigma) * drift + np.sqrt(
            s.path_sigma * (2 - s.path_sigma) * s.mu_eff
        ) * white
        length = np.linalg.norm(drift)
        fade = np.sqrt(1 - (1 - s.path_sigma) ** (2 * generation + 2))
        steady = float(length / fade < (1.4 + 2 / (n + 1)) * s.typical_length)
        path = (1 - s.path_c) * path + steady * np.sqrt(s.path_c * (2 - s.path_c) * s.mu_eff) * move
        missed = (1 - steady) * s.path_c * (2 - s.path_c)
        covariance = (1 - s.rank_one - s.rank_mu + s.rank_one * missed) * covariance
        covariance += s.rank_one * np.outer(path, path) + s.rank_mu * (kept.T * s.weights) @ kept
        sigma *= np.exp(s.path_sigma / s.damping * (length / s.typical_length - 1))
    return best_point, best, np.array(history)
