"""What the solvers made of the hard cases, as a dataset.

It keeps no times, in which two runs would differ.
"""

from collections.abc import Mapping
from typing import Any, NamedTuple

import numpy as np

from pendula.datasets.netcdf import Variable
from pendula.datasets.trajectories import Contents
from pendula.simulation.simulate import IntegrationError

from . import errors


class Outcome(NamedTuple):
    """What one solver made of a row."""

    case: str
    solver: str
    error: float  # NaN where it refused
    refusal: str  # empty where it did not
    reference: str
    expected: float | str
    sound: bool


def outcomes(cases: list[Mapping[str, Any]]) -> list[Outcome]:
    """Run every solver on every case; these are plain values of `settings.HardCase`."""
    return [evaluate(case, solver) for case in cases for solver in case["solvers"]]


def evaluate(case: Mapping[str, Any], solver: Mapping[str, Any]) -> Outcome:
    """Run one solver on a case."""
    error, refusal, expected = np.nan, "", case["expected"]
    try:
        error = getattr(errors, case["measure"])(solver, **case["arguments"])
    except IntegrationError as fault:
        refusal = str(fault)
    refused = isinstance(expected, str)
    sound = expected in refusal if refused else bool(error <= expected)
    sound = sound and refused == bool(refusal)
    name, against = describe_solver(solver), case["against"]
    return Outcome(case["case"], name, error, refusal, against, expected, sound)


def describe_solver(solver: Mapping[str, Any]) -> str:
    """Return the solver's name and its controls."""
    controls = (f"{key} {value:g}" for key, value in solver.items() if key != "name")
    return f"{solver['name']}: {', '.join(controls)}"


def variables(results: list[Outcome]) -> dict[str, Variable]:
    """Return the variables of the dataset, each of shape (row,)."""

    def column(name: str, long_name: str = "") -> Variable:
        return Variable(("row",), np.array([getattr(r, name) for r in results]), long_name)

    limits = [np.nan if isinstance(r.expected, str) else r.expected for r in results]
    sound = np.array([r.sound for r in results], np.int8)
    return {
        "case": column("case"),
        "solver": column("solver", "solver, and its controls"),
        "error": column("error", "error, not a number where the run was refused"),
        "limit": Variable(("row",), np.array(limits), "largest sound error"),
        "refusal": column("refusal", "why the run was refused, empty where it was not"),
        "reference": column("reference", "what the error is measured against"),
        "sound": Variable(("row",), sound, "whether the outcome is the expected one"),
    }


def hard_cases_contents(cases: list[dict]) -> Contents:
    """Return what each solver made of `cases`, which are plain values.

    A row that does not end as expected is said here and marked in it.
    """
    results = outcomes(cases)
    for result in results:
        if not result.sound:
            print(f"NOT AS EXPECTED: {result.case}, {result.solver}: {result.error:.3g} ")
    title = "Hard cases for the solvers: errors against what is known, or refusals in words"
    seeds = "the number of sites, for random data; cases say their constants"
    return variables(results), {"title": title, "seed": seeds}
