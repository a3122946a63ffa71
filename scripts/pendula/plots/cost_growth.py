"""How the cost of a run grows with the chain and with time, and how near it is to the limits."""

import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from pendula.drawing import style


def gather(growth: xr.Dataset) -> xr.Dataset:
    """Return what is drawn: the measurements, sites carried a second, and the machine's limits."""
    measured = ["seconds", "long_seconds"]
    carried = growth["steps"] / growth["seconds"]
    arithmetic = growth["arithmetic"] / growth["operations"]
    memory = growth["bandwidth"] / growth["traffic"]
    return growth[measured].assign(
        carried=carried.assign_attrs(long_name="sites times steps a second", units="s-1"),
        arithmetic_limit=arithmetic.assign_attrs(
            long_name="sites times steps that the arithmetic allows", units="s-1"
        ),
        memory_limit=memory.assign_attrs(
            long_name="sites times steps that the memory allows", units="s-1"
        ),
    )


@style.styled
def draw(data: xr.Dataset) -> Figure:
    """Draw the cost over sites and over time, and the throughput with its limits."""
    figure = style.new_figure(style.DOUBLE, 2.4)
    sites, time, throughput = figure.subplots(1, 3)
    _draw_cost(sites, data["seconds"], "sites")
    _draw_cost(time, data["long_seconds"], "end_time")
    sites.set_xlabel("number of sites $N$")
    time.set_xlabel(r"end time $\tau$")
    sites.legend()
    _draw_throughput(throughput, data)
    return figure


def _draw_cost(axes: Axes, seconds: xr.DataArray, dim: str) -> None:
    for solver in seconds["solver"].values:
        look = {"color": style.COLOURS[solver], "label": style.SOLVER_NAMES[solver]}
        axes.plot(seconds[dim], 1e6 * seconds.sel(solver=solver), marker=".", **look)
    axes.set_xscale("log")
    axes.set_ylim(bottom=0)
    axes.set_ylabel(r"time per site and unit of $\tau$ (µs)")


def _draw_throughput(axes: Axes, data: xr.Dataset) -> None:
    look = {"color": style.COLOURS["dop853"], "label": style.SOLVER_NAMES["dop853"]}
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
