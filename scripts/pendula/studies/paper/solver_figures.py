"""The solvers side by side: the drift of the energy, their agreement, their error."""

from collections.abc import Mapping

import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from pendula.drawing import panels, style
from pendula.measures.difference import VISIBLE, difference, divergence_time

from .solvers import trust

Trajectories = Mapping[tuple[str, str], xr.Dataset]
"""Trajectories by (case, solver); the cases of one figure follow each other, small then large."""

CLAIMS = {"small": 1e-6, "large": 1e-4}
"""The drifts that the paper states, for the cases whose names end so."""

DRAWN = ["ode45", "dop853", "crank_nicolson"]  # the noisy curve lies below the smooth one
# two of the curves nearly coincide: the first is a broad light band under the thin second
PAIRS = {
    "ode45 - crank_nicolson": {"color": "#f2b824", "linewidth": 2.4, "marker": "s"},
    "crank_nicolson - dop853": {"color": "#111111", "linewidth": 0.6, "marker": "^"},
    "ode45 - dop853": {"color": "#16876b", "linewidth": 0.6, "marker": "o"},
}
PAIR_MARK_SIZES = {"s": 8, "^": 4.5, "o": 4.5}
MARKERS = {"ode45": "o", "crank_nicolson": "s", "dop853": "^", "taylor": "D"}


def _names(trajectories: Trajectories) -> tuple[list[str], list[str]]:
    """Return the cases and the solvers, each in the order in which they first come."""
    return tuple(list(dict.fromkeys(column)) for column in zip(*trajectories, strict=True))


def _stack(trajectories: Trajectories, curves: Mapping[str, xr.DataArray]) -> xr.Dataset:
    """Return one curve a case, by case, with the labels of its panel."""
    first = {case: data for (case, _), data in reversed(trajectories.items())}
    labelled = [
        curve.to_dataset().assign_attrs(
            {key: first[case].attrs[key] for key in ("omega", "initial")}
        )
        for case, curve in curves.items()
    ]
    return style.join(labelled, list(curves), "case", "case")


def gather_drift(trajectories: Trajectories) -> xr.Dataset:
    """Return |H(tau) - H(0)| by case and solver, and the drift that the paper states."""
    cases, solvers = _names(trajectories)
    solver = xr.Variable("solver", solvers, {"long_name": "solver", "units": "1"})
    curves = {
        case: xr.concat([_drift(trajectories[case, name]) for name in solvers], solver)
        for case in cases
    }
    data = _stack(trajectories, curves)
    claims = [CLAIMS.get(case.rpartition("_")[2], float("nan")) for case in cases]
    data["claim"] = ("case", claims, {"long_name": "drift claimed by the paper", "units": "1"})
    return data


def _drift(trajectory: xr.Dataset) -> xr.DataArray:
    energy = trajectory["energy"]
    drift = abs(energy - energy.isel(tau=0, drop=True)).rename("drift")
    return drift.assign_attrs(long_name="drift of the energy |H(tau) - H(0)|", units="1")


@style.styled
def draw_drift(data: xr.Dataset) -> Figure:
    """Draw one panel a case, one line a solver, and the paper's statement as a dashed line."""
    return panels.draw_cases(data, _draw_drift, r"$|H(\tau) - H(0)|$")


def _draw_drift(axes: Axes, case: xr.Dataset) -> None:
    for solver in sorted(case["solver"].values, key=DRAWN.index):
        curve = panels.positive(case["drift"].sel(solver=solver))
        look = {"color": style.COLOURS[solver], "label": style.SOLVER_NAMES[solver]}
        axes.plot(curve["tau"], curve, **look)
    axes.axhline(float(case["claim"]), color="0.45", dashes=(4, 2), lw=1, label="paper's claim")
    axes.set_xlim(0, float(case["tau"].max()))


def gather_agreement(trajectories: Trajectories) -> xr.Dataset:
    """Return by case and pair of solvers how far their norms differ, and when that is visible."""
    cases, _ = _names(trajectories)
    pair = xr.Variable("pair", list(PAIRS), {"long_name": "pair of solvers", "units": "1"})
    curves = {}
    for case in cases:
        pairs = ([trajectories[case, solver] for solver in name.split(" - ")] for name in PAIRS)
        curves[case] = xr.concat([difference(*both) for both in pairs], pair)
    data = _stack(trajectories, curves)
    data["divergence_time"] = divergence_time(data["difference"])
    data["visible"] = ((), VISIBLE, {"long_name": "visible difference", "units": "1"})
    return data


@style.styled
def draw_agreement(data: xr.Dataset) -> Figure:
    """Draw one panel a case, one line a pair, a mark where the pair's curves visibly differ."""
    return panels.draw_cases(data, _draw_agreement, "relative difference")


def _draw_agreement(axes: Axes, case: xr.Dataset) -> None:
    visible = float(case["visible"])
    for pair in case["pair"].values:
        curve = panels.positive(case["difference"].sel(pair=pair))
        label = " / ".join(style.SOLVER_NAMES[solver] for solver in pair.split(" - "))
        look = PAIRS[pair]
        axes.plot(curve["tau"], curve, label=label, markevery=[], **look)
        time = float(case["divergence_time"].sel(pair=pair))
        size = PAIR_MARK_SIZES[look["marker"]]
        axes.plot(time, visible, **look, markersize=size, markeredgecolor="white", zorder=3)
    axes.axhline(visible, color="0.45", dashes=(4, 2), lw=1, label=f"{visible:.0%} (visible)")
    axes.set_xlim(0, float(case["tau"].max()))


def gather_trust(trajectories: Trajectories, references: dict[str, xr.Dataset]) -> xr.Dataset:
    """Return by case and solver how far the norms are from the reference, and when they leave."""
    return trust(trajectories, references)


@style.styled
def draw_trust(data: xr.Dataset) -> Figure:
    """Draw one panel a case, one line a solver, a mark where its curve is visibly another."""
    return panels.draw_cases(data, _draw_trust, "error relative to full scale")


def _draw_trust(axes: Axes, case: xr.Dataset) -> None:
    visible = float(case["size"].sel(level="visible"))
    for solver in case["solver"].values:
        curve = panels.positive(case["difference"].sel(solver=solver))
        look = {"color": style.COLOURS[solver], "marker": MARKERS[solver]}
        label = style.SOLVER_NAMES[solver]
        axes.plot(curve["tau"], curve, label=label, markevery=[], markersize=4, **look)
        lost = float(case["horizon"].sel(solver=solver, level="visible"))
        axes.plot(lost, visible, **look, markeredgecolor="white", zorder=3)
    axes.axhline(visible, color="0.45", dashes=(4, 2), lw=1, label=f"{visible:.0%} (visible)")
    axes.set_xlim(0, float(case["tau"].max()))
    axes.set_ylim(1e-17, 3.0)
