"""The paper's solvers in numbers: energy, agreement with each other and with the references.

Two pages of tables, and the report's part on the solvers.
"""

import math
from itertools import product
from typing import Any

import numpy as np
import xarray

from pendula.datasets.netcdf import read
from pendula.datasets.registry import SOLVER_NAMES
from pendula.ledger.section import Ledger
from pendula.report.results import Results, Table
from pendula.report.words import (
    FIRM,
    case_of,
    horizons_in_words,
    markdown,
    number,
    percent,
    told,
    write_markdown,
)

from .solvers import ORDER


def tabulate_solvers(solvers: str, trust: str, table: str, trust_table: str) -> None:
    """Write one page of tables on each dataset."""
    compared = read(solvers)
    parts = [energy_part(compared), agreement_part(compared), sweep_part(compared)]
    title = "# The two solvers of the paper"
    write_markdown(table, title, *(text for part in parts for text in part))
    write_markdown(trust_table, *trust_part(read(trust)))


def energy_part(data: xarray.Dataset) -> list[str]:
    """Return the largest drift early and by the end, beside the order that the paper states."""
    ends = [[f"{float(until):g}" for until in sorted(set(one.values))] for one in data["until"].T]
    early, end = (" or ".join(each) for each in ends)
    words = (
        f"Largest drift of H by tau = {early} / by tau = {end}, beside the order that the paper "
        "states. Kept is a drift of at most twice that order."
    )
    rows = []
    for name in data["case"].values:
        case = data.sel(case=name)
        drifts = [
            " / ".join(f"{drift:.1e}" for drift in one.values)
            for one in case["largest_drift"].transpose("solver", "span")
        ]
        stated, claimed = "none: another case", "no claim"
        if not math.isnan(case["stated_drift"]):
            kept = zip(("early", "to the end"), case["kept"].sel(solver="ode45"), strict=True)
            claimed = ", ".join(word if holds else f"not {word}" for word, holds in kept)
            stated = f"{float(case['stated_drift']):.0e}"
        rows.append((name, stated, *drifts, claimed))
    head = ("case", "paper", *data["solver"].values, "ode45 as claimed")
    return ["## Conservation of the energy", words, markdown(head, rows)]


def agreement_part(data: xarray.Dataset) -> list[str]:
    """Return the divergence time of each pair of solvers in each case."""
    words = (
        f"The first tau at which the norms of two solvers differ by {float(data['visible']):.0%} "
        "of full scale, and the largest difference. Once a pair has diverged in a chaotic case, "
        "it stays so: the curves are then two different solutions of the same kind."
    )
    rows = []
    for name in data["case"].values:
        case = data.sel(case=name)
        pairs = zip(case["divergence_time"].values, case["largest_difference"].values, strict=True)
        told = [
            f"{'never' if time == math.inf else f'{time:.1f}'} ({largest:.0e})"
            for time, largest in pairs
        ]
        rows.append((name, *told))
    head = ("case", *data["pair"].values)
    return ["## Agreement of the trajectories", words, markdown(head, rows)]


def sweep_part(data: xarray.Dataset) -> list[str]:
    """Return how far the swept l2 norms of the pair differ between the paper's two solvers."""
    words = (
        "Largest and median difference of the pair's l2 norm between the two solvers over all "
        "half-widths, relative to the first solver's value. Points of a chaotic sweep differ by "
        "chance: the ledger holds them to the ensemble."
    )
    rows = []
    for sweep, window in product(data["sweep"].values, data["window"].values):
        cells = []
        for statistic in ("max", "mean"):
            found = data.sel(sweep=sweep, window=window, statistic=statistic)
            values = [float(found[f"{name}_sweep_difference"]) for name in ("largest", "median")]
            told = " / ".join(f"{value:.1e}" for value in values)
            cells.append("not swept" if any(map(math.isnan, values)) else told)
        rows.append((sweep, window, *cells))
    head = ("sweep", "window", "maximum: largest / median", "mean: largest / median")
    return ["## Agreement of the sweeps", words, markdown(head, rows)]


def trust_part(data: xarray.Dataset) -> list[str]:
    """Return until when each solver can be trusted: a row a solver, a column a level."""
    words = (
        "The first tau at which a norm is off by a part of its full scale (0.67 % is the width of "
        "a line in Figs 2 to 4), against the multiprecision references."
    )
    if (data["known_until"] < data["run_end"]).any():
        words += " Where a reference ends before the run, nothing is known of the time after it."
    rows = [
        (case, solver, *horizons_in_words(data.sel(case=case, solver=solver), 4))
        for case in data["case"].values
        for solver in data["solver"].values
    ]
    head = ("case", "solver", *(f"off by {float(size):.2%}" for size in data["size"]))
    return ["# Until when the solvers can be trusted", words, markdown(head, rows)]


# --- The report's part ----------------------------------------------------------------------------

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
