"""How figures name the paper's cases, and a figure with a panel for each of them."""

from collections.abc import Callable

import xarray as xr
from latticode.drawing import runs, style
from matplotlib.axes import Axes

CASE_ATTRIBUTES = ("omega", "initial")
"""What panels say of a case."""


def draw_cases(data: xr.Dataset, draw_panel: Callable[[Axes, xr.Dataset], None], label: str):
    """Return a figure with a panel for each case, drawn by `draw_panel`, and one legend above.

    Each figure of the paper has a column, with small data above.
    """
    figure, count = style.new_figure(style.WIDTH, 3.2), data.sizes["case"]
    grid = figure.subplots(min(count, 2), -(-count // 2), sharex=True, sharey=True, squeeze=False)
    for axes in grid.T.flat[count:]:
        axes.set_visible(False)
    drawn = list(grid.T.flat[:count])
    for axes, name in zip(drawn, data["case"].values, strict=True):
        case = data.sel(case=name)
        axes.set_title(name_case(case), loc="left")
        axes.set_yscale("log")
        draw_panel(axes, case)
        axes.set_xlim(0, float(data["tau"].max()))
    for axes in grid[-1]:
        axes.set_xlabel(r"$\tau$")
    figure.supylabel(label, fontsize="medium")
    style.name_legend(figure, *drawn, columns=4)
    return figure


def name_case(case: xr.Dataset) -> str:
    """Return the detuning and the initial data of one case as they are written in its panel."""
    omega = rf"$\Omega = {float(case['omega']):g}$"
    return f"{omega},  {name_initial(str(case['initial'].values))}"


def name_initial(initial: str) -> str:
    """Return initial data, as datasets keep them ({site: [A, B]}), as written in a panel."""
    return runs.name_initial(initial, ("A", "B"))
