"""Lemma 1 in numbers: measured against predicted growth rates, and growth at the threshold."""

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from pendula.drawing import style

CHARTS = {
    "long": {"marker": "o", "color": "#f2a15f", "markersize": 3.5},
    "short": {"marker": "x", "color": style.BLUE, "markersize": 3},
}
ERRORS = {
    "exact_flow": ("s", "#16876b", "linear flow of the data"),
    "finite_rate": (".", "0.55", "fastest mode"),
}
PREDICTED = "rate of the fastest mode\n(per unit of $\\tau$)"
RATES = ["measured", "exact_flow", "finite_rate"]


def gather(chart: xr.Dataset, short_chart: xr.Dataset, threshold: xr.Dataset) -> xr.Dataset:
    """Return every measured cell of two charts in one row each, and the growth at the threshold."""
    rows = []
    for name, cells in (("long", chart), ("short", short_chart)):
        row = cells[RATES].stack(cell=("omega", "gamma")).reset_index("cell")
        row["chain"] = ("cell", np.full(row.sizes["cell"], name))
        row["sites"] = ("cell", np.full(row.sizes["cell"], int(cells["sites"])))
        rows.append(row)
    joined = xr.concat(rows, "cell", combine_attrs="drop_conflicts").reset_coords()
    joined["chain"].attrs = {"long_name": "chart to which a cell belongs", "units": "1"}
    joined["sites"].attrs = {"long_name": "number of sites N", "units": "1"}
    names = {"omega": "threshold_omega"}
    growth = threshold[["grown", "threshold", "spreading"]].rename(names)
    return xr.merge([joined, growth], combine_attrs="drop_conflicts")


@style.styled
def draw(data: xr.Dataset) -> Figure:
    """Draw rates against each other, their relative errors, and the growth at the threshold."""
    figure = style.new_figure(style.DOUBLE, 2.9)
    rates, errors, threshold = figure.subplots(1, 3)
    _draw_rates(rates, data)
    _draw_errors(errors, data)
    _draw_threshold(threshold, data)
    return figure


def _draw_rates(axes: Axes, data: xr.Dataset) -> None:
    for name, look in CHARTS.items():
        cells = data.isel(cell=data["chain"].values == name)
        label = f"$N = {int(cells['sites'][0])}$"
        axes.plot(cells["finite_rate"], cells["measured"], linestyle="none", label=label, **look)
    top = float(data["finite_rate"].max())
    axes.plot([0, top], [0, top], color="black", lw=0.8, label="equal")
    axes.set_xlabel(PREDICTED)
    axes.set_ylabel("measured growth rate (per unit of $\\tau$)")
    axes.legend(loc="upper left")


def _draw_errors(axes: Axes, data: xr.Dataset) -> None:
    growing = data.isel(cell=data["finite_rate"].values > 0)
    for name, (marker, colour, label) in ERRORS.items():
        with np.errstate(divide="ignore"):
            error = abs(growing["measured"] / growing[name] - 1)
        shown = error.where(error > 0)
        look = {"marker": marker, "color": colour, "markersize": 2.5}
        axes.plot(growing["finite_rate"], shown, linestyle="none", label=label, **look)
    axes.set_yscale("log")
    axes.set_xlabel(PREDICTED)
    axes.set_ylabel("relative error of the measured rate")
    axes.set_ylim(top=1e6)  # room for the legend
    axes.legend(loc="upper right", title="against the", handletextpad=0.1)


def _draw_threshold(axes: Axes, data: xr.Dataset) -> None:
    wave = data.isel(threshold_omega=0)
    tau = np.array([float(data["tau"].min()), float(data["tau"].max())])
    line = 4 * float(wave["threshold"]) * tau
    axes.plot(tau, line, color="black", lw=0.8, label=r"$4 \gamma \tau$")
    _draw_both(axes, data["tau"], data["grown"], "o", style.RED, "one mode, finite chain")
    for norm, marker, colour in (("l2", "s", "#16876b"), ("linf", "^", style.BLUE)):
        spread = data["spreading"].sel(norm=norm)
        name = {"l2": r"$\ell^2$", "linf": r"$\ell^\infty$"}[norm]
        _draw_both(axes, data["long_tau"], spread, marker, colour, f"{name}, infinite chain")
    axes.set_xscale("log")
    axes.set_yscale("log")
    axes.set_xlabel(r"$\tau$")
    axes.set_ylabel("growth of $A - B$ at the threshold")
    axes.set_ylim(1, 2e4)  # room for the legend
    axes.legend(loc="upper left")


def _draw_both(
    axes: Axes, times: xr.DataArray, values: xr.DataArray, marker: str, colour: str, label: str
) -> None:
    """Draw the first Omega as hollow marks, and the others, which coincide, as dots within."""
    for i, omega in enumerate(values["threshold_omega"].values):
        look = {"color": colour, "marker": marker, "linestyle": "none"}
        if i == 0:
            look |= {"markersize": 5, "markerfacecolor": "white", "label": label}
        else:
            look["markersize"] = 2
        axes.plot(times, values.sel(threshold_omega=omega), **look)
