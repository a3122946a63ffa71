"""The dataset of the hard cases: the error or the rejection of each run."""

from collections.abc import Mapping
from typing import Any

import numpy as np
from latticode.datasets.netcdf import Variable
from latticode.datasets.trajectories import Contents
from latticode.simulation.simulate import IntegrationError
from replication.variables import REGULAR, SCATTERED, missing

from . import errors

LONG_NAMES = {
    "case": "",  # as in the registry
    "solver": "solver, and its controls",
    "error": "error",
    "limit": "largest allowed error",
    "refusal": "why the run was rejected, empty if it was not",
    "reference": "what the error is measured against",
    "sound": "whether the outcome is the expected one",
}
"""The variables of the dataset, which has a row for each run."""
ATTRIBUTES = {
    "error": SCATTERED | missing("the run was rejected"),
    "limit": missing("the run must be rejected"),
}


def run_hard_case(case: Mapping[str, Any], solver: Mapping[str, Any]) -> dict[str, Any]:
    """Return the row of the dataset for one solver on a case.

    `case` holds plain values of a `HardCase`. Its `expected` is the largest allowed
    error, or a text in the message of the rejection.
    """
    error, refusal, expected = np.nan, "", case["expected"]
    try:
        error = getattr(errors, case["measure"])(solver, **case["arguments"])
    except IntegrationError as fault:
        refusal = str(fault)
    must_be_rejected = isinstance(expected, str)
    sound = expected in refusal if must_be_rejected else bool(error <= expected)
    controls = ", ".join(f"{key} {value:g}" for key, value in solver.items() if key != "name")
    return {
        "case": case["case"],
        "solver": f"{solver['name']}: {controls}",
        "error": error,
        "limit": np.nan if must_be_rejected else expected,
        "refusal": refusal,
        "reference": errors.REFERENCES[case["measure"]],
        "sound": np.int8(sound and must_be_rejected == bool(refusal)),
    }


def run_hard_cases(cases: list[dict]) -> Contents:
    """Return the dataset of every case and solver, and print unexpected outcomes."""
    results = [run_hard_case(case, solver) for case in cases for solver in case["solvers"]]
    for row in results:
        if not row["sound"]:
            print(f"NOT AS EXPECTED: {row['case']}, {row['solver']}: {row['error']:.3g}")
    variables = {
        name: Variable(
            ("row",),
            np.array([row[name] for row in results]),
            words,
            attributes=ATTRIBUTES.get(name, {}),
        )
        for name, words in LONG_NAMES.items()
    }
    title = "Hard cases for the solvers: errors against known results, or messages of rejected runs"
    seeds = "for random data the number of sites; the constants are in the name of a case"
    return variables, {"title": title, "seed": seeds, **REGULAR}
