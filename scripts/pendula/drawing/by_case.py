"""What the comparisons of solvers share: trajectories side by side, and one panel for each case."""

from collections.abc import Callable, Mapping

import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from . import style

Trajectories = Mapping[tuple[str, str], xr.Dataset]
"""Trajectories by (case, solver); the cases of one figure follow each other, small then large."""


def names(trajectories: Trajectories) -> tuple[list[str], list[str]]:
    """Return the cases and the solvers, each in the order in which they first come."""
    return tuple(list(dict.fromkeys(column)) for column in zip(*trajectories, strict=True))


def stack(trajectories: Trajectories, curves: Mapping[str, xr.DataArray]) -> xr.Dataset:
    """Return one curve a case, by case, with what its panel is labelled with."""
    first = {case: data for (case, _), data in reversed(trajectories.items())}
    labelled = [
        curve.to_dataset().assign_attrs(
            {key: first[case].attrs[key] for key in ("omega", "initial")}
        )
        for case, curve in curves.items()
    ]
    return style.join(labelled, list(curves), "case", "case")


def draw(data: xr.Dataset, draw_panel: Callable[[Axes, xr.Dataset], None], label: str) -> Figure:
    """Return a figure of one panel a case, filled by `draw_panel`, with one legend above."""
    figure = style.new_figure(style.DOUBLE, 4.0)
    drawn = panels(figure, data)
    for axes, case in zip(drawn, data["case"].values, strict=True):
        draw_panel(axes, data.sel(case=case))
    label_left(drawn, label)
    style.name_legend(figure, drawn[0])
    return figure


def panels(figure: Figure, data: xr.Dataset) -> list[Axes]:
    """Return one panel for each case: a column for each figure of the paper, small data above."""
    count = data.sizes["case"]
    grid = figure.subplots(min(count, 2), -(-count // 2), sharex=True, sharey=True, squeeze=False)
    for axes in grid.T.flat[count:]:
        axes.set_visible(False)
    for axes, case in zip(grid.T.flat, data["case"].values, strict=False):
        axes.set_title(style.name_case(data.sel(case=case)), loc="left")
        axes.set_yscale("log")
    for axes in grid[-1]:
        axes.set_xlabel(r"$\tau$")
    return list(grid.T.flat[:count])


def label_left(panels: list[Axes], label: str) -> None:
    """Label the vertical axes of the leftmost panels."""
    for axes in panels:
        if axes.get_subplotspec().is_first_col():
            axes.set_ylabel(label)


def positive(curve: xr.DataArray) -> xr.DataArray:
    """Return the part of a curve that a logarithmic axis can show."""
    return curve.where(curve > 0).dropna("tau")
