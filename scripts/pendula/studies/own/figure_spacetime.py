"""A case of one's own: the moduli |A_n| and |B_n| over sites and time."""

import xarray as xr
from matplotlib.figure import Figure

from pendula.drawing import style
from pendula.studies.paper.figures_spacetime import draw_row, over_time

from .figure_names import name_data, name_parameters


def gather(run: xr.Dataset) -> xr.Dataset:
    """Return the moduli of a trajectory over the times of its snapshots."""
    if "modulus" not in run:
        raise ValueError("the run keeps no moduli: give its case a snapshot_step")
    return over_time(run)


@style.styled
def draw(data: xr.Dataset) -> Figure:
    """Draw |A_n| left and |B_n| right, on one scale of colours."""
    figure = style.new_figure(style.DOUBLE, 2.5)
    panels = figure.subplots(1, 2, sharex=True, sharey=True)
    draw_row(figure, panels, data, [name_parameters(data.attrs), name_data(data.attrs)])
    for axes in panels:
        axes.set_xlabel(r"$\tau$")
    panels[0].set_ylabel("site $n$")
    return figure
