"""What is known of a run beside its reference."""

from collections.abc import Mapping
from typing import Any

import numpy as np

from pendula.measures.difference import difference, divergence_time, is_of_same_case, known_until
from pendula.report.results import Results
from pendula.report.words import horizon_in_words

TRUST = "checks/trust"


def trusted(results: Results, case: str) -> tuple[str, str]:
    """Return in words when a run leaves its reference, and the dataset that has this time.

    A run by other controls than its solver's in checks/trust was not judged there, and is here.
    """
    source = f"trajectories/{case}"
    run, trust = results[source], results[TRUST].sel(case=case)
    solver = run.attrs["solver"]
    if solver in trust["solver"].values and controls_of(
        results[f"{source}.{solver}"].attrs
    ) == controls_of(run.attrs):
        judged, source = trust.sel(solver=solver, level="visible"), TRUST
        times = (float(judged[name]) for name in ("horizon", "known_until", "run_end"))
    else:
        reference, end = results[f"truth/{case}"], float(run["tau"][-1])
        times = np.nan, np.nan, end
        if is_of_same_case(run, reference):
            apart = difference(run, reference)
            times = float(divergence_time(apart)), float(known_until(apart)), end
    return horizon_in_words(*times), source


def controls_of(attributes: Mapping) -> dict[str, Any]:
    """Return the solver and its controls, from the attributes of a run."""
    return {key: value for key, value in attributes.items() if key.startswith("solver")}
