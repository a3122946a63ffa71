"""The inequalities behind Lemma 2 and Theorems 1 to 3, on random states and on the sharpest ones.

(17), (18), (22) and (27) are on sequences; (21) and (25), its widened form, and the bounds of
Theorem 3's proof and of the size of H, are on the energy.
"""

from dataclasses import replace

import numpy as np

from pendula.datasets.checks import table, variable
from pendula.ends import DIRICHLET, kind_of
from pendula.measures.norms import power_of
from pendula.models.bounds import coercivity, extent, theorem_2_gap
from pendula.numerics.draws import uniform
from pendula.numerics.elementary import product, square_modulus
from pendula.problem import Constants

from .equations import (
    BOUNDARIES,
    alternating,
    draw_shape,
    misstated,
    random_amplitudes,
    total_energy,
)

LONGEST = 13
"""The longest chain that is drawn."""


def sequence_ratios(a: np.ndarray, b: np.ndarray) -> list[float]:
    """Return left over right side of (17), (18), (22) and (27), each at most one."""

    def norm(sequence: np.ndarray) -> float:
        return float(np.sqrt(np.sum(square_modulus(sequence))))

    bonds = np.sum(square_modulus(np.diff(np.pad(a, 1))))
    four = float(np.sqrt(np.sqrt(np.sum(square_modulus(a) ** 2))))  # the l4 norm
    return [
        bonds / (4.0 * norm(a) * norm(a)),
        norm(product(a, b)) / (norm(a) * norm(b)),
        four / norm(a),
        norm(a) / (np.sqrt(np.sqrt(len(a))) * four),
    ]


def draw_range(rng: np.random.Generator) -> tuple[Constants, Constants]:
    """Return constants in the range of Theorem 1 and in that of Theorem 2."""
    epsilon, gamma = uniform(rng, 0.2, 2.0), uniform(rng, 0.5, 2.0)
    high, low = 2.0 * gamma + 4.0 * epsilon + 1.0, -2.0 * gamma - uniform(rng, 0.1, 4.0)
    low = Constants(epsilon=epsilon, gamma=gamma, omega=low)
    return replace(low, omega=high), low


def energy_excess(
    high: Constants, low: Constants, amplitudes: np.ndarray, boundary: str, gamma_times: float
) -> list[float]:
    """Return (lower bound - energy) / P of each bound on the energy; none is above zero.

    (25) and its widened form are on -H. The size of H is bounded by c P + P^2 / 4. A statement
    may have another gamma.
    """
    power, sites = power_of(amplitudes), amplitudes.shape[1]
    upper, energy = (total_energy(k, boundary, amplitudes) for k in (high, low))
    high, low = (misstated(k, gamma_times=gamma_times) for k in (high, low))
    margin = high.omega - 2.0 * high.gamma - 4.0 * high.epsilon
    widened = float(coercivity(power, low)) if kind_of(boundary) == DIRICHLET else -np.inf
    found = [
        margin * power - upper,
        theorem_2_gap(low) * power - power * power / 4.0 + energy,
        widened + energy,
        power * power / (8.0 * sites) - extent(low) * power - energy,
        abs(energy) - extent(low) * power - power * power / 4.0,
    ]
    return [one / power for one in found]


def check_inequalities(count: int, seed: int, gamma_times: float = 1.0, scale: float = 1.0) -> dict:
    """Test every inequality on random states, and on those that make it sharp.

    A control states them with `scale` times their right sides, and with `gamma_times` the drive.
    """
    rng = np.random.default_rng(seed)
    ratios, excess = [], []
    for sample in range(count):
        sites = int(rng.integers(1, LONGEST + 1)) // 2 * 2 + 1
        amplitudes = uniform(rng, 0.1, 6.0) * draw_shape(rng, sites)
        other = random_amplitudes(rng, sites, 1.0)
        boundary, (high, low) = BOUNDARIES[sample % 3], draw_range(rng)
        ratios.append(sequence_ratios(amplitudes[0], other[0]))
        # the small A = -B that come nearest to (21) and to (25), and -H to its largest size
        wave = alternating(sites, 1e-3)[0]
        edges = [np.stack([a, -a]) for a in (wave, np.full(sites, 1e-3j), 1j * wave)]
        for state in (amplitudes, *edges):
            excess.append(energy_excess(high, low, state, boundary, gamma_times))
    wave, one, flat = alternating(1001, 1.0)[0], np.eye(1, 5)[0], np.ones(7)
    sharp = np.diag([sequence_ratios(a, a) for a in (wave, one, one, flat)])
    largest = np.maximum(np.max(ratios, axis=0), sharp) / scale
    coords = {
        "inequality": ["(17)", "(18)", "(22)", "(27)"],
        "bound": ["(21)", "(25)", "(25) widened", "Theorem 3", "size"],
    }
    return table(
        "The inequalities behind the theorems",
        coords,
        left_over_right=variable(
            largest, ("inequality",), "largest left over right side", tolerance=1.0 + 1e-12
        ),
        sharp=variable(sharp, ("inequality",), "the same for the sharpest sequence"),
        bound_excess=variable(
            np.max(excess, axis=0),
            ("bound",),
            "largest of bound minus energy, over P",
            tolerance=1e-10,
        ),
    )
