"""The two fronts on the infinite chain in pictures: in space and time, and over Omega."""

import numpy as np
import xarray as xr
from latticode.drawing import style
from matplotlib.axes import Axes
from matplotlib.colors import LogNorm
from matplotlib.figure import Figure

LEAST = 1e-16
"""Powers below this one have its colour."""

DOTS = {"marker": "o", "ms": 3.0, "lw": 0, "elinewidth": 0.9, "capsize": 1.5}
FIRST = {**DOTS, "color": style.RED}
SECOND = {**DOTS, "color": style.BLUE, "marker": "s", "mfc": "white", "mew": 0.8}
LINES = {"color": "black", "lw": 0.9}
CAPTION = (
    "The two fronts on the infinite chain. (a), (b): the powers of A − B and of A + B in space and "
    "time at one Ω; the lines are the first front (solid) and the second (dashed). (c): their "
    "speeds, measured (marks) and predicted (lines). (d): the power per pair behind the second "
    "front and between the fronts, divided by that of the thermal state of both fields; dashed: "
    "the same ratio for the thermal state with A = −B. Bars are confidence intervals of the mean."
)


def gather_fronts(fronts: xr.Dataset) -> xr.Dataset:
    """Return what `measured.measure_fronts` has made."""
    return fronts.assign_attrs(caption=CAPTION)


@style.styled
def draw_fronts(data: xr.Dataset) -> Figure:
    """Draw both fronts in space and time, their speeds over Omega, and the powers behind them."""
    figure = style.new_figure(style.WIDTH, 2.2)
    alone, both, speeds, powers = figure.subplots(1, 4)
    mesh = _draw_in_time(alone, data, "antisymmetric_power")
    _draw_in_time(both, data, "symmetric_power")
    both.set_yticklabels([])
    alone.set_ylabel(r"$\tau$")
    bar = figure.colorbar(
        mesh, ax=[alone, both], location="top", aspect=30, pad=0.02, ticks=[1e-15, 1e-10, 1e-5, 1e0]
    )
    bar.set_label(rf"power at $\Omega = {float(data['shown_omega']):g}$")
    _draw_speeds(speeds, data)
    _draw_powers(powers, data)
    titles = (r"(a) $|A - B|^2 / 2$", r"(b) $|A + B|^2 / 2$", "(c)", "(d)")
    for axes, title in zip((alone, both, speeds, powers), titles, strict=True):
        axes.set_title(title, loc="left")
    return figure


def _draw_in_time(axes: Axes, data: xr.Dataset, name: str):
    tau, sites = data["piece_tau"].values, data["cell_site"].values
    values = np.maximum(data[name].transpose("piece_tau", "cell_site").values, LEAST)
    mesh = axes.pcolormesh(
        sites, tau, values, norm=LogNorm(LEAST, 10.0), cmap="magma", shading="nearest",
        rasterized=True,
    )  # fmt: skip
    axes.plot(data["front_site"], tau, **style.ON_COLOURS | {"ls": "-"})
    axes.plot(data["second_front_site"], tau, **style.ON_COLOURS)
    axes.set_xlim(0.0, 1.15 * max(10.0, float(data["front_site"].max())))
    axes.set_xlabel("site $n$")
    return mesh


def _draw_speeds(axes: Axes, data: xr.Dataset) -> None:
    """Draw the speeds of both fronts, measured and predicted."""
    omega = data["omega"]
    for name, line, look, label in (
        ("front_speed", "linear_speed", FIRST, "first"),
        ("second_front_speed", "predicted_second_speed", SECOND, "second"),
    ):
        axes.plot(omega, data[line], **LINES, ls="-" if label == "first" else (0, (4, 2)))
        limits = data[f"{name}_error"]
        axes.errorbar(omega, data[name], limits.where(np.isfinite(limits)), label=label, **look)
    axes.set_ylim(bottom=0)
    axes.set(xlabel=r"$\Omega$", ylabel=r"speed (sites per $\tau$)")
    axes.legend(loc="lower left", handlelength=1.0)


def _draw_powers(axes: Axes, data: xr.Dataset) -> None:
    """Draw the powers behind the fronts over that of the thermal state of both fields."""
    omega, thermal = data["omega"], data["thermal_power"]
    axes.axhline(1.0, **LINES)
    axes.plot(omega, data["thermal_antisymmetric_power"] / thermal, **LINES, ls=(0, (4, 2)))
    for name, look, label in (
        ("power_between", FIRST, "between"),
        ("power_behind", SECOND, "behind both"),
    ):
        limits = data[f"{name}_error"] / thermal
        axes.errorbar(
            omega, data[name] / thermal, limits.where(np.isfinite(limits)), label=label, **look
        )
    axes.set_ylim(bottom=0.6)
    axes.set(xlabel=r"$\Omega$", ylabel="power / thermal power")
    axes.legend(loc="lower left", handlelength=1.0)
