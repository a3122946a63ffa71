"""What is known of a run beside its reference, and whether small changes of it grow."""

from collections.abc import Mapping
from typing import Any, NamedTuple

import numpy as np

from pendula.measures.difference import difference, divergence_time, is_of_same_case, known_until
from pendula.report.results import Results
from pendula.report.words import horizon_in_words

TRUST, GROWTH = "checks/trust", "checks/lyapunov"

KNOWN = ("off", "agrees", "ended", "unknown")
"""What is known of a run beside its reference: it leaves it; it agrees to its own end, or to that
of the reference, which ends before; there is no reference of this case."""


class Known(NamedTuple):
    """Which of KNOWN a run is, when it leaves its reference, and until when both are known.

    `source` is the dataset that tells it.
    """

    state: str
    words: str
    until: float
    source: str


def trusted(results: Results, case: str) -> Known:
    """Return what is known of a run; one by other controls than its solver's was not judged yet."""
    source = f"trajectories/{case}"
    run, trust = results[source], results[TRUST].sel(case=case)
    solver = run.attrs["solver"]
    if solver in trust["solver"].values and controls_of(
        results[f"{source}.{solver}"].attrs
    ) == controls_of(run.attrs):
        judged, source = trust.sel(solver=solver, level="visible"), TRUST
        time, until, end = (float(judged[name]) for name in ("horizon", "known_until", "run_end"))
    else:
        time, until, end = _judged(run, results[f"truth/{case}"])
    words = horizon_in_words(time, until, end)
    if np.isnan(until):
        return Known("unknown", words, until, source)
    if np.isfinite(time):
        return Known("off", words, until, source)
    return Known("agrees" if until >= end else "ended", words, until, source)


def _judged(run, reference) -> tuple[float, float, float]:
    """Return when a run leaves its reference, until when both are known, and when it ends."""
    end = float(run["tau"][-1])
    if not is_of_same_case(run, reference):
        return np.nan, np.nan, end
    apart = difference(run, reference)
    return float(divergence_time(apart)), float(known_until(apart)), end


def controls_of(attributes: Mapping) -> dict[str, Any]:
    """Return the solver and its controls, from the attributes of a run."""
    return {key: value for key, value in attributes.items() if key.startswith("solver")}


def is_chaotic(results: Results, case: str) -> bool:
    """Return whether a case counts as chaotic; of one whose small changes are unknown, it does not.

    What a run of a regular case misses of its reference is the error of its solver.
    """
    growth = results[GROWTH]
    return case in growth["case"].values and bool(growth["chaotic"].sel(case=case) == 1)
