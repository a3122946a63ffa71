"""Random data inside the proven regions of Theorems 1 to 3: the bounds must never be broken."""

import numpy as np

from pendula.datasets.checks import table, variable

from .bounds import (
    theorem_1_bound,
    theorem_2_bound,
    theorem_2_constants,
    theorem_2_gap,
    theorem_3_bound,
    widened_barrier,
    widened_bound,
)
from .runs import BOUNDARIES, mean_spacing, run_powers, total_energy

FAMILIES = ("theorem_1", "theorem_2_ball", "theorem_2_energy", "theorem_2_widened", "theorem_3")


def draw_constants(rng: np.random.Generator, family: str) -> tuple[float, float, float]:
    """Return (epsilon, gamma, Omega) inside the range of parameters of a family."""
    epsilon, gamma = rng.uniform(0.2, 2.0), rng.uniform(0.0, 2.0)
    if family == "theorem_1":
        return epsilon, gamma, 2.0 * gamma + 4.0 * epsilon + rng.exponential(1.0)
    if family == "theorem_3":
        return epsilon, gamma, rng.uniform(-6.0, 10.0)
    return epsilon, gamma, -2.0 * gamma - rng.uniform(0.1, 4.0)


def draw_shape(rng: np.random.Generator, sites: int) -> np.ndarray:
    """Return amplitudes (2, N) of norm one: from a single pair to the whole chain, any phases."""
    reach = rng.choice([0.0, 0.5, 1.5, 1e9])
    distance = np.abs(np.arange(sites) - rng.integers(sites))
    envelope = np.where(distance <= reach, 1.0, 0.0) if reach < 1 else np.exp(-distance / reach)
    drawn = envelope * (rng.normal(size=(2, sites)) + 1j * rng.normal(size=(2, sites)))
    if rng.random() < 0.5:
        drawn[1] = -drawn[0]  # the subspace that the drive acts on
    return drawn / np.sqrt(np.sum(np.abs(drawn) ** 2))


def largest_power(family: str, constants) -> float:
    """Return the largest P(0) to draw for a family."""
    if family == "theorem_2_ball":
        return 0.999 * theorem_2_constants(constants)[0]
    if family == "theorem_2_energy":
        return 2.0 * theorem_2_gap(constants)
    if family == "theorem_2_widened":
        return widened_barrier(constants)[0]
    return 60.0


def bound(family: str, energy, start, sites: int, constants):
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


def draw_case(rng: np.random.Generator, family: str, sites: int):
    """Return (constants, boundary, amplitudes, bound on P) inside a family's region."""
    while True:
        constants = draw_constants(rng, family)
        boundary = "dirichlet" if family == "theorem_2_widened" else str(rng.choice(BOUNDARIES))
        power = largest_power(family, constants) * rng.uniform(1e-3, 1.0) ** 2
        amplitudes = np.sqrt(power) * draw_shape(rng, sites)
        energy = total_energy(constants, boundary, amplitudes)
        limit = float(bound(family, energy, power, sites, constants))
        if np.isfinite(limit):
            return constants, boundary, amplitudes, limit


def check_samples(count: int, end_time: float, sizes=(1, 3, 5, 9), seed: int = 9) -> dict:
    """Run `count` random cases of each size inside each region; compare the largest P and bound.

    The parameters are drawn too, and ends of all kinds.
    """
    ratio = np.zeros((len(FAMILIES), len(sizes), count))
    times = mean_spacing(round(10 * end_time), end_time)
    for i, family in enumerate(FAMILIES):
        for j, sites in enumerate(sizes):
            rng = np.random.default_rng([seed, i, j])
            drawn = [draw_case(rng, family, sites) for _ in range(count)]
            constants, boundaries, amplitudes, limits = zip(*drawn, strict=True)
            powers, _ = run_powers(constants, boundaries, amplitudes, times)
            ratio[i, j] = powers.max(axis=1) / limits
    return table(
        "Largest P over its bound for random data inside the proven regions",
        {"family": list(FAMILIES), "sites": np.asarray(sizes), "sample": np.arange(count)},
        ratio=variable(
            ratio, ("family", "sites", "sample"), "largest P over its bound", tolerance=1 + 1e-7
        ),
        worst=variable(ratio.max(axis=(1, 2)), ("family",), "the worst of each family"),
        typical=variable(np.median(ratio, axis=(1, 2)), ("family",), "the median of each family"),
    )
