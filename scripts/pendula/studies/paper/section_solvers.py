"""The paper's two solvers: how well the energy is kept, and until when they agree."""

from typing import Any

import numpy as np

from pendula.report.numbers import number, percent
from pendula.report.results import Results
from pendula.report.words import SOLVERS, case_of

DRIFT, AGREEMENT = "figures/energy_drift", "figures/solver_agreement"
ORDER = 2.0
"""An energy is kept to an order where it drifts by less than so many times that."""


def gather(results: Results) -> dict[str, Any]:
    """Return both pictures and both tables."""
    drift, agreement = results[DRIFT], results[AGREEMENT]
    cases = [str(case) for case in drift["case"].values]
    rows = [_drift(results, case) for case in cases]
    times = agreement["divergence_time"].isel(pair=0)
    apart = [case for case in cases if np.isfinite(times.sel(case=case))]
    return {
        "drift_head": ["case", "as stated", *(SOLVERS[str(s)] for s in drift["solver"].values),
                       "kept by ode45"],
        "drift": [row["cells"] for row in rows],
        "kept": results.quote(DRIFT, sum(row["kept"] for row in rows)),
        "cases": results.quote(DRIFT, len(cases)),
        "end": results.quote(DRIFT, float(drift["tau"].max())),
        "agreement_head": ["case", *(_pair(str(pair)) for pair in agreement["pair"].values)],
        "agreement": [_agreement(results, case) for case in cases],
        "apart": results.quote(AGREEMENT, len(apart)),
        "first": results.quote_time(AGREEMENT, float(times.min())),
        "visible": percent(float(agreement["visible"])),
        "pictures": _pictures(results, rows, len(apart)),
    }  # fmt: skip


def _drift(results: Results, name: str) -> dict[str, Any]:
    case = results[DRIFT].sel(case=name)
    stated = float(case["claim"])
    largest = case["drift"].max("tau")
    kept = float(largest.sel(solver="ode45")) < ORDER * stated
    cells = [
        case_of(case),
        results.quote(DRIFT, stated),
        *(results.quote(DRIFT, float(value), 2) for value in largest),
        results.say(DRIFT, "yes" if kept else "no"),
    ]
    return {"cells": cells, "kept": kept, "largest": float(largest.sel(solver="ode45"))}


def _agreement(results: Results, name: str) -> list:
    case = results[AGREEMENT].sel(case=name)
    times = case["divergence_time"].values
    return [case_of(case), *(results.quote_time(AGREEMENT, float(time)) for time in times)]


def _pair(names: str) -> str:
    return " and ".join(SOLVERS[name] for name in names.split(" - "))


def _pictures(results: Results, rows: list[dict], apart: int) -> dict[str, Any]:
    largest = [row["largest"] for row in rows]
    return {
        "drift": results.picture(
            "energy_drift",
            f"Drift of the energy against τ by each solver; by ode45 it ends between "
            f"{number(min(largest), 2)} and {number(max(largest), 2)}.",
        ),
        "agreement": results.picture(
            "solver_agreement",
            f"Differences of the norms between pairs of solvers against τ; the paper's two diverge "
            f"in {apart} of {len(rows)} cases.",
        ),
    }
