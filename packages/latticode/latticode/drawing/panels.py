"""Panels of runs and sweeps: fields over time and sites, norms against the half-width."""

from collections.abc import Sequence
from typing import Any

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.colorizer import ColorizingArtist
from matplotlib.colors import Normalize, PowerNorm
from matplotlib.figure import Figure
from matplotlib.ticker import FixedLocator, NullLocator, StrMethodFormatter

from . import style
from .strips import NORMS

MARKERS = {"l2": "o", "linf": "s"}  # different shapes distinguish the norms in greyscale too
SIZES = {"max": 3.6, "mean": 2.4}
BAR = {"color": "black", "marker": ".", "markersize": 2, "lw": 0, "elinewidth": 0.8, "capsize": 1.2}
OFFSET = 1.1
"""Error bars are drawn at the half-width times this factor, so that they do not cover dots."""
TICKS = [a * 10**k for k in range(5) for a in (1, 2, 5)]


def positive(curve: xr.DataArray) -> xr.DataArray:
    """Return the positive values of a curve, which a logarithmic axis can show."""
    return curve.where(curve > 0).dropna("tau")


def over_time(run: xr.Dataset) -> xr.Dataset:
    """Return the moduli of a trajectory over the times of its snapshots."""
    return _by_time(run[["modulus", "snapshot_tau"]])


def values_over_time(run: xr.Dataset) -> xr.Dataset:
    """Return the signed values of real fields over the times of the snapshots."""
    values = run["state"].sel(part="value", drop=True)
    return _by_time(run[["snapshot_tau"]].assign(value=values))


def _by_time(fields: xr.Dataset) -> xr.Dataset:
    fields = fields.set_coords("snapshot_tau")
    fields = fields.drop_vars("snapshot", errors="ignore")  # in a notebook: the same times
    return fields.swap_dims(snapshot="snapshot_tau")


def draw_moduli(
    figure: Figure, row: np.ndarray, case: xr.Dataset, names: list[str], evenly: bool = True
) -> None:
    """Draw the moduli of each field of one case in a panel of `row`, with one colour scale.

    `names` complete the titles of the panels. Pass evenly=False if the snapshots are not equally
    spaced in time. Each is then as wide as its time interval.
    """
    moduli = case["modulus"]
    peak = float(moduli.max()) or 1.0
    norm = PowerNorm(0.5, vmin=0, vmax=peak)  # on a linear scale one large site hides all others
    look = {"cmap": "inferno", "norm": norm}
    image = _draw_fields(row, moduli, names, r"$|{field}|$,  {name}", evenly, **look)
    bar = figure.colorbar(image, ax=row.tolist(), pad=0.015, aspect=18)
    units = "" if moduli.attrs.get("units", "1") == "1" else f"{moduli.attrs['units']}, "
    bar.set_label(f"modulus ({units}square-root scale)", fontsize="medium")


def draw_values(
    figure: Figure, row: np.ndarray, case: xr.Dataset, names: list[str], evenly: bool = True
) -> None:
    """Draw the values of each real field of one case: blue is negative, white zero, red positive.

    All fields have one colour scale, symmetric about zero. `names` and `evenly` mean the same
    as in `draw_moduli`.
    """
    values = case["value"]
    peak = float(np.abs(values).max()) or 1.0
    look = {"cmap": "RdBu_r", "norm": Normalize(-peak, peak)}
    image = _draw_fields(row, values, names, "${field}$,  {name}", evenly, **look)
    bar = figure.colorbar(image, ax=row.tolist(), pad=0.015, aspect=18)
    bar.set_label(f"value{style.name_units(values)}", fontsize="medium")


def is_even(times: np.ndarray) -> bool:
    """Return whether times are equally spaced."""
    steps = np.diff(times)
    return not steps.size or bool(np.ptp(steps) <= 1e-6 * steps.max())


def _draw_fields(
    row: np.ndarray, fields: xr.DataArray, names: list[str], title: str, evenly: bool, **look: Any
) -> ColorizingArtist:
    """Draw each field over time and sites, and return the last image."""
    fields = fields.transpose("component", "site", "snapshot_tau")
    times, sites = fields["snapshot_tau"].values, fields["site"].values
    for axes, field, name in zip(row, fields, names, strict=True):
        if evenly:
            shape = {"extent": (*_edges(times), *_edges(sites)), "origin": "lower"}
            image = axes.imshow(field, aspect="auto", interpolation="nearest", **shape, **look)
        else:
            image = axes.pcolormesh(times, sites, field, shading="nearest", **look)
        symbol = style.symbol(field["component"].item(), "n")
        style.set_title(axes, title.format(field=symbol, name=name).removesuffix(",  "))
    return image


def _edges(centres: np.ndarray) -> tuple[float, float]:
    half = (centres[1] - centres[0]) / 2 if len(centres) > 1 else 0.5
    return centres[0] - half, centres[-1] + half


def join_sweeps(
    sweeps: dict[str, xr.Dataset],
    readings: dict[str, tuple[str, str]],
    norms: list[str],
    stored_attributes: Sequence[str] = ("initial",),
) -> xr.Dataset:
    """Return the norms of all fields along (panel, reading, half_width), one panel for each sweep.

    A reading is a statistic and a time window by their labels in the sweeps, such as ("max",
    "[10, 50]"). `stored_attributes` are attributes of the sweeps that become variables over the
    panels.
    """
    panels = [_read(sweep[list(norms)], readings) for sweep in sweeps.values()]
    statistics, windows = zip(*readings.values(), strict=True)
    data = style.join(panels, list(sweeps), "panel", stored_attributes)
    return data.assign(statistic=("reading", list(statistics)), window=("reading", list(windows)))


def _read(sweep: xr.Dataset, readings: dict[str, tuple[str, str]]) -> xr.Dataset:
    chosen = [
        sweep.sel(quantity="pair", statistic=statistic, window=window, drop=True)
        for statistic, window in readings.values()
    ]
    return xr.concat(chosen, xr.Variable("reading", list(readings))).assign_attrs(sweep.attrs)


def draw_sweep(axes: Axes, panel: xr.Dataset, fields: str) -> None:
    """Draw the norms of one panel against the half-width, with error bars of ensembles.

    Maxima are filled, means are hollow. Every curve has a label for a legend. `fields` are the
    symbols of the fields on the y axis.
    """
    norms = [name for name in reversed(NORMS) if name in panel]
    label = f"mean ± SD of {int(panel.get('members', 0))} runs"
    for name in norms:
        for reading in panel["reading"].values:
            read = panel.sel(reading=reading)
            statistic, dots = read["statistic"].item(), read[name].dropna("half_width")
            name_of_curve = f"{NORMS[name]}, {statistic} on {read['window'].item()}"
            look = _sweep_look(name, statistic)
            axes.plot(dots["half_width"], dots, label=name_of_curve, **look)
            if "members" in panel and read[f"{name}_mean"].notnull().any():
                bars = read[[f"{name}_mean", f"{name}_deviation"]].dropna("half_width")
                middles, halves = bars.data_vars.values()
                axes.errorbar(OFFSET * bars["half_width"], middles, halves, label=label, **BAR)
    axes.set_xscale("log")
    axes.xaxis.set_major_locator(FixedLocator(TICKS))
    axes.xaxis.set_minor_locator(NullLocator())
    axes.xaxis.set_major_formatter(StrMethodFormatter("{x:g}"))
    axes.set_ylim(0, 1.08 * axes.dataLim.ymax or 1.0)
    axes.set_xlabel("half-width $M$  ($N = 2M + 1$ sites)")
    names_of_norms = " and ".join(NORMS[name] for name in norms)
    axes.set_ylabel(f"{names_of_norms} of {fields}{style.name_units(panel[norms[0]])}")


def _sweep_look(name: str, statistic: str) -> dict:
    colour = style.COLOURS[name]
    return {
        "linestyle": "none",
        "marker": MARKERS[name],
        "markersize": SIZES[statistic],
        "color": colour,
        "markerfacecolor": colour if statistic == "max" else "white",
        "markeredgewidth": 0.7,
    }
