"""A case of one's own: the norms of A and B against time, as a row of Figs 2 to 4."""

import numpy as np
import xarray as xr
from matplotlib.figure import Figure

from ..trust import LEVELS, at_times, difference, first_above
from . import style
from .norms import NORMS, Below, draw_panel
from .own_names import name_data, name_parameters

SECOND = Below("second", "second run,", f"the runs part by {LEVELS['visible']:.0%}")


def gather(run: xr.Dataset, second: xr.Dataset | None = None) -> xr.Dataset:
    """Return the norms of a trajectory, beside those of a second run of the same case."""
    drawn = run[["linf", "l2"]]
    if second is None:
        return drawn
    other = at_times(second, run["tau"])
    for name in NORMS:
        long_name = f"{run[name].attrs['long_name']}, by {second.attrs['solver']}"
        drawn[f"second_{name}"] = other[name].assign_attrs(long_name=long_name, units="1")
    drawn["parting"] = first_above(difference(run, second), LEVELS["visible"]).assign_attrs(
        long_name="first tau at which the runs differ by 1 % of full scale", units="1"
    )
    return drawn


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
    panels[1].set_title(name_data(data.attrs), loc="left")
    style.name_legend(figure, panels[0])
    return figure
