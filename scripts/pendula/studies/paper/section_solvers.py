"""The report's part on the paper's solvers: how they keep the energy, until when they agree."""

from typing import Any

import numpy as np

from pendula.datasets.registry import SOLVER_NAMES
from pendula.ledger.section import Ledger
from pendula.report.page import Picture
from pendula.report.results import Results
from pendula.report.words import FIRM, case_of, number, percent

from .known import is_chaotic
from .solvers import ORDER

COMPARED, STEPS = "checks/solvers", "checks/second_solver"


def gather_solvers(results: Results, ledger: Ledger) -> dict[str, Any]:
    """Return how well the solvers keep the energy, and until when pairs of them agree."""
    early, data = (results[COMPARED].sel(span=span) for span in ("early", "whole"))
    cases = [data.sel(case=case) for case in data["case"].values]
    ode45 = data.sel(solver="ode45")
    papers = data["divergence_time"].isel(pair=0)
    stated = data["stated_drift"].dropna("case")
    held = data.sel(case=stated["case"]) if len(stated) else data
    apart = int(np.isfinite(papers).sum())
    chaotic = np.array([is_chaotic(results, str(case)) for case in data["case"].values])
    largest = data["largest_difference"].max("pair").values
    solvers = [SOLVER_NAMES[str(solver)] for solver in data["solver"].values]
    return {
        "drift_head": ["case", "as stated", *solvers, *_kept_heads(early, held)],
        "drift": [_drift(results, case) for case in cases],
        "stated": len(stated) > 0,
        "held": results.quote(COMPARED, len(stated)),
        "others": [case_of(case) for case in cases if np.isnan(float(case["stated_drift"]))],
        "tolerances": not any(path.startswith("solvers.ode45.") for path in results.differs),
        "kept": results.quote(COMPARED, int(ode45["kept"].sum())),
        "kept_early": results.quote(COMPARED, int(early["kept"].sel(solver="ode45").sum())),
        "early": results.quote(COMPARED, float(early["until"].max())),
        "allowed": results.quote(COMPARED, ORDER.number),
        "cases": results.quote(COMPARED, len(cases)),
        "end": results.quote(COMPARED, float(held["until"].max())),
        "agreement_head": ["case", *(_pair(str(pair)) for pair in data["pair"].values)],
        "agreement": [_agreement(results, case) for case in cases],
        "apart": results.quote(COMPARED, apart),
        "first": results.quote_time(COMPARED, float(papers.min())),
        "visible": percent(float(data["visible"])),
        "coarse": bool((largest[~chaotic] >= largest[chaotic].min(initial=np.inf)).any()),
        "schemes": _schemes(results),
        "pictures": _solver_pictures(results, ode45["largest_drift"].values, apart),
    }


def _drift(results: Results, case) -> list:
    stated = float(case["stated_drift"])
    both = results[COMPARED]["kept"].sel(case=str(case["case"].values), solver="ode45")
    words = {1.0: "yes", 0.0: "no"}
    return [
        case_of(case),
        results.quote(COMPARED, stated) if np.isfinite(stated) else "none: another case",
        *(results.quote(COMPARED, float(value), 2) for value in case["largest_drift"]),
        *(results.say(COMPARED, words.get(float(kept), "no claim")) for kept in both),
    ]


def _kept_heads(early, whole) -> list[str]:
    times = (number(float(data["until"].max())) for data in (early, whole))
    return [f"kept by ode45 to τ{FIRM}={FIRM}{time}" for time in times]


def _schemes(results: Results) -> dict[str, Any]:
    """Return how far both readings of the second solver are from ode45, at each step."""
    data = results[STEPS]
    chosen = data["scheme_difference"].stack(reading=("step", "scheme"))
    step = float(data.attrs["configured_step"])
    first = "crank_nicolson"
    kept = [at for at in chosen["reading"].values if at[1] == first or at[0] == step]
    kept.sort(key=lambda at: at[1] != first)
    rows = [
        [case_of(data.sel(case=case))]
        + [results.say(STEPS, percent(chosen.sel(case=case, reading=at))) for at in kept]
        for case in data["case"].values
    ]
    return {
        "head": ["case", *(f"{SOLVER_NAMES[name]}, {number(at)}" for at, name in kept)],
        "rows": rows,
        "step": results.quote(STEPS, step),
        "trapezoidal": SOLVER_NAMES["crank_nicolson"],
        "conserving": SOLVER_NAMES["delfour_fortin_payre"],
    }


def _agreement(results: Results, case) -> list:
    times = case["divergence_time"].values
    return [case_of(case), *(results.quote_time(COMPARED, float(time)) for time in times)]


def _pair(names: str) -> str:
    return " and ".join(SOLVER_NAMES[name] for name in names.split(" - "))


def _solver_pictures(results: Results, drifts: np.ndarray, apart: int) -> dict[str, Picture]:
    told = {
        "energy_drift": "Drift of the energy against τ by each solver; by ode45 it ends between "
        f"{number(drifts.min(), 2)} and {number(drifts.max(), 2)}.",
        "solver_agreement": "Differences of the norms between pairs of solvers against τ; the "
        f"paper's two diverge in {apart} of {len(drifts)} cases.",
    }
    return {name: results.picture(name, alt) for name, alt in told.items()}
