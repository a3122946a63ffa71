"""Runs of this project's solvers at a given accuracy: a tolerance, or a step."""

import numpy as np

from pendula.simulation.simulate import Trajectory, integrate

from .tasks import Task


def controls(name: str, accuracy: float) -> dict:
    """Return the controls of one of our solvers for a tolerance or a step."""
    if name == "crank_nicolson":
        return {"name": name, "step": accuracy, "tolerance": 1e-13, "iterations": 50}
    if name == "splitting":
        return {"name": name, "step": accuracy}
    atol = accuracy / 100 if name == "ode45" else accuracy  # the paper's ratio for ode45
    return {"name": name, "rtol": accuracy, "atol": atol}


def follow(task: Task, times: np.ndarray, name: str, accuracy: float) -> Trajectory:
    """Integrate the task by one of our solvers with outputs at `times`."""
    return integrate(
        task.constants,
        task.boundary,
        task.amplitudes,
        task.reduction,
        times,
        controls(name, accuracy),
    )
