"""The inequalities (17), (18), (22), (27) and the coercivity bounds (21), (25) on numbers."""

import numpy as np

from pendula.datasets.checks import table, variable

from .bounds import coercivity, extent, theorem_2_gap
from .runs import BOUNDARIES, random_amplitudes, total_energy
from .sampling import draw_shape


def norm(a: np.ndarray, power: float = 2.0) -> float:
    """Return the l-p norm of a sequence."""
    return float(np.sum(np.abs(a) ** power) ** (1.0 / power))


def sequence_ratios(a: np.ndarray, b: np.ndarray) -> list[float]:
    """Return left over right side of (17), (18), (22) and (27), each at most one."""
    padded = np.concatenate([[0.0], a, [0.0]])
    bonds = np.sum(np.abs(np.diff(padded)) ** 2)
    return [
        bonds / (4.0 * norm(a) ** 2),
        norm(a * b) / (norm(a) * norm(b)),
        norm(a, 4.0) / norm(a),
        norm(a) / (len(a) ** 0.25 * norm(a, 4.0)),
    ]


def energy_ratios(rng: np.random.Generator, amplitudes: np.ndarray, boundary: str) -> list[float]:
    """Return (bound - energy) / P of (21), (25), its widened form, and the corrected (3.) bound."""
    epsilon, gamma = rng.uniform(0.2, 2.0), rng.uniform(0.0, 2.0)
    power, sites = norm(amplitudes) ** 2, amplitudes.shape[1]
    high, low = 2.0 * gamma + 4.0 * epsilon + 1.0, -2.0 * gamma - rng.uniform(0.1, 4.0)
    upper = total_energy((epsilon, gamma, high), boundary, amplitudes)
    constants = (epsilon, gamma, low)
    energy = total_energy(constants, boundary, amplitudes)
    gap = theorem_2_gap(constants)
    widened = float(coercivity(power, constants)) if boundary == "dirichlet" else -np.inf
    finite = power**2 / (8.0 * sites) - extent(constants) * power
    return [
        power - upper,
        gap * power - power**2 / 4.0 + energy,
        widened + energy,
        finite - energy,
    ]


def check_inequalities(count: int, seed: int = 12) -> dict:
    """Test every inequality of Section 4 on random states, and on those that make them sharp."""
    rng = np.random.default_rng(seed)
    ratios, excess = [], []
    for sample in range(count):
        sites = 2 * int(rng.integers(0, 7)) + 1
        amplitudes = rng.uniform(0.1, 6.0) * draw_shape(rng, sites)
        other = random_amplitudes(rng, sites, 1.0)
        ratios.append(sequence_ratios(amplitudes[0], other[0]))
        excess.append(energy_ratios(rng, amplitudes, BOUNDARIES[sample % 3]))
    wave = (-1.0) ** np.arange(1001)
    one, flat = np.eye(1, 5)[0], np.ones(7)
    sharp = [
        sequence_ratios(wave, wave)[0],
        sequence_ratios(one, one)[1],
        sequence_ratios(one, one)[2],
        sequence_ratios(flat, flat)[3],
    ]
    names, bounds = ["(17)", "(18)", "(22)", "(27)"], ["(21)", "(25)", "(25) widened", "Theorem 3"]
    return table(
        "The inequalities behind the theorems",
        {"inequality": names, "bound": bounds},
        ratio=variable(
            np.max(ratios, axis=0), ("inequality",), "largest left over right", tolerance=1 + 1e-12
        ),
        sharp=variable(sharp, ("inequality",), "the same for the sharpest sequence"),
        excess=variable(
            np.max(excess, axis=0), ("bound",), "largest bound minus energy", tolerance=1e-10
        ),
    )
