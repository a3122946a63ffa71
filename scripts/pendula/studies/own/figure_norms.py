"""A case of one's own: the norms of A and B against time, as a row of Figs 2 to 4."""

import numpy as np
import xarray as xr
from matplotlib.figure import Figure

from pendula.drawing import style
from pendula.measures.divergence import LEVELS
from pendula.studies.paper.figures_norms import NORMS, Below, draw_panel

from .figure_names import name_data_and_ends, name_parameters

SECOND = Below("second", "second run,", f"the runs part by {100 * LEVELS['visible']:g} %")


def gather(run: xr.Dataset, checks: xr.Dataset | None = None) -> xr.Dataset:
    """Return the norms of a trajectory, beside the second run that its checks hold."""
    drawn = run[["linf", "l2"]]
    if checks is None:
        return drawn
    return drawn.assign(
        {name: checks[name] for name in (*map("second_{}".format, NORMS), "parting")}
    )


@style.styled
def draw(data: xr.Dataset) -> Figure:
    """Draw l-infinity left and l2 right, A red and B blue; a second run only where it parts."""
    figure = style.new_figure(style.DOUBLE, 2.5)
    if "parting" not in data or not np.isfinite(data["parting"]):
        data = data[list(NORMS)]
    panels = figure.subplots(1, 2, sharex=True)
    for axes, name in zip(panels, NORMS, strict=True):
        draw_panel(axes, data, name, SECOND)
        axes.set_xlabel(r"$\tau$")
    panels[0].set_title(name_parameters(data.attrs), loc="left")
    panels[1].set_title(name_data_and_ends(data.attrs), loc="left")
    style.name_legend(figure, panels[0])
    return figure
