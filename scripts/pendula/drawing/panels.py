"""Panels that figures of several studies share: one for each case, norms, moduli, sweeps."""

from collections.abc import Callable, Sequence
from typing import NamedTuple

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.colors import PowerNorm
from matplotlib.figure import Figure
from matplotlib.image import AxesImage
from matplotlib.lines import Line2D
from matplotlib.ticker import FixedLocator, NullLocator, StrMethodFormatter

from . import style

NORMS = {"linf": r"$\ell^\infty$", "l2": r"$\ell^2$"}
PALE = {"A": "#f0a79f", "B": "#9db2de"}
"""Colours of the curves that lie below the drawn run: the reference, or a second run."""

MARKERS = {"l2": "o", "linf": "s"}  # the shapes tell the norms apart in grey too
SIZES = {"text": 3.6, "caption": 2.4}
TICKS = [a * 10**k for k in range(5) for a in (1, 2, 5)]


def draw_cases(data: xr.Dataset, draw_panel: Callable[[Axes, xr.Dataset], None], label: str):
    """Return a figure with a panel for each case, drawn by `draw_panel`, and one legend above."""
    figure = style.new_figure(style.DOUBLE, 4.0)
    drawn = _case_panels(figure, data)
    for axes, case in zip(drawn, data["case"].values, strict=True):
        draw_panel(axes, data.sel(case=case))
        axes.set_xlim(0, float(data["tau"].max()))
        if axes.get_subplotspec().is_first_col():
            axes.set_ylabel(label)
    style.name_legend(figure, drawn[0])
    return figure


def _case_panels(figure: Figure, data: xr.Dataset) -> list[Axes]:
    """Return one panel for each case: a column for each figure of the paper, small data above."""
    count = data.sizes["case"]
    grid = figure.subplots(min(count, 2), -(-count // 2), sharex=True, sharey=True, squeeze=False)
    for axes in grid.T.flat[count:]:
        axes.set_visible(False)
    for axes, case in zip(grid.T.flat, data["case"].values, strict=False):
        axes.set_title(style.name_case(data.sel(case=case)), loc="left")
        axes.set_yscale("log")
    for axes in grid[-1]:
        axes.set_xlabel(r"$\tau$")
    return list(grid.T.flat[:count])


def positive(curve: xr.DataArray) -> xr.DataArray:
    """Return the part of a curve that a logarithmic axis can show."""
    return curve.where(curve > 0).dropna("tau")


class Below(NamedTuple):
    """The curves below a run, and the mark at the divergence time.

    `prefix` is how the names of their variables begin, `label` and `mark` stand in the legend.
    """

    prefix: str
    label: str
    mark: str


def draw_norm(axes: Axes, case: xr.Dataset, name: str, below: Below) -> None:
    """Draw one norm of A and B, and below them the curves of `below`, if the case has any."""
    for component in case["component"].values if f"{below.prefix}_{name}" in case else ():
        other = case[f"{below.prefix}_{name}"].sel(component=component)
        axes.plot(other["tau"], other, color=PALE[component], label=f"{below.label} ${component}$")
    for component in case["component"].values:
        curve = case[name].sel(component=component).dropna("tau")
        colour = style.COLOURS[component]
        axes.plot(curve["tau"], curve, color=colour, label=f"${component}$", alpha=0.9)
    if "divergence_time" in case:
        look = {"marker": "v", "color": "black", "linestyle": "none", "markersize": 4}
        top = axes.get_xaxis_transform()
        time = case["divergence_time"]
        axes.plot(time, 1.0, transform=top, clip_on=False, label=below.mark, **look)
    axes.set_xlim(0, float(case["tau"].max()))
    axes.set_ylim(bottom=0)
    axes.set_ylabel(f"{NORMS[name]} norm")


def over_time(run: xr.Dataset) -> xr.Dataset:
    """Return the moduli of a trajectory over the times of its snapshots."""
    moduli = run[["modulus", "snapshot_tau"]].set_coords("snapshot_tau")
    return moduli.swap_dims(snapshot="snapshot_tau")


def draw_moduli(figure: Figure, row: np.ndarray, case: xr.Dataset, names: list[str]) -> None:
    """Draw |A_n| and |B_n| of one case, each under its name, on one scale of colours."""
    peak = float(case["modulus"].max())
    for axes, component, name in zip(row, case["component"].values, names, strict=True):
        image = _draw_modulus(axes, case["modulus"].sel(component=component), peak)
        axes.set_title(f"$|{component}_n|$,  {name}", loc="left")
    bar = figure.colorbar(image, ax=row.tolist(), pad=0.015, aspect=18)
    bar.set_label("modulus (square-root scale)")


def _draw_modulus(axes: Axes, modulus: xr.DataArray, peak: float) -> AxesImage:
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


def join_sweeps(
    sweeps: dict[str, xr.Dataset], text_window: str, caption_window: str, norms: list[str]
) -> xr.Dataset:
    """Return two readings of the pair's norms in each sweep, by the name of its panel.

    The reading "text" is the maximum over `text_window`, "caption" the mean over `caption_window`.
    Windows of time are named as in the sweeps, such as "[10, 50]".
    """
    readings = {"text": ("max", text_window), "caption": ("mean", caption_window)}
    panels = [_read(sweep[list(norms)], readings) for sweep in sweeps.values()]
    statistics, windows = zip(*readings.values(), strict=True)
    data = style.join(panels, list(sweeps), "panel")
    return data.assign(statistic=("reading", list(statistics)), window=("reading", list(windows)))


def _read(sweep: xr.Dataset, readings: dict[str, tuple[str, str]]) -> xr.Dataset:
    chosen = [
        sweep.sel(quantity="pair", statistic=statistic, window=window, drop=True)
        for statistic, window in readings.values()
    ]
    return xr.concat(chosen, xr.Variable("reading", list(readings))).assign_attrs(sweep.attrs)


def draw_sweep(axes: Axes, panel: xr.Dataset) -> None:
    """Draw the norms that one panel holds against the half-width."""
    norms = [name for name in reversed(NORMS) if name in panel]
    for name in norms:
        for reading in panel["reading"].values:
            dots = panel[name].sel(reading=reading).dropna("half_width")
            axes.plot(dots["half_width"], dots, **_sweep_look(name, reading))
    half_width_axis(axes)
    axes.set_ylim(*_limits(panel[norms]))
    axes.set_xlabel("half-width $M$  ($N = 2M + 1$ sites)")
    axes.set_ylabel(f"{' and '.join(NORMS[name] for name in norms)} of $(A, B)$")
    axes.set_title(style.name_case(panel), loc="left")


def half_width_axis(axes: Axes, ticks: Sequence[float] = TICKS) -> None:
    """Make the horizontal axis logarithmic, with ticks at 1, 2, 5, 10 and so on, or at others."""
    axes.set_xscale("log")
    axes.xaxis.set_major_locator(FixedLocator(ticks))
    axes.xaxis.set_minor_locator(NullLocator())
    axes.xaxis.set_major_formatter(StrMethodFormatter("{x:g}"))


def _limits(norms: xr.Dataset) -> tuple[float, float]:
    values = norms.to_dataarray()
    low, high = float(values.min()), float(values.max())
    # the axis starts at zero, unless that would leave the panel empty below a band of dots
    return (0 if low < 0.85 * high else 0.8 * low), 1.08 * high


def _sweep_look(name: str, reading: str) -> dict:
    colour = style.COLOURS[name]
    return {
        "linestyle": "none",
        "marker": MARKERS[name],
        "markersize": SIZES[reading],
        "color": colour,
        "markerfacecolor": colour if reading == "text" else "white",
        "markeredgewidth": 0.7,
    }


def sweep_legend(data: xr.Dataset) -> list[Line2D]:
    """Return one entry for each norm and reading."""
    names = {
        str(reading): "{} on {}".format(
            *(str(data[key].sel(reading=reading).values) for key in ("statistic", "window"))
        )
        for reading in data["reading"].values
    }
    return [
        Line2D([], [], label=f"{NORMS[name]}, {names[reading]}", **_sweep_look(name, reading))
        for name in reversed(NORMS)
        if name in data
        for reading in names
    ]
