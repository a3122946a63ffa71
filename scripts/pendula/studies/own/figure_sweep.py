"""A sweep of one's own: the norms over a window of time against the half-width, as in Figs 5-6."""

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from pendula.drawing import style
from pendula.studies.paper.figures_sweeps import draw_panel, join_panels, legend

from .figure_names import name_data_and_ends, name_parameters

NORMS = ("linf", "l2")
FEW = 8
"""Half-widths that all find room below a panel."""


def gather(
    sweep: xr.Dataset, max_window: str | None = None, mean_window: str | None = None
) -> xr.Dataset:
    """Return the pair's maximum over one window and its mean over another, or the first."""
    first = str(sweep["window"].values[0])
    panels = join_panels({"sweep": sweep}, max_window or first, mean_window or first, NORMS)
    return panels.assign_attrs(sweep.attrs)


@style.styled
def draw(data: xr.Dataset) -> Figure:
    """Draw l-infinity left, blue squares, and l2 right, red dots; means are hollow."""
    figure = style.new_figure(style.DOUBLE, 2.7)
    panels = figure.subplots(1, 2, sharex=True)
    for axes, name in zip(panels, NORMS, strict=True):
        draw_panel(axes, data.isel(panel=0).drop_vars([n for n in NORMS if n != name]))
    _mark_widths(panels[0], data["half_width"].values)
    panels[0].set_title(name_parameters(data.attrs), loc="left")
    panels[1].set_title(name_data_and_ends(data.attrs), loc="left")
    by_panel = sorted(legend(data), key=lambda entry: entry.get_color() == style.COLOURS["l2"])
    figure.legend(handles=by_panel, loc="outside upper center", ncols=4, columnspacing=1.2)
    return figure


def _mark_widths(axes: Axes, widths: np.ndarray) -> None:
    """Mark the half-widths themselves where they are few; a logarithm has no place for zero."""
    if widths.min() == 0:
        axes.set_xscale("linear")
    if len(widths) <= FEW or widths.min() == 0:
        axes.set_xticks(widths[:: -(-len(widths) // FEW)])
