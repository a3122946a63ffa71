"""Figures 2-4: the norms of A and B against time, in the paper's arrangement."""

from typing import NamedTuple

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from pendula.drawing import style
from pendula.measures.divergence import LEVELS, at_times, difference, first_above, is_of_same_case

PALE = {"A": "#f0a79f", "B": "#9db2de"}
"""Colours of the true curves, below those that the paper's solver draws."""
NORMS = {"linf": r"$\ell^\infty$ norm", "l2": r"$\ell^2$ norm"}


class Below(NamedTuple):
    """The curves below, as the data and the legend call them, and the mark where they part."""

    prefix: str
    label: str
    mark: str


TRUE = Below("true", "true", "off by 1 % from here on")


def gather(runs: list[xr.Dataset], references: list[xr.Dataset]) -> xr.Dataset:
    """Return the norms of two trajectories, of small and of large data, beside the true ones.

    A trajectory whose parameters are not those of its reference stands alone: there the true norms
    are NaN.
    """
    cases = [_beside(run, true) for run, true in zip(runs, references, strict=True)]
    return style.join(cases, ["small", "large"], "amplitude", "size of the initial data")


def _beside(run: xr.Dataset, reference: xr.Dataset) -> xr.Dataset:
    drawn, true = run[["linf", "l2"]], at_times(reference, run["tau"])
    known = is_of_same_case(run, reference)
    for name in NORMS:
        long_name = f"true {reference[name].attrs['long_name']}, in multiprecision"
        drawn[f"true_{name}"] = true[name].where(known).assign_attrs(long_name=long_name, units="1")
    apart = difference(run, reference) if known else xr.full_like(run["tau"], np.nan)
    drawn["parting"] = first_above(apart, LEVELS["visible"]).assign_attrs(
        long_name="first tau at which a norm is off by 1 % of full scale", units="1"
    )
    return drawn


@style.styled
def draw(data: xr.Dataset) -> Figure:
    """Draw l-infinity left and l2 right, small data above and large below, A red and B blue.

    The true curves lie below in pale colours, and a mark shows from when on they are others.
    """
    figure = style.new_figure(style.DOUBLE, 4.0)
    panels = figure.subplots(2, 2, sharex=True)
    for row, size in zip(panels, data["amplitude"].values, strict=True):
        case = data.sel(amplitude=size)
        for axes, name in zip(row, NORMS, strict=True):
            draw_panel(axes, case, name, TRUE)
            axes.set_title(style.name_case(case), loc="left")
    for axes in panels[-1]:
        axes.set_xlabel(r"$\tau$")
    style.name_legend(figure, panels[0, 0])
    figure.align_ylabels()
    return figure


def draw_panel(axes: Axes, case: xr.Dataset, name: str, below: Below) -> None:
    """Draw one norm of A and B, over those that lie below where the case has them."""
    for component in case["component"].values if f"{below.prefix}_{name}" in case else ():
        true = case[f"{below.prefix}_{name}"].sel(component=component)
        axes.plot(true["tau"], true, color=PALE[component], label=f"{below.label} ${component}$")
    for component in case["component"].values:
        curve = case[name].sel(component=component).dropna("tau")
        colour = style.COLOURS[component]
        axes.plot(curve["tau"], curve, color=colour, label=f"${component}$", alpha=0.9)
    if "parting" in case:
        look = {"marker": "v", "color": "black", "linestyle": "none", "markersize": 4}
        top = axes.get_xaxis_transform()
        axes.plot(case["parting"], 1.0, transform=top, clip_on=False, label=below.mark, **look)
    axes.set_xlim(0, float(case["tau"].max()))
    axes.set_ylim(bottom=0)
    axes.set_ylabel(NORMS[name])
