"""A hard case, and what came of it."""

from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from pendula.simulation.simulate import IntegrationError


class Row(NamedTuple):
    """A case that each of `solvers` must solve to an error of `expected`, or refuse in words."""

    case: str
    reference: str  # what the error is measured against
    decide: Callable[..., float]  # of a solver and `arguments`: the error
    solvers: tuple[dict, ...]  # {"name": ..., **controls}
    expected: float | str  # the largest sound error, or words of the refusal
    arguments: dict = {}


class Outcome(NamedTuple):
    """What one solver made of a row."""

    case: str
    solver: str
    error: float  # NaN where it refused
    refusal: str  # empty where it did not
    reference: str
    expected: float | str
    sound: bool


def evaluate(row: Row, solver: dict) -> Outcome:
    """Run one solver on a row."""
    error, refusal = np.nan, ""
    try:
        error = row.decide(solver, **row.arguments)
    except IntegrationError as fault:
        refusal = str(fault)
    refused = isinstance(row.expected, str)
    sound = row.expected in refusal if refused else bool(error <= row.expected)
    sound = sound and refused == bool(refusal)
    reference, expected = row.reference, row.expected
    name = describe(solver)
    return Outcome(row.case, name, error, refusal, reference, expected, sound)


def describe(solver: dict) -> str:
    """Return the solver's name and its controls."""
    controls = (f"{key} {value:g}" for key, value in solver.items() if key != "name")
    return f"{solver['name']}: {', '.join(controls)}"
