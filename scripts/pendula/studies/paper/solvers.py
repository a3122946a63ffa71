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

PAIRS = ("ode45 - crank_nicolson", "ode45 - delfour_fortin_payre", "ode45 - dop853")
"""The paper's two solvers first; each difference is from the paper's first solver."""
STATED_DRIFT = {"small": 1e-6, "large": 1e-4}
"""The orders of the energy's drift that the paper states, for the cases whose names end so."""
# ASSUME: "up to the order of 10^-k" allows up to twice that number.
ORDER = Cutoff(2.0, '"up to the order of": up to twice the number')
EARLY = 10.0
"""Slow time up to which an early drift is read."""
DIGITS = 1e-12
"""Where two solutions whose data differ by the rounding to doubles can be distinguished."""

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
    others: Collection[str] = (),
) -> xr.Dataset:
    """Return how each solver keeps the energy, and how far pairs of solvers differ (see COMPARED).

    The names of `trajectories` are "case.solver"; `first` and `second` are the sweeps by the
    paper's two solvers, in one order. For the cases `others`, which are not the paper's, the paper
    states no order: the order and whether it is kept are NaN.
    """
    by_case, found = _by_case(trajectories), []
    for case, runs in by_case.items():
        stated = np.nan if case in others else STATED_DRIFT.get(case.rpartition("_")[2], np.nan)
        found.append(xr.merge([_drifts(runs, stated), _differences(runs), _problem(runs)]))
    data = xr.merge([_stack(found, "case", list(by_case)), _compare_sweeps(first, second)])
    title = "The paper's solvers: drift of the energy, and agreement"
    return _described(data.assign(visible=VISIBLE), COMPARED, trajectories, title)


def _by_case(trajectories: Mapping[str, xr.Dataset]) -> dict[str, dict[str, xr.Dataset]]:
    """Return the runs of each case by solver."""
    found: dict[str, dict] = {}
    for name, run in trajectories.items():
        case, solver = name.split(".")
        found.setdefault(case, {})[solver] = run
    return found


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


def _compare_sweeps(
    first: Mapping[str, xr.Dataset], second: Mapping[str, xr.Dataset]
) -> xr.Dataset:
    """Return the relative difference of the pair's swept l2 norms, by sweep and half-width."""
    found = []
    for one, other in zip(first.values(), second.values(), strict=True):
        off = abs(other["l2"] / one["l2"] - 1).sel(quantity="pair", drop=True)
        if off.sizes["half_width"] != one.sizes["half_width"]:
            raise ValueError("the two solvers' sweeps differ in their half-widths")
        found.append(off.to_dataset(name="sweep_difference"))
    data = _stack(found, "sweep", list(first))
    return data.assign(
        largest_sweep_difference=data["sweep_difference"].max("half_width"),
        median_sweep_difference=data["sweep_difference"].median("half_width"),
    )


def trust_solvers(
    trajectories: Mapping[str, xr.Dataset],
    references: Mapping[str, xr.Dataset],
    decimal: Mapping[str, xr.Dataset] = {},
    proved: Mapping[str, xr.Dataset] = {},
    proofs: Mapping[str, xr.Dataset] = {},
) -> xr.Dataset:
    """Return by case and solver how far the norms are from the reference's, and from when on.

    The names of `trajectories` are "case.solver". A run that does not solve its reference's problem
    has no horizon: there it is NaN. `decimal` holds the reference from data as printed (a tenth,
    say) and the one from the doubles next to them. `proved` holds computed curves with a proven
    bound, and `proofs` those that are kept; the bound counts where it is of the run's problem.
    """
    by_case, certified = _by_case(trajectories), {**proved, **proofs}
    found = [
        _trust_case(runs, references[case], certified.get(case)) for case, runs in by_case.items()
    ]
    data = _stack(found, "case", list(by_case)).assign(size=("level", list(LEVELS.values())))
    if decimal:
        apart = difference(*decimal.values())
        times = [float(divergence_time(apart, level)) for level in (DIGITS, VISIBLE)]
        data["decimal_size"] = "decimal_level", [DIGITS, VISIBLE]
        data["decimal_horizon"] = "decimal_level", times
    title = "Until when each solver's norms are those of the reference"
    return _described(data, TRUSTED, trajectories, title)


def _trust_case(
    runs: Mapping[str, xr.Dataset], reference: xr.Dataset, proved: xr.Dataset | None
) -> xr.Dataset:
    errors = [
        difference(run, reference)
        if is_of_same_case(run, reference)
        else difference(run, run) * np.nan
        for run in runs.values()
    ]
    apart = xr.concat(errors, xr.Variable("solver", list(runs)))
    times = [divergence_time(apart, level) for level in LEVELS.values()]
    run = next(iter(runs.values()))
    bound = _proven_bound(run, proved)
    found = apart.to_dataset().assign(
        horizon=xr.concat(times, xr.Variable("level", list(LEVELS))),
        known_until=known_until(apart),
        run_end=float(run["tau"][-1]),
        proven_bound=bound,
        proved_until=known_until(bound.where(bound <= VISIBLE)),
    )
    return xr.merge([found, _problem(runs)])


def _proven_bound(run: xr.Dataset, proved: xr.Dataset | None) -> xr.DataArray:
    """Return the proven bound of a curve of the run's problem, as a part of full scale, (tau)."""
    if proved is None or not is_of_same_case(run, proved):
        return xr.full_like(run["tau"], np.nan)
    known = proved[["bound", *NORMS]].reindex(tau=run["tau"], method="nearest", tolerance=1e-9)
    return known["bound"] / min(float(known[name].max("tau").min()) for name in NORMS)


def _problem(runs: Mapping[str, xr.Dataset]) -> xr.Dataset:
    about = next(iter(runs.values())).attrs
    return xr.Dataset({"omega": float(about["omega"]), "initial": str(about["initial"])})


def _stack(parts: list[xr.Dataset], dimension: str, names: list[str]) -> xr.Dataset:
    """Return the parts along a new dimension."""
    return xr.concat(parts, xr.Variable(dimension, names), join="outer")


def _described(data: xr.Dataset, names: Mapping, runs: Mapping, title: str) -> xr.Dataset:
    """Return a dataset with its long names, and with what all runs have in common."""
    for name, long_name in names.items():
        if name in data:
            data[name].attrs = {"long_name": long_name}
    shared = shared_by([run.attrs for run in runs.values()])
    return data.assign_attrs({**shared, "title": title})


def by(solver: str, names: tuple[str, ...]) -> tuple[str, ...]:
    """Return the names of the same runs or sweeps by another solver."""
    return tuple(f"{name}.{solver}" for name in names)
