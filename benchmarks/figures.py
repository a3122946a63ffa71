"""The figures of the measurements: speed against error, and how the cost of a run grows."""

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from pendula.datasets.registry import SOLVER_NAMES
from pendula.drawing import style

MARKERS = "osD^vP*X<>hdp8"


def gather_work_precision(measured: xr.Dataset, regime: str) -> xr.Dataset:
    """Return the times and errors of the cases of one regime."""
    chosen = measured.isel(case=measured["regime"].values == regime)
    names = ["accuracy", "seconds", "least", "most", "error", "title", "horizon", "target"]
    return chosen[names].assign_attrs(regime=regime)


@style.styled
def draw_work_precision(data: xr.Dataset) -> Figure:
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
    peers = [name for name in case["contestant"].values if name not in SOLVER_NAMES]
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
            look |= {"label": SOLVER_NAMES[name], "markersize": 5}
        axes.plot(curve["error"], 1e3 * curve["seconds"], **look)
    axes.axvline(float(case["target"]), color="0.6", lw=0.6, dashes=(4, 2), zorder=0)
    axes.set_xscale("log")
    axes.set_yscale("log")
    axes.set_xlim(right=1.0)
    axes.set_xlabel(rf"error of an amplitude at $\tau = {float(case['horizon']):g}$")
    axes.set_title(str(case["case"].values))


def gather_cost(cost: xr.Dataset) -> xr.Dataset:
    """Return what is drawn: the measurements, sites carried a second, and the machine's limits."""
    measured = ["seconds", "long_seconds"]
    carried = cost["steps"] / cost["seconds"]
    arithmetic = cost["arithmetic"] / cost["operations"]
    memory = cost["bandwidth"] / cost["traffic"]
    return cost[measured].assign(
        carried=carried.assign_attrs(long_name="sites times steps a second", units="s-1"),
        arithmetic_limit=arithmetic.assign_attrs(
            long_name="sites times steps that the arithmetic allows", units="s-1"
        ),
        memory_limit=memory.assign_attrs(
            long_name="sites times steps that the memory allows", units="s-1"
        ),
    )


@style.styled
def draw_cost(data: xr.Dataset) -> Figure:
    """Draw the cost over sites and over time, and the throughput with its limits."""
    figure = style.new_figure(style.DOUBLE, 2.4)
    sites, time, throughput = figure.subplots(1, 3)
    _draw_cost_along(sites, data["seconds"], "sites")
    _draw_cost_along(time, data["long_seconds"], "end_time")
    sites.set_xlabel("number of sites $N$")
    time.set_xlabel(r"end time $\tau$")
    sites.legend()
    _draw_throughput(throughput, data)
    return figure


def _draw_cost_along(axes: Axes, seconds: xr.DataArray, dim: str) -> None:
    for solver in seconds["solver"].values:
        look = {"color": style.COLOURS[solver], "label": SOLVER_NAMES[solver]}
        axes.plot(seconds[dim], 1e6 * seconds.sel(solver=solver), marker=".", **look)
    axes.set_xscale("log")
    axes.set_ylim(bottom=0)
    axes.set_ylabel(r"time per site and unit of $\tau$ (µs)")


def _draw_throughput(axes: Axes, data: xr.Dataset) -> None:
    look = {"color": style.COLOURS["dop853"], "label": SOLVER_NAMES["dop853"]}
    carried = data["carried"].sel(solver="dop853")
    axes.plot(carried["sites"], carried, marker=".", **look)
    limits = {"arithmetic_limit": ("arithmetic", (4, 2)), "memory_limit": ("memory", (1, 1))}
    for name, (label, dashes) in limits.items():
        # half of an even chain is integrated, so that each site computed counts for two
        axes.axhline(2 * float(data[name]), color="0.4", lw=0.8, dashes=dashes, label=label)
    axes.set_xscale("log")
    axes.set_yscale("log")
    axes.set_xlabel("number of sites $N$")
    axes.set_ylabel(r"sites $\times$ steps per second")
    axes.legend(loc="lower right")
