"""The paper's solvers compared: energy, agreement with each other, and with the reference.

Section 5 states to which order the energy is conserved, and that a second solver gives no
significant differences. Both are measured here once; figures, tables, claims and the report read
the two datasets.
"""

from collections.abc import Collection, Mapping

import numpy as np
import xarray as xr

from pendula.datasets.trajectories import shared_by
from pendula.ledger.cutoff import Cutoff
from pendula.measures.difference import (
    ABSENT,
    LEVELS,
    NORMS,
    VISIBLE,
    difference,
    divergence_time,
    is_of_same_case,
    known_until,
)
from pendula.measures.norms import drift

Runs = Mapping[tuple[str, str], xr.Dataset]
"""Trajectories by (case, solver)."""

PAIRS = ("ode45 - crank_nicolson", "ode45 - delfour_fortin_payre", "ode45 - dop853")
"""The paper's two solvers first; each difference is from the paper's first solver."""
STATED_DRIFT = {"small": 1e-6, "large": 1e-4}
"""The orders of the energy's drift that the paper states, for the cases whose names end so."""
# ASSUME: "up to the order of 10^-k" allows up to twice that number.
ORDER = Cutoff(2.0, '"up to the order of": up to twice the number')
EARLY = 10.0
"""Slow time up to which an early drift is read."""
# Where the doubles next to two solutions begin to tell them apart.
DIGITS = 1e-12


COMPARED = {
    "drift": "drift of the energy, |H(tau) - H(0)|",
    "largest_drift": "largest drift of the energy",
    "span": "span of slow time from the start",
    "until": "end of the span of slow time",
    "stated_drift": "order of the drift that the paper states",
    "allowed_drift": "largest drift that is of that order",
    "kept": "one where the drift is of the order that the paper states",
    "pair": "pair of solvers",
    "largest_difference": "largest difference of the norms of two solvers",
    "sweep_difference": "relative difference of the pair's l2 norm between the paper's two solvers",
    "largest_sweep_difference": "largest of these differences over the half-widths",
    "median_sweep_difference": "median of these differences over the half-widths",
    "visible": "visible part of full scale",
}
TRUSTED = {
    "level": "level of the difference from which on curves are told apart",
    "size": "size of the level, as a part of full scale",
    "horizon": f"first tau at which a norm is off by the level, {ABSENT}",
    "known_until": "last tau at which run and reference are both known; NaN: no reference",
    "run_end": "end of the runs of the case",
    "proven_bound": "proven bound of the error of the certified curve, as a part of the smallest "
    "full scale of its norms; NaN: nothing is proved",
    "proved_until": "last tau at which this bound is not visible; NaN: nothing is proved",
    "decimal_size": "size of a level, as a part of full scale",
    "decimal_horizon": "first tau at which data rounded to doubles lead away from data as printed",
}
"""What the two datasets hold, beside names of the registry and of `measures.difference`."""


def compare_solvers(
    trajectories: Mapping[str, xr.Dataset],
    first: Mapping[str, xr.Dataset],
    second: Mapping[str, xr.Dataset],
    others: Collection[str],
) -> xr.Dataset:
    """Return `compare` of datasets by name; `first` and `second` are sweeps in one order."""
    pairs = zip(first.values(), second.values(), strict=True)
    return compare(by_solvers(trajectories), dict(zip(first, pairs, strict=True)), others)


def trust_solvers(
    trajectories: Mapping[str, xr.Dataset],
    references: Mapping[str, xr.Dataset],
    decimal: Mapping[str, xr.Dataset],
    proved: Mapping[str, xr.Dataset],
    proofs: Mapping[str, xr.Dataset],
) -> xr.Dataset:
    """Return `trust` of datasets by name; `proofs` are proved curves that are kept."""
    runs, decimals = by_solvers(trajectories), tuple(decimal.values())
    return trust(runs, references, decimals, {**proved, **proofs})


def by_solvers(trajectories: Mapping[str, xr.Dataset]) -> Runs:
    """Return trajectories whose names are those of a case and of a solver."""
    return {tuple(name.split(".")): run for name, run in trajectories.items()}


def compare(
    runs: Runs,
    sweeps: Mapping[str, tuple[xr.Dataset, xr.Dataset]],
    others: Collection[str] = (),
) -> xr.Dataset:
    """Return how each solver keeps the energy, and how far pairs of solvers differ (see COMPARED).

    `sweeps` holds each sweep by the first of the paper's solvers and by the second. Of the cases
    `others`, which are not the paper's, it states no order: order and what is kept of it are NaN.
    """
    cases = list(dict.fromkeys(case for case, _ in runs))
    orders = {case: _stated(case) if case not in others else np.nan for case in cases}
    by_case = [_compare_case(_by_solver(runs, case), orders[case]) for case in cases]
    data = xr.merge([_stack(by_case, "case", cases), _compare_sweeps(sweeps)])
    title = "The paper's solvers: drift of the energy, and agreement"
    return _described(data.assign(visible=VISIBLE), COMPARED, runs, title)


def _by_solver(runs: Runs, case: str) -> dict[str, xr.Dataset]:
    return {solver: run for (name, solver), run in runs.items() if name == case}


def _stated(case: str) -> float:
    return STATED_DRIFT.get(case.rpartition("_")[2], np.nan)


def _compare_case(runs: Mapping[str, xr.Dataset], stated: float) -> xr.Dataset:
    return xr.merge([_drifts(runs, stated), _differences(runs), _problem(runs)])


def _drifts(runs: Mapping[str, xr.Dataset], stated: float) -> xr.Dataset:
    tau = next(iter(runs.values()))["tau"]
    values = np.array([drift(run["energy"]) for run in runs.values()])
    early = min(EARLY, float(tau[-1]))
    largest = np.stack([values[:, tau <= early].max(axis=1), values.max(axis=1)], axis=1)
    kept = (largest <= ORDER.value * stated).astype(int)
    by_solver = ("solver", "span")
    return xr.Dataset(
        {
            "drift": (("solver", "tau"), values),
            "largest_drift": (by_solver, largest),
            "until": ("span", [early, float(tau[-1])]),
            "stated_drift": stated,
            "allowed_drift": ORDER.value * stated,
            "kept": (by_solver, kept if np.isfinite(stated) else np.full(kept.shape, np.nan)),
        },
        {"tau": tau, "solver": list(runs), "span": ["early", "whole"]},
    )


def _differences(runs: Mapping[str, xr.Dataset]) -> xr.Dataset:
    pairs = [[runs[solver] for solver in pair.split(" - ")] for pair in PAIRS]
    apart = xr.concat([difference(*pair) for pair in pairs], xr.Variable("pair", list(PAIRS)))
    return apart.to_dataset().assign(
        divergence_time=divergence_time(apart),
        largest_difference=apart.max("tau"),
    )


def _compare_sweeps(sweeps: Mapping[str, tuple[xr.Dataset, xr.Dataset]]) -> xr.Dataset:
    """Return the relative difference of the pair's swept l2 norms, by sweep and half-width."""
    found = []
    for first, second in sweeps.values():
        off = abs(second["l2"] / first["l2"] - 1).sel(quantity="pair", drop=True)
        if off.sizes["half_width"] != first.sizes["half_width"]:
            raise ValueError("the two solvers' sweeps differ in their half-widths")
        found.append(off.to_dataset(name="sweep_difference"))
    data = _stack(found, "sweep", list(sweeps))
    return data.assign(
        largest_sweep_difference=data["sweep_difference"].max("half_width"),
        median_sweep_difference=data["sweep_difference"].median("half_width"),
    )


def trust(
    runs: Runs,
    references: Mapping[str, xr.Dataset],
    decimal: tuple[xr.Dataset, xr.Dataset] | None = None,
    proved: Mapping[str, xr.Dataset] | None = None,
) -> xr.Dataset:
    """Return by case and solver how far the norms are from the reference's, and from when on.

    A run that does not solve its reference's problem has no horizon: there it is NaN. `decimal`
    holds the references from data as printed (a tenth, say) and from the doubles next to them, and
    `proved` curves with a proven bound, which is beside the runs where it is of their problem.
    """
    cases = list(dict.fromkeys(case for case, _ in runs))
    by_case = [
        _trust_case(_by_solver(runs, case), references[case], (proved or {}).get(case))
        for case in cases
    ]
    data = _stack(by_case, "case", cases).assign(size=("level", list(LEVELS.values())))
    if decimal is not None:
        apart = difference(*decimal)
        times = [float(divergence_time(apart, level)) for level in (DIGITS, VISIBLE)]
        data["decimal_size"] = "decimal_level", [DIGITS, VISIBLE]
        data["decimal_horizon"] = "decimal_level", times
    title = "Until when each solver's norms are those of the reference"
    return _described(data, TRUSTED, runs, title)


def _trust_case(
    runs: Mapping[str, xr.Dataset], reference: xr.Dataset, proved: xr.Dataset | None
) -> xr.Dataset:
    errors = [_error(run, reference) for run in runs.values()]
    apart = xr.concat(errors, xr.Variable("solver", list(runs)))
    times = [divergence_time(apart, level) for level in LEVELS.values()]
    horizon = xr.concat(times, xr.Variable("level", list(LEVELS)))
    known = {"known_until": known_until(apart), "run_end": _end(runs)}
    bound = _proven_bound(next(iter(runs.values())), proved)
    until = known_until(bound.where(bound <= VISIBLE))
    found = apart.to_dataset().assign(horizon=horizon, **known)
    return xr.merge([found.assign(proven_bound=bound, proved_until=until), _problem(runs)])


def _proven_bound(run: xr.Dataset, proved: xr.Dataset | None) -> xr.DataArray:
    """Return the proven bound of a curve of the run's problem, as a part of full scale, (tau)."""
    if proved is None or not is_of_same_case(run, proved):
        return xr.full_like(run["tau"], np.nan)
    known = proved[["bound", *NORMS]].reindex(tau=run["tau"], method="nearest", tolerance=1e-9)
    return known["bound"] / min(float(known[name].max("tau").min()) for name in NORMS)


def _end(runs: Mapping[str, xr.Dataset]) -> float:
    return float(next(iter(runs.values()))["tau"][-1])


def _error(run: xr.Dataset, reference: xr.Dataset) -> xr.DataArray:
    if is_of_same_case(run, reference):
        return difference(run, reference)
    return difference(run, run) * np.nan


def _problem(runs: Mapping[str, xr.Dataset]) -> xr.Dataset:
    about = next(iter(runs.values())).attrs
    return xr.Dataset({"omega": float(about["omega"]), "initial": str(about["initial"])})


def _stack(parts: list[xr.Dataset], dimension: str, names: list[str]) -> xr.Dataset:
    """Return the parts along a new dimension."""
    return xr.concat(parts, xr.Variable(dimension, names), join="outer")


def _described(data: xr.Dataset, names: Mapping, runs: Runs, title: str) -> xr.Dataset:
    """Return a dataset with its long names, and with what all runs have in common."""
    for name, long_name in names.items():
        if name in data:
            data[name].attrs = {"long_name": long_name}
    shared = shared_by([run.attrs for run in runs.values()])
    return data.assign_attrs({**shared, "title": title})


def by(solver: str, names: tuple[str, ...]) -> tuple[str, ...]:
    """Return the names of the same runs or sweeps by another solver."""
    return tuple(f"{name}.{solver}" for name in names)
