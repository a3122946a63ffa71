"""Refuses a run before it starts if it could not end, or if its digits would be noise.

Each function returns a reason in words, or None. The solvers themselves report what shows only
during a run: a state that overflows, or a step that shrinks to nothing.
"""

from collections.abc import Mapping
from dataclasses import asdict

import numpy as np

from pendula.integrators import MOST_STEPS
from pendula.integrators.taylor import ORDER
from pendula.numerics.elementary import log
from pendula.problem import Constants, Problem

LONGEST_SERIES = 20.0
"""Terms of a longer exponential series cancel to noise; beyond 700 they overflow without end."""
ROUNDING = 1e-16
"""No solver resolves a smaller part of the data."""
SMALLEST_ERROR = 1e-150
"""The square of a smaller error vanishes, and with it the step control of dop853 and ode45."""
SMALLEST_DATA = 1e-153
"""The squares of smaller amplitudes, and with them norms and energy, lose digits or vanish."""


def find_obstacle(problem: Problem) -> str | None:
    """Return why a problem cannot be integrated, or None if it can."""
    parts = np.abs(np.stack([problem.initial.real, problem.initial.imag]))
    peak = float(parts.max(initial=0.0))  # NaN where there is one
    constants, span, solver = problem.constants, float(problem.end_time), problem.solver
    return (
        _find_in_data(constants, peak, span)
        or _find_in_steps(constants, solver, span)
        or _find_in_tolerances(solver, peak)
        or _find_in_series(constants, peak, span, solver)
    )


def _rate(constants: Constants, peak: float) -> float:
    """Return a bound of the relative rate at which data of the size `peak` turn or grow."""
    epsilon, gamma, omega = np.abs([constants.epsilon, constants.gamma, constants.omega])
    with np.errstate(over="ignore"):
        return float(4 * epsilon + omega + 2 * gamma + 0.5 * np.square(peak))


def _find_in_data(constants: Constants, peak: float, span: float) -> str | None:
    if not np.isfinite([*asdict(constants).values(), peak, span]).all():
        return "the data or the constants are not finite"
    if 0.0 < peak < SMALLEST_DATA:
        return f"the data are so small ({peak:.0e}) that their squares vanish"
    angle = _rate(constants, peak) * span
    if angle == np.inf:
        return "the squares of the data or the constants overflow"
    if angle > MOST_STEPS:
        return f"the run turns the data by {angle:.0e} radians, more than {MOST_STEPS:.0e}"
    return None


def _find_in_steps(constants: Constants, solver: Mapping, span: float) -> str | None:
    if "step" not in solver:
        return None
    if not solver["step"] > 0.0:
        return f"the step must be positive, not {solver['step']}"
    if not span <= MOST_STEPS * solver["step"]:
        count = span / solver["step"]
        return f"the run takes {count:.0e} steps, more than {MOST_STEPS:.0e}: the step is too short"
    reach = _rate(constants, 0.0) * min(solver["step"], span)
    if solver["name"] == "splitting" and reach > LONGEST_SERIES:
        return f"the step is too long for the linear terms: they turn the data by {reach:.0f} in it"
    return None


def _find_in_tolerances(solver: Mapping, peak: float) -> str | None:
    if "rtol" not in solver:
        return None
    rtol, atol = float(solver["rtol"]), float(solver["atol"])
    if not (rtol >= 0.0 and atol >= 0.0):
        return f"the tolerances {rtol:g} and {atol:g} are not both numbers of at least zero"
    if not rtol * peak + atol >= ROUNDING * peak:
        return f"the tolerances {rtol:g} and {atol:g} lie below the rounding of the data"
    if 0.0 < peak < atol:
        return f"the data ({peak:.0e}) are smaller than the absolute tolerance {atol:g}"
    if solver["name"] == "ode45" and rtol == 0.0:
        return "the relative tolerance of ode45 must be positive"
    if solver["name"] in ("dop853", "ode45") and atol < SMALLEST_ERROR:
        return f"the square of the absolute tolerance {atol:g} vanishes: give {SMALLEST_ERROR:g}"
    return None


def _find_in_series(constants: Constants, peak: float, span: float, solver: Mapping) -> str | None:
    """Refuse chains so slow or fast that the last coefficients of a power series leave the doubles.

    Where nothing moves they may vanish.
    """
    rate = _rate(constants, peak)
    if solver["name"] != "taylor" or peak == 0.0 or rate * span < 1e-6:
        return None
    digits = (log(peak) + ORDER * log(rate)) / log(10.0)
    if abs(digits) > 270.0:
        return f"the power series needs numbers of 1e{digits:.0f}: choose another unit of time"
    return None
