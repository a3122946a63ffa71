"""Seeded ensembles: a case from data that differ in their last digits, as many times as wanted.

Where the motion is chaotic one run is one draw; what a second solver, or another computer, would
draw as well is the distribution.
"""

import numpy as np

from pendula.datasets.netcdf import Variable
from pendula.measures.levels import bands, moments
from pendula.problem import Problem, name_window
from pendula.simulation.simulate import simulate
from pendula.simulation.sweep import QUANTITIES, STATISTICS, pair_l2, pair_linf, sweep

from .lyapunov import describe_cases

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


NORMS = {"l2": "l2", "linf": "l-infinity"}
MOMENTS = {
    "mean": "ensemble mean",
    "deviation": "standard deviation over the ensemble",
    "error": "standard error of the ensemble mean",
}


def case_bands(problems: dict[str, Problem], size: float, members: int, seed: int):
    """Return quantile bands of the norms of each case by name."""
    results = [run_members(problem, size, members, seed) for problem in problems.values()]
    first = next(iter(problems.values()))
    tau = first.times
    grid = ("case", "quantile", "quantity", "tau")
    variables = {
        **describe_cases(problems),
        "quantile": Variable(("quantile",), np.array(QUANTILES), "quantile over the ensemble"),
        "quantity": Variable(("quantity",), list(QUANTITIES)),
        "tau": Variable(("tau",), tau),
    }
    for (name, title), norms in zip(NORMS.items(), zip(*results, strict=True), strict=True):
        values = np.array([bands(norm, QUANTILES) for norm in norms])
        variables[name] = Variable(grid, values, f"quantiles of the {title} norm")
    return variables


def sweep_moments(
    problems: dict[str, Problem], half_widths, windows, size: float, members: int, seed: int
) -> dict[str, Variable]:
    """Return mean, deviation and standard error of every swept norm of each sweep by name."""
    results = [
        sweep_members(problem, half_widths, windows, size, members, seed)
        for problem in problems.values()
    ]
    names = [name_window(window) for window in windows]
    variables = {
        "sweep": Variable(("sweep",), list(problems)),
        "half_width": Variable(("half_width",), np.array(half_widths)),
        "statistic": Variable(("statistic",), list(STATISTICS)),
        "window": Variable(("window",), names),
    }
    grid = ("sweep", "half_width", "quantity", "statistic", "window")
    for (name, title), norms in zip(NORMS.items(), zip(*results, strict=True), strict=True):
        reduced = [moments(norm) for norm in norms]
        for key, words in MOMENTS.items():
            values = np.array([one[key] for one in reduced])
            variables[f"{name}_{key}"] = Variable(grid, values, f"{words} of the {title} norm")
    return variables
