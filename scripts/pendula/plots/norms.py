"""Figures 2-4: the norms of A and B against time, in the paper's arrangement."""

import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from . import style

NORMS = {"linf": r"$\ell^\infty$ norm", "l2": r"$\ell^2$ norm"}


def gather(small: xr.Dataset, large: xr.Dataset) -> xr.Dataset:
    """Return the norms of two trajectories, small and large data, as one dataset."""
    cases = [case[["linf", "l2"]] for case in (small, large)]
    return style.join(cases, ["small", "large"], "amplitude", "size of the initial data")


@style.styled
def draw(data: xr.Dataset) -> Figure:
    """Draw l-infinity left and l2 right, small data above and large below, A red and B blue."""
    figure = style.new_figure(style.DOUBLE, 4.0)
    panels = figure.subplots(2, 2, sharex=True)
    for row, size in zip(panels, data["amplitude"].values, strict=True):
        case = data.sel(amplitude=size)
        for axes, name in zip(row, NORMS, strict=True):
            _draw_panel(axes, case, name)
    for axes in panels[-1]:
        axes.set_xlabel(r"$\tau$")
    style.name_legend(figure, panels[0, 0])
    figure.align_ylabels()
    return figure


def _draw_panel(axes: Axes, case: xr.Dataset, name: str) -> None:
    for component in case["component"].values:
        curve = case[name].sel(component=component).dropna("tau")
        colour = style.COLOURS[component]
        axes.plot(curve["tau"], curve, color=colour, label=f"${component}$", alpha=0.9)
    axes.set_xlim(0, float(case["tau"].max()))
    axes.set_ylim(bottom=0)
    axes.set_ylabel(NORMS[name])
    axes.set_title(style.name_case(case), loc="left")
