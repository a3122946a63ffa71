"""The report's part on the paper's solvers: how they keep the energy, until when they agree."""

from typing import Any

import numpy as np

from pendula.datasets.registry import SOLVER_NAMES
from pendula.ledger.section import Ledger
from pendula.report.results import Results, Table
from pendula.report.words import FIRM, case_of, number, percent, told

from .solvers import ORDER

COMPARED, STEPS = "checks/solvers", "checks/second_solver"


def gather_solvers(results: Results, ledger: Ledger) -> dict[str, Any]:
    """Return how well the solvers keep the energy, and until when pairs of them agree."""
    early, data = (results[COMPARED].sel(span=span) for span in ("early", "whole"))
    cases = [data.sel(case=case) for case in data["case"].values]
    solvers = [SOLVER_NAMES[str(solver)] for solver in data["solver"].values]
    pairs = [" and ".join(SOLVER_NAMES[name] for name in str(pair).split(" - "))
             for pair in data["pair"].values]  # fmt: skip
    ends = [f"kept by ode45 to τ{FIRM}={FIRM}{number(float(one['until'].max()))}"
            for one in (early, data)]  # fmt: skip
    return {
        "drift": Table(
            f"Largest drift of the energy; kept means below {number(ORDER.number)} times the order "
            "that the paper states", ["case", "stated", *solvers, *ends],
            [_drift(results, case) for case in cases],
        ),
        "energy_drift": results.figure("energy_drift", told(
            "The largest drift of the energy up to each time, by each solver. The dashed line is "
            "the order that the paper states, where it states one. {trapezoidal} does not conserve "
            "an energy of fourth degree; the scheme of Delfour, Fortin and Payre does.",
            trapezoidal=SOLVER_NAMES["crank_nicolson"],
        )),
        "agreement": Table(
            "First τ at which the norms by two solvers differ by "
            f"{percent(float(data['visible']))} of full scale", ["case", *pairs],
            [[case_of(case), *(results.quote_time(COMPARED, float(time))
                               for time in case["divergence_time"].values)] for case in cases],
        ),
        "solver_agreement": results.figure("solver_agreement", (
            "The largest difference of the norms by two solvers up to each time. A mark shows when "
            "it becomes visible. In a chaotic case two solvers must part; in another case the "
            "difference is the error of a solver."
        )),
        "schemes": _schemes(results),
    }  # fmt: skip


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


def _schemes(results: Results) -> Table:
    """Return how far both readings of the second solver are from ode45, at each step."""
    data = results[STEPS]
    chosen = data["scheme_difference"].stack(reading=("step", "scheme"))
    step, first = float(data.attrs["configured_step"]), "crank_nicolson"
    kept = [at for at in chosen["reading"].values if at[1] == first or np.isclose(at[0], step)]
    kept.sort(key=lambda at: at[1] != first)
    return Table(
        "Largest difference of the norms from ode45, by the scheme and its step; the paper gives "
        f"no step, and the runs have {number(step)}. Crank-Nicolson is read as the trapezoidal "
        "rule, and the implicit midpoint rule is the other reading",
        ["case", *(f"{SOLVER_NAMES[name]}, {number(at)}" for at, name in kept)],
        [[case_of(data.sel(case=case)),
          *(results.say(STEPS, percent(chosen.sel(case=case, reading=at))) for at in kept)]
         for case in data["case"].values],
    )  # fmt: skip
