"""Speed against error in one regime: a panel a case, a line for each solver and each peer."""

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from pendula.drawing import style

MARKERS = "osD^vP*X<>hdp8"


def gather(measured: xr.Dataset, regime: str) -> xr.Dataset:
    """Return the times and errors of the cases of one regime."""
    chosen = measured.isel(case=measured["regime"].values == regime)
    names = ["accuracy", "seconds", "least", "most", "error", "title", "horizon", "target"]
    return chosen[names].assign_attrs(regime=regime)


@style.styled
def draw(data: xr.Dataset) -> Figure:
    """Draw time over error, both logarithmic: the lower left corner is where one wants to be."""
    figure = style.new_figure(style.DOUBLE, 3.6)
    panels = figure.subplots(1, data.sizes["case"], sharey=True, squeeze=False)[0]
    for i, axes in enumerate(panels):
        _draw_case(axes, data.isel(case=i))
    panels[0].set_ylabel("time of a run (ms)")
    handles, labels = panels[0].get_legend_handles_labels()
    figure.legend(handles, labels, loc="outside right upper")
    return figure


def _draw_case(axes: Axes, case: xr.Dataset) -> None:
    peers = [name for name in case["contestant"].values if name not in style.SOLVER_NAMES]
    greys = np.linspace(0.35, 0.75, max(len(peers), 1))
    for name in case["contestant"].values:
        curve = case.sel(contestant=name)
        if curve["error"].isnull().all():
            continue  # too slow for a single point
        look = {"markersize": 3, "label": str(curve["title"].values)}
        if name in peers:
            i = peers.index(name)
            look |= {
                "color": str(greys[i]),
                "marker": MARKERS[i % len(MARKERS)],
                "lw": 0.6,
                "zorder": 1,
            }
            look |= {"markerfacecolor": "white", "markeredgewidth": 0.6}
        else:
            look |= {"color": style.COLOURS[name], "marker": ".", "lw": 1.2, "zorder": 2}
            look |= {"label": style.SOLVER_NAMES[name], "markersize": 5}
        axes.plot(curve["error"], 1e3 * curve["seconds"], **look)
    axes.axvline(float(case["target"]), color="0.6", lw=0.6, dashes=(4, 2), zorder=0)
    axes.set_xscale("log")
    axes.set_yscale("log")
    axes.set_xlim(right=1.0)
    axes.set_xlabel(rf"error of an amplitude at $\tau = {float(case['horizon']):g}$")
    axes.set_title(str(case["case"].values))
