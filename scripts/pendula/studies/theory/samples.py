"""How near random data come to the bounds of Theorems 1 to 3, inside the regions of these."""

from dataclasses import replace

import numpy as np
from latticode.datasets.checks import table, variable
from latticode.numerics.draws import exponential, uniform

from pendula.models import bounds
from pendula.problem import Constants

from .equations import BOUNDARIES, draw_shape, run_powers, total_energy

BOUNDS = {
    "theorem_1": lambda energy, start, sites, k: bounds.theorem_1_bound(energy, k),
    "theorem_2_ball": lambda energy, start, sites, k: bounds.theorem_2_constants(k)[1] * start,
    "theorem_2_energy": lambda energy, start, sites, k: bounds.theorem_2_bound(energy, start, k),
    "theorem_2_widened": lambda energy, start, sites, k: bounds.widened_bound(energy, start, k),
    "theorem_3": lambda energy, start, sites, k: bounds.theorem_3_bound(energy, sites, k),
}
"""What each family's theorem gives for a bound on P of data with this H and P(0), as arrays."""
FAMILIES = tuple(BOUNDS)
LARGEST = {
    "theorem_1": lambda k: 60.0,
    "theorem_2_ball": lambda k: 0.999 * bounds.theorem_2_constants(k)[0],
    "theorem_2_energy": lambda k: 2.0 * bounds.theorem_2_gap(k),
    "theorem_2_widened": lambda k: bounds.widened_barrier(k)[0],
    "theorem_3": lambda k: 60.0,
}
"""The largest P(0) to draw for each family."""


OMEGAS = {"theorem_1": 8.0, "theorem_2": -4.0, "theorem_3": -4.0}
"""The detuning at which the bounds of each theorem are asked for."""
LIMIT = 1.0 + 1e-7
"""The largest P over its bound that solvers and rounding can lead to."""


def draw_case(rng: np.random.Generator, family: str, sites: int):
    """Return (constants, boundary, amplitudes, bounds on P) inside a family's region.

    The second bound is what the first would be if nothing drove the chain.
    """
    while True:
        epsilon, gamma = uniform(rng, 0.2, 2.0), uniform(rng, 0.0, 2.0)
        if family == "theorem_1":
            omega = 2.0 * gamma + 4.0 * epsilon + exponential(rng)
        elif family == "theorem_3":
            omega = uniform(rng, -6.0, 10.0)
        else:
            omega = -2.0 * gamma - uniform(rng, 0.1, 4.0)
        constants = Constants(epsilon=epsilon, gamma=gamma, omega=omega)
        boundary = "dirichlet" if family == "theorem_2_widened" else str(rng.choice(BOUNDARIES))
        part = uniform(rng, 1e-3, 1.0)
        power = LARGEST[family](constants) * part * part
        amplitudes = np.sqrt(power) * draw_shape(rng, sites)
        energy = total_energy(constants, boundary, amplitudes)
        limits = [
            float(BOUNDS[family](energy, power, sites, stated))
            for stated in (constants, replace(constants, gamma=0.0))
        ]
        if np.isfinite(limits[0]):
            return constants, boundary, amplitudes, limits


def check_samples(count: int, end_time: float, sizes, seed: int) -> dict:
    """Run `count` random cases of each size inside each region; compare the largest P and bound.

    The parameters are drawn too, and ends of all kinds. Bounds that forget the drive are broken.
    """
    ratio, outputs = np.empty((len(FAMILIES), len(sizes), count, 2)), round(10 * end_time)
    for i, family in enumerate(FAMILIES):
        for j, sites in enumerate(sizes):
            rng = np.random.default_rng([seed, i, j])
            drawn = [draw_case(rng, family, sites) for _ in range(count)]
            constants, boundaries, amplitudes, limits = zip(*drawn, strict=True)
            powers, _ = run_powers(constants, boundaries, amplitudes, end_time, outputs)
            ratio[i, j] = powers.max(axis=1)[:, None] / limits
    right, undriven = ratio.max(axis=(1, 2)).T
    says, dims = "largest P over its bound", ("family",)
    return table(
        "Largest P over its bound for random data inside the proven regions",
        {"family": FAMILIES},
        worst_sample=variable(right, dims, says, tolerance=LIMIT),
        worst_without_drive=variable(undriven, dims, f"{says} at gamma = 0"),
    )
