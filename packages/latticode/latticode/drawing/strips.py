"""Norms of fields against time: a run, and in strips below it the runs to compare it with.

After two chaotic runs have diverged, their curves are unreadable in one panel. Each run therefore
has its own strip, on the same scales, and a dashed line marks the divergence time.
"""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.gridspec import GridSpec
from matplotlib.lines import Line2D
from matplotlib.ticker import MaxNLocator

from . import style

NORMS = {"linf": r"$\ell^\infty$", "l2": r"$\ell^2$"}
UNDER = {"lw": 2.0, "label": "wide, pale: multiprecision reference"}
"""Look of curves that lie below others: they are wide enough to be visible."""
TALL, LOW = 1.15, 0.66
"""Heights in inches of a single panel and of a strip."""
HEADROOM = 1.06
"""Ratio of the upper end of the y axis to the largest value."""
DIVERGED = {"color": "black", "lw": 0.6, "dashes": (4, 2), "zorder": 3}


class Strip(NamedTuple):
    """One strip of a case: it shows the variables whose names are `prefix` followed by a norm.

    The curves with the prefix `under` are drawn below them. Variables (quantile, ...) are drawn as
    a band between the outer two of three quantiles, with a line at the middle quantile.
    """

    prefix: str
    label: str
    under: str = ""


def draw_cases(cases: Sequence[xr.Dataset], strips: Sequence[Sequence[Strip]]) -> tuple:
    """Return a new figure and the axes (strip, norm) of each case: l-infinity left, l2 right.

    `cases` have norms (component, tau), and may have a `divergence_time`, which is marked.
    """
    heights = [TALL if len(of_case) == 1 else LOW * len(of_case) for of_case in strips]
    figure = style.new_figure(style.WIDTH, sum(heights) + 0.25 * len(heights) + 0.4)
    figure.get_layout_engine().set(h_pad=0.02)
    grid = figure.add_gridspec(len(heights), 1, height_ratios=heights, hspace=0.02)
    drawn = [
        _draw_case(grid[row, 0].subgridspec(len(of_case), 2, hspace=0.01), case, of_case)
        for row, (case, of_case) in enumerate(zip(cases, strips, strict=True))
    ]
    for axes in drawn[-1][-1]:
        axes.set_xlabel(r"$\tau$")
    figure.align_ylabels([axes for axes in figure.axes if axes.get_ylabel()])
    return figure, drawn


def _draw_case(place: GridSpec, case: xr.Dataset, strips: Sequence[Strip]) -> np.ndarray:
    grid = place.subplots(sharex=True, sharey="col", squeeze=False)
    for row, strip in zip(grid, strips, strict=True):
        for axes, name in zip(row, NORMS, strict=True):
            _draw_strip(axes, case, name, strip)
            axes.set_title(strip.label, loc="right")
    named = grid if len(strips) < 3 else grid[1:2]
    for axes, name in zip(named.flat, len(named) * list(NORMS), strict=True):
        axes.set_ylabel(f"{NORMS[name]} norm{style.name_units(case[f'{strips[0].prefix}{name}'])}")
    for axes, name in zip(grid[0], NORMS, strict=True):
        prefixes = {prefix for s in strips for prefix in (s.prefix, s.under or s.prefix)}
        names_shown = [f"{prefix}{name}" for prefix in prefixes]
        top = max(float(case[curves].max()) for curves in names_shown)
        axes.set_ylim(0, HEADROOM * top or 1.0)  # the norms of a chain at rest are zero
        axes.set_xlim(0, float(case[name].dropna("tau", how="all")["tau"].max()))
        axes.yaxis.set_major_locator(MaxNLocator(5 if len(strips) == 1 else 3))
    return grid


def _draw_strip(axes: Axes, case: xr.Dataset, name: str, strip: Strip) -> None:
    if strip.under:
        _draw_curves(axes, case[f"{strip.under}{name}"], pale=True)
    curves = case[f"{strip.prefix}{name}"]
    draw = _draw_bands if "quantile" in curves.dims else _draw_curves
    draw(axes, curves)
    if diverges(case):
        axes.axvline(float(case["divergence_time"]), **DIVERGED)


def _draw_curves(axes: Axes, curves: xr.DataArray, pale: bool = False) -> None:
    for i, component in enumerate(curves["component"].values):
        curve = curves.sel(component=component).dropna("tau")
        look = {"label": f"${style.symbol(component)}$", "alpha": 0.9} | (UNDER if pale else {})
        axes.plot(curve["tau"], curve, color=(pale_of if pale else style.colour_of)(i), **look)


def _draw_bands(axes: Axes, bands: xr.DataArray) -> None:
    for i, component in enumerate(bands["component"].values):
        low, middle, high = bands.sel(component=component).dropna("tau")
        axes.fill_between(middle["tau"], low, high, color=pale_of(i), lw=0, alpha=0.6)
        axes.plot(middle["tau"], middle, color=style.colour_of(i))


def pale_of(field: int) -> str:
    """Return the pale colour of a field, for bands and for curves below others."""
    return style.PALE.get(style.colour_of(field), "0.8")


def diverges(case: xr.Dataset) -> bool:
    """Return whether the case has a finite divergence time."""
    return "divergence_time" in case and bool(np.isfinite(case["divergence_time"]))


def name_legend(
    figure: Figure, components: Sequence[str], mark: str = "", under: bool = False
) -> None:
    """Put one legend above all panels: the components, the reference, and the dashed line.

    The reference is listed if `under` is true; the dashed line if its label `mark` is not empty.
    """
    fields = range(len(components))
    lines = [Line2D([], [], color=style.colour_of(i), lw=1.6) for i in fields]
    labels = [f"${style.symbol(component)}$" for component in components]
    if under:
        lines.append(tuple(Line2D([], [], color=pale_of(i), lw=UNDER["lw"]) for i in fields))
        labels.append(UNDER["label"])
    if mark:
        lines.append(Line2D([], [], **DIVERGED | {"lw": 1.0}))
        labels.append(mark)
    size = style.size_of(*labels)
    columns = style.count_columns(figure, labels, len(labels), size)
    more_rows = -(-len(labels) // columns) - 1
    figure.set_figheight(figure.get_figheight() + more_rows * 1.6 * size / 72)
    style.legend_above(figure, lines, labels, ncols=columns, fontsize=size)
