"""Checks before a run, which reject runs that would not end or would return only rounding errors.

The configuration checks its cases before any job starts. `simulate` checks again, because not all
problems come from a configuration. The solvers report errors that appear only during a run: a state
that overflows, or a step that becomes too short.
"""

from collections.abc import Mapping
from math import isfinite

import numpy as np

from latticode.equations.model import Model
from latticode.integrators.method import Obstacle
from latticode.integrators.methods import METHODS

MOST_STEPS = 1e9
"""Maximum number of steps of a run: more would take hours."""
ROUNDING = 1e-16
"""Smallest tolerance relative to the data; below it, rounding errors dominate."""
SMALLEST_DATA = 1e-153
"""Smallest amplitude: the squares of smaller ones, in norms and energy, lose digits or vanish."""


def find_fault(
    values: Mapping,
    rates: Mapping[str, float],
    peak: float,
    span: float,
    solver: Mapping,
    clock: float = 1.0,
) -> Obstacle | None:
    """Return the key to change and the reason why a run of length `span` is rejected, else None.

    `peak` is the largest initial amplitude. `values` has constants by key. `rates` has bounds of
    relative rates, each by the key that it depends on. `clock` is the solver's time per unit of
    `span`.
    """
    obstacle = (
        _find_in_data(values, peak, span, rates)
        or _find_in_steps(solver, clock * span)
        or _find_in_tolerances(solver, peak)
    )
    method = METHODS.get(solver["name"])
    if obstacle or method is None or not method.controls.keys() <= solver.keys():
        return obstacle
    return method.find_obstacle(solver, peak, clock * span, sum(rates.values()) / clock)


def rates_of(model: Model, parameters: Mapping, peak: float) -> dict[str, float]:
    """Return bounds of the relative rates of a model at amplitude `peak`, by key."""
    linear, total = model.rates_at(parameters, 0.0, peak)
    return {"parameters": linear, "initial": total - linear}


def _find_in_data(
    constants: Mapping, peak: float, span: float, rates: Mapping[str, float]
) -> Obstacle | None:
    values = {**constants, "initial": peak, "end_time": span}
    not_finite = [key for key, value in values.items() if not isfinite(value)]
    if not_finite:
        return not_finite[0], "the data or the constants are not finite"
    if 0.0 < peak < SMALLEST_DATA:
        return "initial", f"the data are so small ({peak:.0e}) that their squares vanish"
    fastest = max(rates, key=rates.get)
    angle = sum(rates.values()) * span
    if angle == np.inf:
        return fastest, "the squares of the data or the constants overflow"
    if angle > MOST_STEPS:
        return (
            fastest if rates[fastest] > span else "end_time",
            f"the phases advance by {angle:.0e} radians, more than {MOST_STEPS:.0e}",
        )
    return None


def _find_in_steps(solver: Mapping, span: float) -> Obstacle | None:
    if "step" not in solver:
        return None
    key, step = "solver.step", solver["step"]
    if not step > 0.0:
        return key, f"the step must be positive, not {step}"
    if not span <= MOST_STEPS * step:
        text = f"the run takes {span / step:.0e} steps, more than {MOST_STEPS:.0e}"
        return key, f"{text}: the step is too short"
    return None


def _find_in_tolerances(solver: Mapping, peak: float) -> Obstacle | None:
    if "rtol" not in solver:
        return None
    rtol, atol = float(solver["rtol"]), float(solver["atol"])
    if not (rtol >= 0.0 and atol >= 0.0):
        text = f"the tolerances must be numbers of at least zero, not {rtol:g} and {atol:g}"
        return "solver.rtol", text
    if not rtol * peak + atol >= ROUNDING * peak:
        text = f"the tolerances {rtol:g} and {atol:g} are below the rounding errors of the data"
        return "solver.rtol", text
    if 0.0 < peak < atol:
        text = f"the data ({peak:.0e}) are smaller than the absolute tolerance {atol:g}"
        return "solver.atol", text
    return None
