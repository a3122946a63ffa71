"""A sweep as a dataset."""

import numpy as np

from pendula.problem import Problem, name_window
from pendula.simulation.sweep import QUANTITIES, STATISTICS, Sweep

from .netcdf import Variable
from .trajectories import as_attributes, count_work


def contents(name: str, problem: Problem, half_widths, windows, sweep: Sweep) -> tuple[dict, dict]:
    """Return (variables, attributes) of the dataset that a sweep of `problem` makes."""
    attributes = as_attributes(name, problem, problem.solver)
    del attributes["half_width"]
    variables = as_variables(sweep, half_widths, windows)
    return variables, {**attributes, **count_work(sweep.outcomes)}


def as_variables(sweep: Sweep, half_widths: list[int], windows) -> dict[str, Variable]:
    """Return the variables of a sweep's dataset."""
    axes = ("half_width", "quantity", "statistic", "window")
    names = [name_window(window) for window in windows]
    return {
        "half_width": Variable(
            ("half_width",), np.asarray(half_widths), "half-width M of the chain of 2M + 1 pairs"
        ),
        "quantity": Variable(("quantity",), list(QUANTITIES), "pendulum of each pair, or both"),
        "statistic": Variable(("statistic",), list(STATISTICS), "reduction over the window"),
        "window": Variable(("window",), names, "window of slow time, both ends included"),
        "l2": Variable(axes, sweep.l2, "l2 norm over the chain"),
        "linf": Variable(axes, sweep.linf, "l-infinity norm over the chain"),
    }
