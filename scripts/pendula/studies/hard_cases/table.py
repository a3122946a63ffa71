"""The hard cases as a dataset."""

import numpy as np

from pendula.datasets.netcdf import Variable

from .row import Outcome, Row, evaluate
from .rows import ROWS


def outcomes(rows: list[Row] = ROWS) -> list[Outcome]:
    """Run every solver on every row. No times are kept: two runs would differ in them."""
    return [evaluate(row, solver) for row in rows for solver in row.solvers]


def variables(results: list[Outcome]) -> dict[str, Variable]:
    """Return the variables of the dataset, each of shape (row,)."""

    def column(name: str, long_name: str) -> Variable:
        return Variable(("row",), np.array([getattr(r, name) for r in results]), long_name)

    limits = [np.nan if isinstance(r.expected, str) else r.expected for r in results]
    sound = np.array([r.sound for r in results], np.int8)
    return {
        "case": column("case", "what is hard"),
        "solver": column("solver", "solver and its controls"),
        "error": column("error", "error, not a number where the run was refused"),
        "limit": Variable(("row",), np.array(limits), "largest sound error"),
        "refusal": column("refusal", "why the run was refused, empty where it was not"),
        "reference": column("reference", "what the error is measured against"),
        "sound": Variable(("row",), sound, "whether the outcome is the expected one"),
    }
