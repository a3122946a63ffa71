"""Refuses a run before it starts if it could not end, or if its digits would be noise.

The configuration asks before any job starts, and the simulation asks again, since problems reach it
from elsewhere too. The solvers themselves report what shows only during a run: a state that
overflows, or a step that shrinks to nothing.
"""

from collections.abc import Mapping
from math import isfinite

import numpy as np

from latticode.equations.model import Model
from latticode.integrators.method import Obstacle
from latticode.integrators.methods import METHODS

MOST_STEPS = 1e9
"""More steps are refused: the run would take hours or never end."""
ROUNDING = 1e-16
"""No solver resolves a smaller part of the data."""
SMALLEST_DATA = 1e-153
"""The squares of smaller amplitudes, and with them norms and energy, lose digits or vanish."""


def find_fault(
    values: Mapping,
    rates: Mapping[str, float],
    peak: float,
    span: float,
    solver: Mapping,
    clock: float = 1.0,
) -> Obstacle | None:
    """Return the key that keeps data of the size `peak` from being followed for a time `span`.

    `values` are constants by their keys, `rates` bounds of the relative rates at which such data
    turn or grow, by the key that makes them; the solver counts `clock` units of its time in one.
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
    """Return bounds of the rates at which data of the size `peak` turn or grow under a model."""
    linear = model.rate(parameters, 0.0)
    return {"parameters": linear, "initial": model.rate(parameters, peak) - linear}


def _find_in_data(
    constants: Mapping, peak: float, span: float, rates: Mapping[str, float]
) -> Obstacle | None:
    values = {**constants, "initial": peak, "end_time": span}
    endless = [key for key, value in values.items() if not isfinite(value)]
    if endless:
        return endless[0], "the data or the constants are not finite"
    if 0.0 < peak < SMALLEST_DATA:
        return "initial", f"the data are so small ({peak:.0e}) that their squares vanish"
    fastest = max(rates, key=rates.get)
    angle = sum(rates.values()) * span
    if angle == np.inf:
        return fastest, "the squares of the data or the constants overflow"
    if angle > MOST_STEPS:
        return (
            fastest if rates[fastest] > span else "end_time",
            f"the run turns the data by {angle:.0e} radians, more than {MOST_STEPS:.0e}",
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
        text = f"the tolerances {rtol:g} and {atol:g} are not both numbers of at least zero"
        return "solver.rtol", text
    if not rtol * peak + atol >= ROUNDING * peak:
        text = f"the tolerances {rtol:g} and {atol:g} lie below the rounding of the data"
        return "solver.rtol", text
    if 0.0 < peak < atol:
        text = f"the data ({peak:.0e}) are smaller than the absolute tolerance {atol:g}"
        return "solver.atol", text
    return None
