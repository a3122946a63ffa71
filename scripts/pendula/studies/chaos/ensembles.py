"""Seeded ensembles: a case from data that differ in their last digits, as many times as wanted.

Where the motion is chaotic one run is one draw; what a second solver, or another computer, would
draw as well is the distribution.
"""

import numpy as np

from pendula.problem import Problem
from pendula.simulation.simulate import simulate
from pendula.simulation.sweep import pair_l2, pair_linf, sweep

QUANTILES = (0.05, 0.25, 0.5, 0.75, 0.95)


def perturb(initial: np.ndarray, size: float, rng: np.random.Generator) -> np.ndarray:
    """Return data (2, 2r + 1), each amplitude times 1 + size (x + iy) of Gaussian x and y.

    Sites n and -n take the same factors, so that even data stay even.
    """
    reach = initial.shape[1] // 2
    drawn = (reach + 1, 2)
    factors = 1.0 + size * (rng.normal(size=drawn) + 1j * rng.normal(size=drawn))
    return initial * factors[np.abs(np.arange(-reach, reach + 1))].T


def draw_members(problem: Problem, size: float, members: int, seed: int) -> list[Problem]:
    """Return as many copies of `problem` with perturbed data."""
    rng = np.random.default_rng(seed)
    return [problem.changed(initial=perturb(problem.initial, size, rng)) for _ in range(members)]


def run_members(
    problem: Problem, size: float, members: int, seed: int = 0
) -> tuple[np.ndarray, np.ndarray]:
    """Return the norms l2 and l-infinity of each member, both (member, quantity, time)."""
    runs = [simulate(member) for member in draw_members(problem, size, members, seed)]
    return np.array([pair_l2(run) for run in runs]), np.array([pair_linf(run) for run in runs])


def sweep_members(
    problem: Problem, half_widths, windows, size: float, members: int, seed: int = 0
) -> tuple[np.ndarray, np.ndarray]:
    """Return the swept l2 and l-infinity of each member, both (member, *shape of a Sweep)."""
    drawn = draw_members(problem, size, members, seed)
    sweeps = [sweep(member, half_widths, windows) for member in drawn]
    return np.array([s.l2 for s in sweeps]), np.array([s.linf for s in sweeps])
