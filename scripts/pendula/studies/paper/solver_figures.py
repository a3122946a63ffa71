"""The solvers side by side: the drift of the energy, their agreement, their error."""

import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from pendula.drawing import panels, style

LABELS = ["omega", "initial"]
DRAWN = ["ode45", "dop853", "crank_nicolson"]  # the noisy curve lies below the smooth one
# two of the curves nearly coincide: the first is a broad light band under the thin second
PAIRS = {
    "ode45 - crank_nicolson": {"color": "#f2b824", "linewidth": 2.4, "marker": "s"},
    "crank_nicolson - dop853": {"color": "#111111", "linewidth": 0.6, "marker": "^"},
    "ode45 - dop853": {"color": "#16876b", "linewidth": 0.6, "marker": "o"},
}
PAIR_MARK_SIZES = {"s": 8, "^": 4.5, "o": 4.5}
MARKERS = {"ode45": "o", "crank_nicolson": "s", "dop853": "^", "taylor": "D"}


def gather_drift(solvers: xr.Dataset) -> xr.Dataset:
    """Return |H(tau) - H(0)| by case and solver, and the drift that the paper states."""
    return solvers[["drift", "stated_drift", *LABELS]].drop_attrs(deep=False)


@style.styled
def draw_drift(data: xr.Dataset) -> Figure:
    """Draw one panel a case, one line a solver, and the paper's statement as a dashed line."""
    return panels.draw_cases(data, _draw_drift, r"$|H(\tau) - H(0)|$")


def _draw_drift(axes: Axes, case: xr.Dataset) -> None:
    for solver in sorted(case["solver"].values, key=DRAWN.index):
        curve = panels.positive(case["drift"].sel(solver=solver))
        look = {"color": style.COLOURS[solver], "label": style.SOLVER_NAMES[solver]}
        axes.plot(curve["tau"], curve, **look)
    axes.axhline(
        float(case["stated_drift"]), color="0.45", dashes=(4, 2), lw=1, label="paper's claim"
    )
    axes.set_xlim(0, float(case["tau"].max()))


def gather_agreement(solvers: xr.Dataset) -> xr.Dataset:
    """Return by case and pair of solvers how far their norms differ, and when that is visible."""
    names = ["difference", "divergence_time", "visible", *LABELS]
    return solvers[names].drop_attrs(deep=False)


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


def gather_trust(trust: xr.Dataset) -> xr.Dataset:
    """Return by case and solver how far the norms are from the reference, and when they leave."""
    return trust[["difference", "horizon", "size", *LABELS]].drop_attrs(deep=False)


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
