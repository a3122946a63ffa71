"""The dataset of the ensembles."""

import numpy as np

from pendula.datasets.netcdf import Variable
from pendula.measures.levels import bands, moments
from pendula.problem import Problem, name_window
from pendula.simulation.sweep import QUANTITIES, STATISTICS

from .cases import describe_cases
from .ensembles import QUANTILES, run_members, sweep_members

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
        "quantity": Variable(("quantity",), list(QUANTITIES), "pendulum of each pair, or both"),
        "tau": Variable(("tau",), tau, "slow time"),
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
        "sweep": Variable(("sweep",), list(problems), "sweep"),
        "half_width": Variable(("half_width",), np.array(half_widths), "half-width M"),
        "statistic": Variable(("statistic",), list(STATISTICS), "statistic over the window"),
        "window": Variable(("window",), names, "window of tau"),
    }
    grid = ("sweep", "half_width", "quantity", "statistic", "window")
    for (name, title), norms in zip(NORMS.items(), zip(*results, strict=True), strict=True):
        reduced = [moments(norm) for norm in norms]
        for key, words in MOMENTS.items():
            values = np.array([one[key] for one in reduced])
            variables[f"{name}_{key}"] = Variable(grid, values, f"{words} of the {title} norm")
    return variables
