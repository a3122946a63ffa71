"""The front on the chain without ends: its speed, and the state that it leaves behind."""

from dataclasses import asdict, replace

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from pendula.drawing import style
from pendula.problem import Constants

from . import figure_sea as sea_panels
from .figure_sea import GREEN, named
from .fronts import FRONT, SEA, speeds
from .linear_front import linear_front

SPANS, LATE = 36, 10
"""Spans of log tau in which the front's way is averaged; the last to which its line is laid."""


def gather_front(
    omegas: xr.Dataset, sea: xr.Dataset, large: xr.Dataset, thermal: xr.Dataset
) -> xr.Dataset:
    """Return fronts over Omega, the way of one of them, and the means behind it.

    `large` is the run whose sea spreads where the chain at rest is stable; `thermal` are the
    states without energy that the sea is compared with.
    """
    constants = Constants.of(sea.attrs)
    measured, errors = speeds(omegas)
    grid = np.linspace(-4.0, 8.0, 97)
    lines = [linear_front(replace(constants, omega=omega)).speed for omega in grid]
    title = "front speed (sites per unit of tau)"
    data = xr.Dataset(
        {
            "speed": named("omega", measured, f"measured {title}"),
            "speed_error": named("omega", errors, f"standard error of the {title}"),
            "predicted": named("line_omega", lines, f"linear spreading, {title}"),
            **_positions(omegas, large),
            **_way(sea),
            **sea_panels.gather(omegas, sea, thermal, constants),
        },
        {
            "omega": named("omega", omegas["omega"].values, "detuning Omega"),
            "line_omega": named("line_omega", grid, "detuning Omega"),
        },
    )
    return data.assign_attrs(**asdict(constants), large_omega=large.attrs["omega"])


def _positions(omegas: xr.Dataset, large: xr.Dataset) -> dict:
    """Return the fronts of the ensembles' first members against time."""
    first = omegas["front"].sel(level=FRONT).isel(member=0)
    of_sea = large["front"].sel(level=SEA).isel(variant=0, member=0)
    return {
        "tau": named("piece", omegas["piece_tau"].values, "slow time"),
        "front": named(("omega", "piece"), first.values, "site of the front"),
        "large_tau": named("large_piece", large["piece_tau"].values, "slow time, stable chain"),
        "large_front": named(
            "large_piece", of_sea.values, "site where the sea ends, stable chain, large data"
        ),
    }


def _way(sea: xr.Dataset) -> dict:
    front = sea["front"].isel(variant=0).sel(level=FRONT)
    tau = sea["piece_tau"].values
    v, delay = (float(sea[name].isel(variant=0)) for name in ("predicted_speed", "predicted_delay"))
    behind = (front.transpose("member", "piece_tau").values - v * tau).mean(axis=0)
    # a front stands on whole sites: means over short spans of log time show where it is
    spans = np.digitize(np.log(tau), np.linspace(np.log(tau[0]), np.log(tau[-1]), SPANS))
    found = [spans == span for span in np.unique(spans)]
    return {
        "way_tau": named("time", [tau[span].mean() for span in found], "slow time"),
        "behind": named("time", [behind[span].mean() for span in found], "front minus v tau"),
        "delay": named((), delay, "sites lost per unit of log tau, predicted"),
    }


@style.styled
def draw_front(data: xr.Dataset) -> Figure:
    """Draw the front (its way, speed and delay), then the state behind it."""
    figure = style.new_figure(style.DOUBLE, 4.6)
    above = (_draw_positions, _draw_speeds, _draw_way, sea_panels.draw_powers)
    below = (sea_panels.draw_terms, sea_panels.draw_spectrum, sea_panels.draw_moduli)
    rows = figure.subfigures(2, 1)
    for row, parts in zip(rows, (above, below), strict=True):
        for axes, part in zip(row.subplots(1, len(parts)), parts, strict=True):
            part(axes, data)
    return figure


def _draw_positions(axes: Axes, data: xr.Dataset) -> None:
    middle = data["omega"].values[data.sizes["omega"] // 2]
    for omega, colour in ((middle, style.RED), (data["omega"].values[0], GREEN)):
        label = rf"$\Omega = {omega:g}$"
        axes.plot(data["tau"], data["front"].sel(omega=omega), color=colour, lw=1.4, label=label)
        speed = np.interp(omega, data["line_omega"], data["predicted"])
        ends = np.array([0.0, float(data["tau"][-1])])
        axes.plot(ends, speed * ends, color="black", lw=0.7, ls="--")
    axes.lines[-1].set_label("linear")
    shown = data["large_tau"].values <= float(data["tau"][-1])
    label = rf"$\Omega = {float(data.attrs['large_omega']):g}$, large"
    sea = data["large_front"].values
    axes.plot(data["large_tau"].values[shown], sea[shown], color=style.BLUE, lw=1.1, label=label)
    axes.set_xlabel(r"$\tau$")
    axes.set_ylabel("site of the front")
    axes.set_ylim(top=1.9 * float(data["front"].max()))
    axes.legend(loc="upper left", handlelength=1.4)


def _draw_speeds(axes: Axes, data: xr.Dataset) -> None:
    axes.plot(data["line_omega"], data["predicted"], color="black", lw=0.9, label="linear")
    look = {"color": style.RED, "marker": "o", "ms": 3.5, "lw": 0, "elinewidth": 0.9}
    axes.errorbar(data["omega"], data["speed"], data["speed_error"], label="measured", **look)
    low, high = -2 * data.attrs["gamma"], 2 * data.attrs["gamma"] + 4 * data.attrs["epsilon"]
    axes.axvspan(low, high, color="0.92", zorder=0)
    axes.set_xlabel(r"$\Omega$")
    axes.set_ylabel(r"speed (sites per unit of $\tau$)")
    axes.legend(loc="lower center", handlelength=1.2)


def _draw_way(axes: Axes, data: xr.Dataset) -> None:
    tau = data["way_tau"].values
    axes.plot(tau, data["behind"], "o", color=style.RED, ms=2.5)
    line = -float(data["delay"]) * np.log(tau)
    line += float(data["behind"][-LATE:].mean()) - line[-LATE:].mean()
    axes.plot(tau, line, color="black", lw=0.9)
    axes.text(0.05, 0.08, r"line: $-\frac{3}{2\lambda}\,\ln\tau$", transform=axes.transAxes)
    axes.set_xscale("log")
    axes.set_xlabel(r"$\tau$")
    axes.set_ylabel(rf"front $- v^*\tau$ (sites), $\Omega = {data.attrs['omega']:g}$")
