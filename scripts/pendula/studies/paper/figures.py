"""Figures 2 to 6: norms against time, the chain's motion beside them, norms against half-width."""

import numpy as np
import xarray as xr
from matplotlib.figure import Figure

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
    return style.join(cases, SIZES, "amplitude", "size of the initial data")


def _beside(run: xr.Dataset, reference: xr.Dataset) -> xr.Dataset:
    drawn, true = run[["linf", "l2"]], at_times(reference, run["tau"])
    known = is_of_same_case(run, reference)
    for name in NORMS:
        long_name = f"true {reference[name].attrs['long_name']}, in multiprecision"
        drawn[f"true_{name}"] = true[name].where(known).assign_attrs(long_name=long_name, units="1")
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
    for row, size in zip(grid, data["amplitude"].values, strict=True):
        case = data.sel(amplitude=size)
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
    return style.join(cases, SIZES, "amplitude", "size of the initial data")


@style.styled
def draw_spacetime(data: xr.Dataset) -> Figure:
    """Draw |A_n| left and |B_n| right, small data above and large below, one scale a row."""
    figure = style.new_figure(style.DOUBLE, 4.2)
    grid = figure.subplots(2, 2, sharex=True, sharey=True)
    for row, size in zip(grid, data["amplitude"].values, strict=True):
        case = data.sel(amplitude=size)
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
