"""Datasets of trajectories (one case) and of sweeps (one case on chains of many lengths)."""

from collections.abc import Sequence

import numpy as np
from latticode.datasets.trajectories import Contents, sweep_contents, trajectory_contents
from latticode.integrators.families import remark_on
from latticode.simulation.runs import ManyRuns
from latticode.simulation.simulate import remark_on_start, simulate
from latticode.simulation.sweep import runs_of_sweep

from pendula.problem import PaperProblem


def run_case(name: str, problem: PaperProblem) -> Contents:
    """Return the dataset of the observables of a case."""
    result = simulate(problem)
    if remark := remark_on(result.solver):
        print(f"{name}: {remark}")
    if remark := remark_on_start(problem):
        print(f"{name}: {remark}")
    if "iterations" in problem.solver and result.outcome.rejected:
        halvings = result.outcome.rejected
        print(f"{name}: the iteration did not contract; the step was halved {halvings} times")
    return trajectory_contents(name, problem, result)


def run_sweep(
    name: str,
    problem: PaperProblem,
    half_widths: Sequence[int],
    windows: Sequence[tuple[float, float]],
) -> ManyRuns:
    """Return the runs on all `half_widths`, for the dataset of maxima and means over `windows`."""
    runs = runs_of_sweep(problem, half_widths, windows)

    def contents(retained: dict[str, np.ndarray]) -> Contents:
        return sweep_contents(name, problem, half_widths, windows, runs.conclude(retained))

    return runs._replace(conclude=contents)
