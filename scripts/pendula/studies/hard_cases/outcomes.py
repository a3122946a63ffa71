"""The outcomes of the solvers on the hard cases, as a dataset."""

from collections.abc import Mapping
from typing import Any

import numpy as np
from latticode.datasets.netcdf import Variable
from latticode.datasets.trajectories import Contents
from latticode.simulation.simulate import IntegrationError

from . import errors

LONG_NAMES = {
    "case": "",  # as in the registry
    "solver": "solver, and its controls",
    "error": "error, not a number where the run was refused",
    "limit": "largest sound error",
    "refusal": "why the run was refused, empty where it was not",
    "reference": "what the error is measured against",
    "sound": "whether the outcome is the expected one",
}
"""What is kept of each run."""


def evaluate(case: Mapping[str, Any], solver: Mapping[str, Any]) -> dict[str, Any]:
    """Run one solver on a case, plain values of `settings.HardCase`; return what LONG_NAMES says.

    A case expects an error of at most so much, or a refusal with these words.
    """
    error, refusal, expected = np.nan, "", case["expected"]
    try:
        error = getattr(errors, case["measure"])(solver, **case["arguments"])
    except IntegrationError as fault:
        refusal = str(fault)
    must_refuse = isinstance(expected, str)
    sound = expected in refusal if must_refuse else bool(error <= expected)
    controls = ", ".join(f"{key} {value:g}" for key, value in solver.items() if key != "name")
    return {
        "case": case["case"],
        "solver": f"{solver['name']}: {controls}",
        "error": error,
        "limit": np.nan if must_refuse else expected,
        "refusal": refusal,
        "reference": errors.AGAINST[case["measure"]],
        "sound": np.int8(sound and must_refuse == bool(refusal)),
    }


def hard_cases_contents(cases: list[dict]) -> Contents:
    """Return the outcome of each solver on `cases`, plain values; an unexpected one is printed."""
    results = [evaluate(case, solver) for case in cases for solver in case["solvers"]]
    for row in results:
        if not row["sound"]:
            print(f"NOT AS EXPECTED: {row['case']}, {row['solver']}: {row['error']:.3g} ")
    variables = {
        name: Variable(("row",), np.array([row[name] for row in results]), words)
        for name, words in LONG_NAMES.items()
    }
    title = "Hard cases for the solvers: errors against what is known, or refusals in words"
    seeds = "the number of sites, for random data; cases say their constants"
    return variables, {"title": title, "seed": seeds}
