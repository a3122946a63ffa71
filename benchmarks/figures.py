"""The figures of speed against error, one for each kind of motion."""

import numpy as np
import xarray as xr
from latticode.datasets.registry import SOLVER_NAMES
from latticode.drawing import style
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from pendula.drawing import name_case

ACCURACY = ["accuracy", "seconds", "error", "title", "horizon", "target", "omega", "initial"]
RATIOS = ["ratio", "ratio_least", "ratio_most"]
PEERS = {"color": "0.7", "lw": 0.6, "marker": ".", "markersize": 2, "zorder": 1}
ROWS = [
    {"marker": "o", "color": "black", "markersize": 3.5},
    {"marker": "s", "color": "black", "markersize": 3.5, "markerfacecolor": "white"},
]
"""Marks of the cases of a regime in the rows of the peers."""
ROW = 0.155
"""The height of a row in inches."""


def gather_work_precision(measured: xr.Dataset, regime: str) -> xr.Dataset:
    """Return the times and errors in the cases of one regime, and the ratios of peers if any."""
    chosen = measured.isel(case=measured["regime"].values == regime)
    compared = RATIOS if "peer" in measured.dims else []
    return chosen[[*ACCURACY, *compared]].assign_attrs(regime=regime)


@style.styled
def draw_work_precision(data: xr.Dataset) -> Figure:
    """Draw time against error at the top, on logarithmic axes: the lower left corner is best.

    Below, each peer has a row with the ratios of its time to our fastest solver's, one per case.
    """
    heights = [2.3, ROW * (data.sizes["peer"] + 1)] if "peer" in data.dims else [2.3]
    figure = style.new_figure(style.WIDTH, sum(heights) + 0.6 * len(heights))
    grid = figure.add_gridspec(len(heights), 1, height_ratios=heights)
    above = grid[0].subgridspec(1, data.sizes["case"])
    panels = above.subplots(sharex=True, sharey=True, squeeze=False)[0]
    for i, axes in enumerate(panels):
        _draw_case(axes, data.isel(case=i))
    panels[0].set_ylabel("time of a run (ms)")
    if len(heights) > 1:
        _draw_peers(figure.add_subplot(grid[1]), data)
    handles, labels = panels[0].get_legend_handles_labels()
    figure.legend(handles, labels, loc="outside upper center", ncols=3)
    return figure


def _draw_case(axes: Axes, case: xr.Dataset) -> None:
    named = "solvers of other people"
    for name in case["contestant"].values:
        curve = case.sel(contestant=name)
        if curve["error"].isnull().all():
            continue  # too slow for a single point, or its points were not stored
        look = PEERS | {"label": named}
        if name in SOLVER_NAMES:
            look = _look(name) | {"lw": 1.2, "zorder": 2}
        else:
            named = None  # the legend has one entry for all peers
        axes.plot(curve["error"], 1e3 * curve["seconds"], **look)
    look = {"color": "0.45", "lw": 0.8, "dashes": (4, 2), "zorder": 0}
    axes.axvline(float(case["target"]), label="compared within this error", **look)
    axes.set_xscale("log")
    axes.set_yscale("log")
    axes.set_xlim(right=1.0)
    axes.set_xlabel(rf"error of an amplitude at $\tau = {float(case['horizon']):g}$")
    axes.set_title(name_case(case), loc="left")


def _draw_peers(axes: Axes, data: xr.Dataset) -> None:
    """Draw the ratios, with the fastest peer at the bottom; peers without a ratio have no mark."""
    data = data.isel(peer=data["ratio"].mean("case").fillna(np.inf).argsort().values)
    rows = np.arange(data.sizes["peer"])
    for i, look in zip(range(data.sizes["case"]), ROWS, strict=False):
        case = data.isel(case=i)
        ratio, least, most = (case[name].values for name in RATIOS)
        spread = np.nan_to_num([ratio - least, most - ratio])
        look = look | {"linestyle": "none", "elinewidth": 0.8, "label": name_case(case)}
        axes.errorbar(ratio, rows + 0.15 - 0.3 * i, xerr=spread, **look)
    axes.axvline(1.0, color="0.45", lw=0.8)
    titles = dict(zip(data["contestant"].values, data["title"].values, strict=True))
    missed = data["ratio"].isnull().all("case").values
    axes.set_yticks(
        rows,
        [
            f"{titles[peer]} (never so close)" if gone else str(titles[peer])
            for peer, gone in zip(data["peer"].values, missed, strict=True)
        ],
    )
    axes.set_ylim(-0.7, rows[-1] + 0.7)
    axes.grid(axis="y", color="0.9", lw=0.6)
    axes.set_axisbelow(True)
    axes.set_xscale("log")
    within = f"within an error of $10^{{{np.log10(float(data['target'][0])):.0f}}}$"
    axes.set_xlabel(f"time over that of the fastest solver here, {within}", loc="right")
    axes.legend(loc="lower right")


def _look(solver: str) -> dict:
    look = {"color": style.COLOURS[solver], "marker": style.MARKERS[solver], "markersize": 3.5}
    return look | {"label": SOLVER_NAMES[solver]}
