"""What is known of a run beside its reference, and whether small changes of it grow."""

from collections.abc import Mapping
from typing import Any

import numpy as np

from pendula.report.results import Results
from pendula.report.words import horizon_in_words

TRUST, GROWTH = "checks/trust", "checks/lyapunov"

KNOWN = ("off", "agrees", "ended", "unknown")
"""What is known of a run beside its reference: it leaves it; it agrees to its own end, or to that
of the reference, which ends before; there is no reference of this case or by this solver."""


def trusted(results: Results, case: str) -> tuple[str, str, float]:
    """Return which of KNOWN a run is, when it leaves the reference, and until when both are known.

    Runs by the shared controls of each solver were judged; one by other controls was not.
    """
    run, trust = results[f"trajectories/{case}"], results[TRUST].sel(case=case)
    solver = run.attrs["solver"]
    by_shared = results[f"trajectories/{case}.{solver}"].attrs
    if controls_of(by_shared) != controls_of(run.attrs) or solver not in trust["solver"].values:
        return "unknown", "not judged", float("nan")
    judged = trust.sel(solver=solver, level="visible")
    time, until, end = (float(judged[name]) for name in ("horizon", "known_until", "run_end"))
    words = horizon_in_words(time, until, end)
    if np.isnan(until):
        return "unknown", words, until
    if np.isfinite(time):
        return "off", words, until
    return "agrees" if until >= end else "ended", words, until


def controls_of(attributes: Mapping) -> dict[str, Any]:
    """Return the solver and its controls, from the attributes of a run."""
    return {key: value for key, value in attributes.items() if key.startswith("solver")}


def is_chaotic(results: Results, case: str) -> bool:
    """Return whether a case counts as chaotic; of one whose small changes are unknown, it does not.

    What a run of a regular case misses of its reference is the error of its solver.
    """
    growth = results[GROWTH]
    return case in growth["case"].values and bool(growth["chaotic"].sel(case=case) == 1)
