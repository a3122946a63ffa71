"""Figures 2 to 6, the chain's motion beside them, and the solvers side by side."""

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from pendula.datasets.registry import SOLVER_NAMES
from pendula.drawing import panels, style
from pendula.drawing.panels import NORMS, Below
from pendula.measures.difference import at_times, difference, divergence_time, is_of_same_case

REFERENCE = Below("true", "true", "off by 1 % from here on")
SIZES = ["small", "large"]


def gather_norms(runs: list[xr.Dataset], references: list[xr.Dataset]) -> xr.Dataset:
    """Return the norms of two trajectories, of small and of large data, beside the references.

    A trajectory whose parameters are not those of its reference stands alone: there the norms of
    the reference are NaN.
    """
    cases = [_beside(run, true) for run, true in zip(runs, references, strict=True)]
    return style.join(cases, SIZES, "initial_size")


def _beside(run: xr.Dataset, reference: xr.Dataset) -> xr.Dataset:
    drawn, true = run[["linf", "l2"]], at_times(reference, run["tau"])
    known = is_of_same_case(run, reference)
    for name in NORMS:
        long_name = f"true {reference[name].attrs['long_name']}, in multiprecision"
        drawn[f"true_{name}"] = true[name].where(known).assign_attrs(long_name=long_name)
    apart = difference(run, reference) if known else xr.full_like(run["tau"], np.nan)
    drawn["divergence_time"] = divergence_time(apart)
    return drawn


@style.styled
def draw_norms(data: xr.Dataset) -> Figure:
    """Draw l-infinity left and l2 right, small data above and large below, A red and B blue.

    The curves of the reference lie below in pale colours, and a mark shows the divergence time.
    """
    figure = style.new_figure(style.DOUBLE, 4.0)
    grid = figure.subplots(2, 2, sharex=True)
    for row, size in zip(grid, data["initial_size"].values, strict=True):
        case = data.sel(initial_size=size)
        for axes, name in zip(row, NORMS, strict=True):
            panels.draw_norm(axes, case, name, REFERENCE)
            axes.set_title(style.name_case(case), loc="left")
    for axes in grid[-1]:
        axes.set_xlabel(r"$\tau$")
    style.name_legend(figure, grid[0, 0])
    figure.align_ylabels()
    return figure


def gather_spacetime(small: xr.Dataset, large: xr.Dataset) -> xr.Dataset:
    """Return the moduli |A_n| and |B_n| of two trajectories over sites and snapshots."""
    cases = [panels.over_time(case) for case in (small, large)]
    return style.join(cases, SIZES, "initial_size")


@style.styled
def draw_spacetime(data: xr.Dataset) -> Figure:
    """Draw |A_n| left and |B_n| right, small data above and large below, one scale a row."""
    figure = style.new_figure(style.DOUBLE, 4.2)
    grid = figure.subplots(2, 2, sharex=True, sharey=True)
    for row, size in zip(grid, data["initial_size"].values, strict=True):
        case = data.sel(initial_size=size)
        panels.draw_moduli(figure, row, case, 2 * [style.name_case(case)])
    for axes in grid[-1]:
        axes.set_xlabel(r"$\tau$")
    for axes in grid[:, 0]:
        axes.set_ylabel("site $n$")
    return figure


def gather_sweeps(
    left: xr.Dataset,
    right: xr.Dataset,
    text_window: str,
    caption_window: str,
    norms: tuple[str, ...] = ("l2", "linf"),
) -> xr.Dataset:
    """Return the pair's norms of two sweeps: the maximum over one window, the mean over another.

    The paper's text speaks of the maximum, its captions of the average, over windows of their own.
    The windows are named as in the sweeps, such as "[10, 50]"; `norms` are those to be drawn.
    """
    sweeps = {"left": left, "right": right}
    return panels.join_sweeps(sweeps, text_window, caption_window, list(norms))


@style.styled
def draw_sweeps(data: xr.Dataset) -> Figure:
    """Draw both panels: l2 red dots, l-infinity blue squares; the captions' reading is hollow."""
    figure = style.new_figure(style.DOUBLE, 2.7)
    for axes, name in zip(figure.subplots(1, 2), data["panel"].values, strict=True):
        panels.draw_sweep(axes, data.sel(panel=name))
    handles = panels.sweep_legend(data)
    figure.legend(handles=handles, loc="outside upper center", ncols=4, columnspacing=1.2)
    return figure


# --- The solvers side by side ---------------------------------------------------------------------

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
    return solvers[["drift", "stated_drift", *LABELS]]


@style.styled
def draw_drift(data: xr.Dataset) -> Figure:
    """Draw one panel a case, one line a solver, and the paper's statement as a dashed line."""
    return panels.draw_cases(data, _draw_drift, r"$|H(\tau) - H(0)|$")


def _draw_drift(axes: Axes, case: xr.Dataset) -> None:
    for solver in sorted(case["solver"].values, key=DRAWN.index):
        curve = panels.positive(case["drift"].sel(solver=solver))
        look = {"color": style.COLOURS[solver], "label": SOLVER_NAMES[solver]}
        axes.plot(curve["tau"], curve, **look)
    axes.axhline(
        float(case["stated_drift"]), color="0.45", dashes=(4, 2), lw=1, label="paper's claim"
    )


def gather_agreement(solvers: xr.Dataset) -> xr.Dataset:
    """Return by case and pair of solvers how far their norms differ, and when that is visible."""
    return solvers[["difference", "divergence_time", "visible", *LABELS]]


@style.styled
def draw_agreement(data: xr.Dataset) -> Figure:
    """Draw one panel a case, one line a pair, a mark where the pair's curves visibly differ."""
    return panels.draw_cases(data, _draw_agreement, "relative difference")


def _draw_agreement(axes: Axes, case: xr.Dataset) -> None:
    visible = float(case["visible"])
    for pair in case["pair"].values:
        label = " / ".join(SOLVER_NAMES[solver] for solver in pair.split(" - "))
        one, look = case.sel(pair=pair), PAIRS[pair]
        _draw_difference(axes, one["difference"], label=label, **look)
        size = PAIR_MARK_SIZES[look["marker"]]
        _mark(axes, one["divergence_time"], visible, **look, markersize=size)
    _draw_visible(axes, visible)


def _draw_difference(axes: Axes, difference: xr.DataArray, **look) -> None:
    curve = panels.positive(difference)
    axes.plot(curve["tau"], curve, markevery=[], **look)


def _mark(axes: Axes, time: xr.DataArray, visible: float, **look) -> None:
    axes.plot(float(time), visible, **look, markeredgecolor="white", zorder=3)


def _draw_visible(axes: Axes, visible: float) -> None:
    axes.axhline(visible, color="0.45", dashes=(4, 2), lw=1, label=f"{visible:.0%} (visible)")


def gather_trust(trust: xr.Dataset) -> xr.Dataset:
    """Return by case and solver how far the norms are from the reference, and when they leave."""
    return trust[["difference", "horizon", "size", *LABELS]]


@style.styled
def draw_trust(data: xr.Dataset) -> Figure:
    """Draw one panel a case, one line a solver, a mark where its curve is visibly another."""
    return panels.draw_cases(data, _draw_trust, "error relative to full scale")


def _draw_trust(axes: Axes, case: xr.Dataset) -> None:
    visible = float(case["size"].sel(level="visible"))
    for solver in case["solver"].values:
        one = case.sel(solver=solver, level="visible")
        look = {"color": style.COLOURS[solver], "marker": MARKERS[solver]}
        label = SOLVER_NAMES[solver]
        _draw_difference(axes, one["difference"], label=label, markersize=4, **look)
        _mark(axes, one["horizon"], visible, **look)
    _draw_visible(axes, visible)
    axes.set_ylim(1e-17, 3.0)
