"""Beside figures 2-4: the moduli |A_n| and |B_n| over sites and time."""

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.colors import PowerNorm
from matplotlib.figure import Figure
from matplotlib.image import AxesImage

from pendula.drawing import style


def gather(small: xr.Dataset, large: xr.Dataset) -> xr.Dataset:
    """Return the moduli of two trajectories, small and large data, as one dataset."""
    cases = [over_time(case) for case in (small, large)]
    return style.join(cases, ["small", "large"], "amplitude", "size of the initial data")


def over_time(run: xr.Dataset) -> xr.Dataset:
    """Return the moduli of a trajectory over the times of its snapshots."""
    moduli = run[["modulus", "snapshot_tau"]].set_coords("snapshot_tau")
    return moduli.swap_dims(snapshot="snapshot_tau")


@style.styled
def draw(data: xr.Dataset) -> Figure:
    """Draw |A_n| left and |B_n| right, small data above and large below, one scale a row."""
    figure = style.new_figure(style.DOUBLE, 4.2)
    panels = figure.subplots(2, 2, sharex=True, sharey=True)
    for row, size in zip(panels, data["amplitude"].values, strict=True):
        case = data.sel(amplitude=size)
        draw_row(figure, row, case, 2 * [style.name_case(case)])
    for axes in panels[-1]:
        axes.set_xlabel(r"$\tau$")
    for axes in panels[:, 0]:
        axes.set_ylabel("site $n$")
    return figure


def draw_row(figure: Figure, row: np.ndarray, case: xr.Dataset, names: list[str]) -> None:
    """Draw |A_n| and |B_n| of one case, each under its name, on one scale of colours."""
    peak = float(case["modulus"].max())
    for axes, component, name in zip(row, case["component"].values, names, strict=True):
        image = _draw_panel(axes, case["modulus"].sel(component=component), peak)
        axes.set_title(f"$|{component}_n|$,  {name}", loc="left")
    bar = figure.colorbar(image, ax=row.tolist(), pad=0.015, aspect=18)
    bar.set_label("modulus (square-root scale)")


def _draw_panel(axes: Axes, modulus: xr.DataArray, peak: float) -> AxesImage:
    modulus = modulus.transpose("site", "snapshot_tau")
    return axes.imshow(
        modulus,
        extent=(*_edges(modulus["snapshot_tau"].values), *_edges(modulus["site"].values)),
        origin="lower",
        aspect="auto",
        interpolation="nearest",
        cmap="inferno",
        norm=PowerNorm(0.5, vmin=0, vmax=peak or 1.0),  # else one bright site blackens the rest
    )


def _edges(centres: np.ndarray) -> tuple[float, float]:
    half = (centres[1] - centres[0]) / 2 if len(centres) > 1 else 0.5
    return centres[0] - half, centres[-1] + half
