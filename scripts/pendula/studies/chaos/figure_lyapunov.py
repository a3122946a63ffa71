"""Lyapunov exponents: how they settle, the spectrum of a short chain, and parting times."""

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from pendula.drawing import style

COLOURS = {8.0: "#e0a100", -4.0: style.BLUE, 0.0: style.RED}
"""By detuning, of different lightness."""
WIDTHS = {"small": 0.7, "large": 1.5}
DASHES = {"even": (None, None), "odd": (3, 1.5)}
MARKERS = ["o", "s", "^", "D"]
DRAWN = ["running", "exponent", "running_spectrum", "spectrum", "spectrum_error"]
DRAWN += ["parting_predicted", "parting_measured", "omega", "initial"]


def gather(lyapunov: xr.Dataset) -> xr.Dataset:
    """Return what is drawn: rates on their way, the spectra, and parting times."""
    later = lyapunov.isel(tau=slice(1, None))
    running = later["stretch"] / later["tau"]
    running.attrs = {"long_name": "mean rate of growth since the start", "units": "tau-1"}
    data = later.assign(running=running)[DRAWN]
    return data.assign_attrs(spectrum_half_width=lyapunov.attrs["spectrum_half_width"])


@style.styled
def draw(data: xr.Dataset) -> Figure:
    """Draw the rates of growth against time, all exponents of short chains, and parting times."""
    figure = style.new_figure(style.DOUBLE, 3.1)
    running, spectrum, parting = figure.subplots(1, 3, width_ratios=(1.25, 1, 1))
    _draw_running(running, data)
    _draw_spectrum(spectrum, data)
    _draw_parting(parting, data)
    figure.legend(handles=_legend(data), loc="outside upper center", ncols=4)
    return figure


def _look(data: xr.Dataset, case: str) -> dict:
    colour = COLOURS.get(float(data["omega"].sel(case=case)), "0.5")
    return {"color": colour, "lw": WIDTHS.get(str(case).rpartition("_")[2], 1.0)}


def _marked(data: xr.Dataset, case: str) -> dict:
    """Return the same with a dot, hollow for small data."""
    look = _look(data, case)
    face = look["color"] if look["lw"] > 1 else "white"
    return {**look, "marker": "o", "markersize": 4, "markerfacecolor": face}


def _draw_running(axes: Axes, data: xr.Dataset) -> None:
    for case in data["case"].values:
        for parity in data["parity"].values:
            curve = data["running"].sel(case=case, parity=parity)
            shown = abs(curve.isel(tau=_evenly_on_log(curve["tau"])))
            axes.plot(shown["tau"], shown, dashes=DASHES[parity], **_look(data, case))
    axes.set_xscale("log")
    axes.set_yscale("log")
    axes.set_xlim(1, float(data["tau"].max()))
    axes.set_ylim(3e-4, 5)
    axes.set_xlabel(r"$\tau$")
    axes.set_ylabel("mean rate of growth (per unit of $\\tau$)")
    axes.set_title("one small change", loc="left")


def _evenly_on_log(tau: xr.DataArray, count: int = 40) -> np.ndarray:
    """Return where to sample equal steps of time so that a logarithmic axis is not crowded."""
    return np.unique(np.geomspace(1, tau.size, count).round().astype(int)) - 1


def _draw_spectrum(axes: Axes, data: xr.Dataset) -> None:
    for marker, case in zip(MARKERS, data["spectrum_case"].values, strict=False):
        rates = data["spectrum"].sel(spectrum_case=case)
        colour = _look(data, case)["color"]
        look = {"color": colour, "marker": marker, "markersize": 2.8, "linestyle": "none"}
        omega = float(data["omega"].sel(case=case))
        axes.plot(rates["index"], rates, label=rf"$\Omega = {omega:g}$", **look)
    axes.axhline(0.0, color="0.5", lw=0.6)
    half_width = data.attrs["spectrum_half_width"]
    axes.set_title(f"all changes, $M = {half_width}$", loc="left")
    axes.set_xlabel("number of the exponent")
    axes.set_ylabel("Lyapunov exponent (per unit of $\\tau$)")
    axes.legend(loc="upper right", handletextpad=0.1)


def _draw_parting(axes: Axes, data: xr.Dataset) -> None:
    tops = [1.0]
    for case in data["case"].values:
        predicted = data["parting_predicted"].sel(case=case)
        measured = data["parting_measured"].sel(case=case)
        look = _marked(data, case) | {"linestyle": "none"}
        for marker, rtol in zip(MARKERS, data["rtol"].values, strict=False):
            point = predicted.sel(rtol=rtol), measured.sel(rtol=rtol)
            axes.plot(*point, **look | {"marker": marker})
            tops.append(np.nanmax([1.0, *map(float, point)]))
    top = 1.1 * max(tops)
    axes.plot([0, top], [0, top], color="black", lw=0.8)
    axes.set_xlim(0, top)
    axes.set_ylim(0, top)
    axes.set_xlabel(r"parting predicted ($\tau$)")
    axes.set_ylabel(r"parting measured ($\tau$)")
    axes.set_title("runs parted by 1 %", loc="left")
    handles = [
        Line2D([], [], marker=marker, color="0.3", linestyle="none", markersize=4, label=_power(t))
        for marker, t in zip(MARKERS, data["rtol"].values, strict=False)
    ]
    axes.legend(handles=handles, title="tolerance", loc="lower right", handletextpad=0.1)


def _power(tolerance: float) -> str:
    return rf"$10^{{{round(np.log10(tolerance))}}}$"


def _legend(data: xr.Dataset) -> list[Line2D]:
    cases = [
        Line2D([], [], label=style.name_case(data.sel(case=case)), **_marked(data, case))
        for case in data["case"].values
    ]
    parities = [
        Line2D([], [], color="0.3", lw=1, dashes=dashes, label=f"{parity} in $n$")
        for parity, dashes in DASHES.items()
    ]
    return cases + parities
