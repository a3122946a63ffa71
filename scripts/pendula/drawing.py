"""Titles of the paper's cases in figures, and a figure with a panel for each case."""

from collections.abc import Callable

import xarray as xr
from latticode.drawing import runs, style
from matplotlib.axes import Axes
from matplotlib.figure import Figure

CASE_ATTRIBUTES = ("omega", "initial")
"""Attributes of a dataset that the title of a panel needs."""


def draw_cases(
    data: xr.Dataset, draw_panel: Callable[[Axes, xr.Dataset], None], label: str
) -> Figure:
    """Return a figure with a panel for each case, drawn by `draw_panel`, and one legend above.

    A column is a figure of the paper, with the small initial data in the upper row.
    """
    figure, count = style.new_figure(style.WIDTH, 3.2), data.sizes["case"]
    grid = figure.subplots(min(count, 2), -(-count // 2), sharex=True, sharey=True, squeeze=False)
    for axes in grid.T.flat[count:]:
        axes.set_visible(False)
    drawn = list(grid.T.flat[:count])
    for axes, name in zip(drawn, data["case"].values, strict=True):
        case = data.sel(case=name)
        axes.set_title(name_case(case), loc="left", fontsize=style.WITH_INDICES)
        axes.set_yscale("log")
        axes.tick_params(axis="y", labelsize=style.WITH_INDICES)
        draw_panel(axes, case)
        axes.set_xlim(0, float(data["tau"].max()))
    for axes in grid[-1]:
        axes.set_xlabel(r"$\tau$")
    figure.supylabel(label, fontsize=style.WITH_INDICES)
    style.name_legend(figure, *drawn, columns=4)
    return figure


def name_case(case: xr.Dataset) -> str:
    """Return the title of a case's panel: its detuning and its initial data."""
    omega = rf"$\Omega = {float(case['omega']):g}$"
    return f"{omega},  {name_initial(str(case['initial'].values))}"


def name_initial(initial: str) -> str:
    """Return the title's text for initial data, which a dataset holds as "{site: [A, B]}"."""
    return runs.name_initial(initial, ("A", "B"))
