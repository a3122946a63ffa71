"""Poincare sections: the times and states at which a function of the fields crosses zero.

A crossing is detected as a change of sign between two outputs. Short runs from the first output
locate the crossing, so its error is the error of the solver and not of an interpolation.
"""

from collections.abc import Callable, Iterator
from typing import Any, NamedTuple

import numpy as np

from latticode.equations.graph import Node, evaluate
from latticode.simulation.problem import Problem
from latticode.simulation.simulate import simulate
from latticode.simulation.traced import moved

from .linearised import places_seen

DIRECTIONS = {"up": (1.0,), "down": (-1.0,), "both": (1.0, -1.0)}
"""The signs of the slope at a crossing, by the name of a direction."""
OUTPUTS_AT_ONCE = 500
"""Number of outputs with states in memory at the same time."""
MOST_STEPS = 200
"""Maximum number of steps of the root search, which needs far fewer because it bisects."""


class Crossings(NamedTuple):
    """The times and states at which a function of the fields crosses zero."""

    tau: np.ndarray  # (crossing,)
    states: np.ndarray  # (part, component, site, crossing)


def find_crossings(problem: Problem, when: Node, site: int, direction: str) -> Crossings:
    """Return the times and states at which an expression of the fields crosses zero at a site.

    Two crossings between the same two outputs are missed. `direction` is a key of DIRECTIONS.
    Raises IntegrationError if `simulate` does.
    """
    value = _value_at(problem, when, problem.site_numbers.index(site))
    signs = DIRECTIONS[direction]
    times, states = [], []
    for start, before, end, after in _output_pairs(problem):
        low, high = value(before, start), value(after, end)
        if any(sign * low < 0.0 <= sign * high for sign in signs):
            time, state = _locate(problem, value, (start, before, end, after))
            times.append(time)
            states.append(state)
    shape = len(problem.equations.names.parts), len(problem.initial), problem.sites, 0
    return Crossings(np.array(times), np.stack(states, axis=-1) if states else np.zeros(shape))


def _output_pairs(problem: Problem) -> Iterator[tuple[float, np.ndarray, float, np.ndarray]]:
    """Yield times and states (part, component, site) of each pair of successive outputs."""
    times, fields = problem.times, problem.amplitudes
    for first in range(0, len(times) - 1, OUTPUTS_AT_ONCE):
        last = min(first + OUTPUTS_AT_ONCE, len(times) - 1)
        span = {"start_time": float(times[first]), "end_time": float(times[last])}
        run = simulate(problem.changed(initial=fields, snapshot_every=1, keep="state", **span))
        states = np.moveaxis(run.state, -1, 0)
        for number in range(last - first):
            pair = times[first + number], states[number], times[first + number + 1]
            yield *pair, states[number + 1]
        fields = _complex(states[-1])


def _locate(
    problem: Problem, value: Callable[[np.ndarray, float], float], bracket: tuple[Any, ...]
) -> tuple[float, np.ndarray]:
    """Return the time and the state (part, component, site) of the crossing between two outputs."""
    start, before, end, after = bracket
    known = {start: before, end: after}

    def state_at(time: float) -> np.ndarray:
        if time not in known:
            times = {"start_time": start, "end_time": time, "output_step": time - start}
            run = simulate(problem.changed(initial=_complex(before), snapshot_every=0, **times))
            final = run.final
            known[time] = final if final.ndim == 3 else np.array([final.real, final.imag])
        return known[time]

    if value(after, end) == 0.0:
        return float(end), after
    time = find_root(lambda time: value(state_at(time), time), float(start), float(end))
    return time, state_at(time)


def _complex(state: np.ndarray) -> np.ndarray:
    """Return a state (part, component, site) as complex initial data, (component, site)."""
    return state[0] + 1j * state[1] if len(state) > 1 else state[0] + 0j


def _value_at(problem: Problem, when: Node, column: int) -> Callable[[np.ndarray, float], float]:
    """Return value(state, time) of `when` at a site, for states (part, component, site)."""
    parameters, reach = problem.parameter_values, max(1, when.reach)
    seen, factor, _ = places_seen(reach, problem.boundary, problem.sites, None)
    seen = seen.astype(int)

    def value(state: np.ndarray, time: float) -> float:
        def of_leaf(leaf: Node) -> Any:
            match leaf.operation, *leaf.operands:
                case "number", number:
                    return number
                case ("time",):
                    return time
                case "parameter", name, by:
                    values = parameters[name]
                    return values if np.ndim(values) == 0 else moved(values, by, problem.boundary)
                case "field", component, part, by:
                    row = factor * state[part, component][seen]
                    return row[reach + by : reach + by + problem.sites]

        (values,) = evaluate([when], of_leaf)
        return float(np.broadcast_to(values, (problem.sites,))[column])

    return value


def find_root(value: Callable[[float], float], start: float, end: float) -> float:
    """Return the root of a function that changes sign between two times, to rounding.

    This is the Illinois method: false position that halves the value at an end point if this point
    stays the same. Every third step is a bisection.
    """
    low, high = value(start), value(end)
    for step in range(1, MOST_STEPS):
        middle = (start * high - end * low) / (high - low)
        if step % 3 == 0 or not start < middle < end:
            middle = 0.5 * (start + end)
        if not start < middle < end:  # no double lies between them
            break
        at_middle = value(middle)
        if at_middle == 0.0:
            return middle
        if (at_middle > 0.0) == (high > 0.0):
            end, high, low = middle, at_middle, 0.5 * low
        else:
            start, low, high = middle, at_middle, 0.5 * high
    return end if abs(high) < abs(low) else start
