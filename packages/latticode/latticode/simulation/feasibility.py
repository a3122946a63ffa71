"""Refuses a run before it starts if it could not end, or if its digits would be noise.

The configuration asks before any job starts, and the simulation asks again, since problems reach it
from elsewhere too. The solvers themselves report what shows only during a run: a state that
overflows, or a step that shrinks to nothing.
"""

from collections.abc import Mapping
from math import frexp, isfinite

import numpy as np

from latticode.equations.graph import MOTION, Node, in_order, switches
from latticode.equations.model import Model
from latticode.numerics.elementary import log

MOST_STEPS = 1e9
"""More steps are refused: the run would take hours or never end."""
SERIES_ORDER = 16
"""The order of the power series of latticode.integrators.taylor."""
ROUNDING = 1e-16
"""No solver resolves a smaller part of the data."""
SMALLEST_ERROR = 1e-150
"""The square of a smaller error vanishes, and with it the step control of dop853 and ode45."""
SMALLEST_DATA = 1e-153
"""The squares of smaller amplitudes, and with them norms and energy, lose digits or vanish."""

Obstacle = tuple[str, str]
"""The key of a case that stands in the way of its run, and why, in words."""


def solver_names(model: Model) -> list[str]:
    """Return the solvers that take a model: all but two of them need equations of one kind."""
    found = [] if why_no_series(model) else ["taylor"]
    found += ["dop853", "ode45"]
    found += ["kahan_li"] if model.separable else []
    return found + ([] if model.driven else ["crank_nicolson"])


def why_no_series(model: Model) -> str:
    """Return why a model has no power series, in words to stand behind its name; "" if it has."""
    if switches(model.rates):
        return "has max, abs, sign or where, which have no power series where they switch"
    if has_kinks(model.rates):
        return "has a root of squares, such as |x|, which has no power series at 0"
    return ""


def has_kinks(rates: tuple[Node, ...]) -> bool:
    """Return whether rates hold the root of squares alone, as |x| = sqrt(x * x) of a real field.

    Where x passes zero, |x| has a kink, and its power series goes on as x or as -x without a word.
    """
    roots = [one for one in in_order(rates) if one.operation == "sqrt" and one.level == MOTION]
    return any(_is_sum_of_squares(one.operands[0]) for one in roots)


def _is_sum_of_squares(one: Node) -> bool:
    match one.operation, *one.operands:
        case "mul", a, b:
            return a is b or any(
                factor.level < MOTION and _is_sum_of_squares(rest)
                for factor, rest in ((a, b), (b, a))
            )
        case "div", a, b:
            return b.level < MOTION and _is_sum_of_squares(a)
        case "add", a, b:
            return _is_sum_of_squares(a) and _is_sum_of_squares(b)
    return False


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
    return (
        _find_in_data(values, peak, span, rates)
        or _find_in_steps(solver, clock * span)
        or _find_in_tolerances(solver, peak)
        or _find_in_series(peak, span, solver, rates, clock)
    )


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
    if solver["name"] == "ode45" and rtol == 0.0:
        return "solver.rtol", "the relative tolerance of ode45 must be positive"
    if solver["name"] in ("dop853", "ode45") and atol < SMALLEST_ERROR:
        text = f"the square of the absolute tolerance {atol:g} vanishes: give {SMALLEST_ERROR:g}"
        return "solver.atol", text
    return None


def _find_in_series(
    peak: float, span: float, solver: Mapping, rates: Mapping[str, float], clock: float
) -> Obstacle | None:
    """Refuse chains so slow or fast that the last coefficients of a power series leave the doubles.

    Where nothing moves they may vanish.
    """
    total = sum(rates.values()) / clock  # in the time of the series
    if solver["name"] != "taylor" or peak == 0.0 or total * span * clock < 1e-6:
        return None
    octaves = abs(frexp(peak)[1]) + SERIES_ORDER * (abs(frexp(total)[1]) + 1)
    if octaves < 270.0:  # as always, and then the logarithms need not be asked: 2^270 < 1e270
        return None
    power = (log(peak) + SERIES_ORDER * log(total)) / log(10.0)
    if abs(power) > 270.0:
        text = f"the power series needs numbers of 1e{power:.0f}: choose another unit of time"
        return "end_time", text
    return None
