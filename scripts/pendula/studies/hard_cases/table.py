"""The hard cases as a dataset."""

import numpy as np

from pendula.datasets.netcdf import Variable

from .row import Outcome, Row, evaluate
from .rows import ROWS


def outcomes(rows: list[Row] = ROWS) -> list[Outcome]:
    """Run every solver on every row, after a first run of each that is not timed."""
    first = {}
    for row in rows:
        for solver in row.solvers:
            first.setdefault(solver["name"], (row, solver))
    for row, solver in first.values():
        evaluate(row, solver)
    return [evaluate(row, solver) for row in rows for solver in row.solvers]


def variables(results: list[Outcome]) -> dict[str, Variable]:
    """Return the variables of the dataset, each of shape (row,)."""

    def column(name: str, long_name: str, units: str = "1") -> Variable:
        return Variable(("row",), np.array([getattr(r, name) for r in results]), long_name, units)

    limits = [np.nan if isinstance(r.expected, str) else r.expected for r in results]
    sound = np.array([r.sound for r in results], np.int8)
    return {
        "case": column("case", "what is hard"),
        "solver": column("solver", "solver and its controls"),
        "error": column("error", "error, not a number where the run was refused"),
        "limit": Variable(("row",), np.array(limits), "largest sound error"),
        "refusal": column("refusal", "why the run was refused, empty where it was not"),
        "reference": column("reference", "what the error is measured against"),
        "seconds": column("seconds", "time of the run and of its reference", "s"),
        "sound": Variable(("row",), sound, "whether the outcome is the expected one"),
    }
