"""The paper's solvers compared: energy, agreement with each other, and with the reference.

Section 5 states to which order the energy is conserved, and that a second solver gives no
significant differences. Both are measured here once; figures, tables, claims and the report read
the two datasets.
"""

from collections.abc import Mapping

import numpy as np
import xarray as xr

from pendula.measures.difference import (
    LEVELS,
    VISIBLE,
    difference,
    divergence_time,
    is_of_same_case,
)
from pendula.measures.norms import drift, late_difference

Runs = Mapping[tuple[str, str], xr.Dataset]
"""Trajectories by (case, solver)."""

PAIRS = ("ode45 - crank_nicolson", "crank_nicolson - dop853", "ode45 - dop853")
STATED_DRIFT = {"small": 1e-6, "large": 1e-4}
"""The orders of the energy's drift that the paper states, for the cases whose names end so."""
# ASSUME: "up to the order of 10^-k" allows up to twice that number.
ORDER = 2.0
EARLY = 10.0
"""Slow time up to which an early drift is read."""
# Where the doubles next to two solutions begin to tell them apart.
DIGITS = 1e-12


def compare(runs: Runs, sweeps: Mapping[str, tuple[xr.Dataset, xr.Dataset]]) -> xr.Dataset:
    """Return how each solver keeps the energy, and how far pairs of solvers differ.

    `sweeps` holds each sweep by the first of the paper's solvers and by the second.
    """
    cases = list(dict.fromkeys(case for case, _ in runs))
    by_case = [_compare_case(runs, case) for case in cases]
    data = xr.merge(
        [_stack(by_case, "case", cases, "case"), _compare_sweeps(sweeps)], combine_attrs="override"
    )
    data["visible"] = _variable((), VISIBLE, "visible part of full scale")
    return data.assign_attrs(title="The paper's solvers: drift of the energy, and agreement")


def _compare_case(runs: Runs, case: str) -> xr.Dataset:
    solvers = [solver for name, solver in runs if name == case]
    chosen = {solver: runs[case, solver] for solver in solvers}
    return xr.merge([_drifts(chosen, case), _differences(chosen), _problem(chosen[solvers[0]])])


def _drifts(runs: Mapping[str, xr.Dataset], case: str) -> xr.Dataset:
    tau = next(iter(runs.values()))["tau"]
    values = np.array([drift(run["energy"]) for run in runs.values()])
    early = min(EARLY, float(tau[-1]))
    largest = np.stack([values[:, tau <= early].max(axis=1), values.max(axis=1)], axis=1)
    stated = STATED_DRIFT.get(case.rpartition("_")[2], np.nan)
    by_solver = ("solver", "span")
    return xr.Dataset(
        {
            "drift": _variable(("solver", "tau"), values, "drift of the energy |H(tau) - H(0)|"),
            "largest_drift": _variable(by_solver, largest, "largest drift of the energy"),
            "until": _variable(("span",), [early, float(tau[-1])], "end of the span of slow time"),
            "stated_drift": _variable((), stated, "order of the drift that the paper states"),
            "allowed_drift": _variable((), ORDER * stated, "largest drift that is of that order"),
            "kept": _variable(
                by_solver,
                (largest <= ORDER * stated).astype(int),
                "one where the drift is of the order that the paper states",
            ),
        },
        {
            "tau": tau,
            "solver": _variable(("solver",), list(runs), "solver"),
            "span": _variable(("span",), ["early", "whole"], "span of slow time from the start"),
        },
    )


def _differences(runs: Mapping[str, xr.Dataset]) -> xr.Dataset:
    pairs = [tuple(pair.split(" - ")) for pair in PAIRS]
    curves = [difference(runs[one], runs[other]) for one, other in pairs]
    name = _variable(("pair",), list(PAIRS), "pair of solvers")
    data = xr.concat(curves, xr.Variable(*name)).to_dataset()
    data["divergence_time"] = divergence_time(data["difference"])
    data["largest_difference"] = data["difference"].max("tau")
    data["largest_difference"].attrs = _words("largest difference of the norms of two solvers")
    late = [late_difference(runs[one], runs[other]) for one, other in pairs]
    data["late_difference"] = _variable(
        ("pair",), late, "relative difference of the mean norms over the second half of the time"
    )
    return data


def _compare_sweeps(sweeps: Mapping[str, tuple[xr.Dataset, xr.Dataset]]) -> xr.Dataset:
    """Return the relative difference of the pair's swept l2 norms, by sweep and half-width."""
    found = []
    for first, second in sweeps.values():
        off = abs(second["l2"] / first["l2"] - 1).sel(quantity="pair", drop=True)
        if off.sizes["half_width"] != first.sizes["half_width"]:
            raise ValueError("the two solvers' sweeps differ in their half-widths")
        found.append(off.rename("sweep_difference").to_dataset())
    data = _stack(found, "sweep", list(sweeps), "sweep")
    title = "relative difference of the pair's l2 norm between the paper's two solvers"
    data["sweep_difference"].attrs = _words(title)
    for name in ("max", "median"):
        reduced = getattr(data["sweep_difference"], name)("half_width")
        word = {"max": "largest", "median": "median"}[name]
        about = _words(f"{word} of these differences over the half-widths")
        data[f"{word}_sweep_difference"] = reduced.assign_attrs(about)
    return data


def trust(
    runs: Runs,
    references: Mapping[str, xr.Dataset],
    decimal: tuple[xr.Dataset, xr.Dataset] | None = None,
) -> xr.Dataset:
    """Return by case and solver how far the norms are from the reference's, and from when on.

    A run that does not solve its reference's problem has no horizon: there it is NaN. `decimal`
    holds the references from data as printed (a tenth, say) and from the doubles next to them.
    """
    cases = list(dict.fromkeys(case for case, _ in runs))
    by_case = [_trust_case(runs, case, references[case]) for case in cases]
    data = _stack(by_case, "case", cases, "case")
    if decimal is not None:
        apart = difference(*decimal)
        times = [float(divergence_time(apart, level)) for level in (DIGITS, VISIBLE)]
        title = "first tau at which data rounded to doubles lead away from data as printed"
        data["decimal_size"] = _variable(("decimal_level",), [DIGITS, VISIBLE], "size of the level")
        data["decimal_horizon"] = _variable(("decimal_level",), times, title)
    return data.assign_attrs(title="Until when each solver's norms are those of the reference")


def _trust_case(runs: Runs, case: str, reference: xr.Dataset) -> xr.Dataset:
    chosen = {solver: run for (name, solver), run in runs.items() if name == case}
    curves = [_error(run, reference) for run in chosen.values()]
    solver = xr.Variable(*_variable(("solver",), list(chosen), "solver"))
    data = xr.concat(curves, solver).to_dataset()
    levels = xr.Variable(*_variable(("level",), list(LEVELS), "when curves are told apart"))
    times = [divergence_time(data["difference"], level) for level in LEVELS.values()]
    data["horizon"] = xr.concat(times, levels)
    data["horizon"].attrs = _words("first tau at which a norm is off by the level")
    data["size"] = _variable(("level",), list(LEVELS.values()), "size of the level")
    return data.merge(_problem(next(iter(chosen.values()))))


def _error(run: xr.Dataset, reference: xr.Dataset) -> xr.DataArray:
    if is_of_same_case(run, reference):
        return difference(run, reference)
    about = _words("largest difference of the norms relative to their scale")
    unknown = np.full(run.sizes["tau"], np.nan)
    return xr.DataArray(unknown, {"tau": run["tau"]}, ("tau",), "difference", about)


def _problem(run: xr.Dataset) -> xr.Dataset:
    return xr.Dataset(
        {
            "omega": _variable((), float(run.attrs["omega"]), "detuning Omega"),
            "initial": _variable((), str(run.attrs["initial"]), "initial {site: [A, B]}"),
        }
    )


def _stack(parts: list[xr.Dataset], dimension: str, names: list[str], title: str) -> xr.Dataset:
    """Return the parts along a new dimension; what all have in common stands once."""
    common = {"span", "level", "size"}
    kept = [name for name in parts[0].data_vars if name in common]
    once = parts[0][kept]
    coordinate = xr.Variable(*_variable((dimension,), names, title))
    each = [part.drop_vars(kept) for part in parts]
    return xr.concat(each, coordinate, join="outer", combine_attrs="override").merge(once)


def _variable(dims: tuple, values, long_name: str) -> tuple:
    return dims, np.asarray(values), _words(long_name)


def _words(long_name: str) -> dict[str, str]:
    return {"long_name": long_name, "units": "1"}
