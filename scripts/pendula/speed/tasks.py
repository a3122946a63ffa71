"""What a solver is asked: a case up to a time, and what is true there."""

from typing import NamedTuple

import numpy as np

from pendula.simulation.lattice import Reduction, find_reduction, place


class Task(NamedTuple):
    """A case up to a time, in the words of simulation.integrate, and the reference there."""

    name: str
    constants: tuple[float, float, float]  # epsilon, gamma, omega
    boundary: str
    amplitudes: np.ndarray  # (component, site)
    reduction: Reduction
    end_time: float
    exact: np.ndarray | None  # (component, site) at the end time


def set_task(name: str, problem: dict, end_time: float, exact: np.ndarray | None = None) -> Task:
    """Return the task of following `problem` (the arguments of simulate) to `end_time`."""
    amplitudes = place(problem["initial"], problem["half_width"])
    return Task(
        name,
        (problem["epsilon"], problem["gamma"], problem["omega"]),
        problem["boundary"],
        amplitudes,
        find_reduction(amplitudes),
        end_time,
        exact,
    )


def error_of(task: Task, final: np.ndarray) -> float:
    """Return the largest difference of a site's amplitude from the exact state."""
    return float(np.abs(final - task.exact).max())
