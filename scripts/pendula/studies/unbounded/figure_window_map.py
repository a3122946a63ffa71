"""Maxima over [10, T] on chains of half-width M: the map over (M, T), and the paper's cut."""

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.collections import QuadMesh
from matplotlib.colors import LogNorm
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.ticker import FixedLocator, NullLocator, StrMethodFormatter

from pendula.drawing import style

PAPER_ENDS = {"fig5_left": 50, "fig5_right": 50, "fig6_left": 70, "fig6_right": 70}
TITLES = {"l2": r"$\ell^2$", "linf": r"$\ell^\infty$"}


def gather(maps: dict[str, xr.Dataset]) -> xr.Dataset:
    """Return the maps of all sweeps: lowest, mean and highest value over each ensemble."""
    panels = []
    for data in maps.values():
        both = data[["l2", "linf"]]
        parts = [both.min("member"), both.mean("member"), both.max("member")]
        panel = xr.concat(parts, xr.Variable("statistic", ["lowest", "mean", "highest"]))
        panel["arrival"] = data["arrival"].mean("member").assign_attrs(data["arrival"].attrs)
        panel["predicted_speed"] = data["predicted_speed"]
        panels.append(panel.assign_attrs(data.attrs))
    joined = style.join(panels, list(maps), "sweep", "sweep of Figs 5 and 6")
    for name in ("l2", "linf"):
        joined[name].attrs = dict(next(iter(maps.values()))[name].attrs)
    joined["statistic"].attrs = {"long_name": "over the ensemble", "units": "1"}
    last = float(joined["end"][-1])
    ends = [min(PAPER_ENDS.get(name, last), last) for name in maps]
    joined["paper_end"] = ("sweep", ends, {"long_name": "end of the paper's window", "units": "1"})
    return joined


@style.styled
def draw(data: xr.Dataset) -> Figure:
    """Draw a column for each sweep: the map of l2 above, cuts through it below."""
    figure = style.new_figure(style.DOUBLE, 4.2)
    panels = figure.subplots(2, data.sizes["sweep"], sharex=True, sharey="row")
    shown = data["l2"].sel(statistic="mean")
    norm = LogNorm(float(shown.min()), float(shown.max()))
    for (above, below), sweep in zip(panels.T, data["sweep"].values, strict=True):
        one = data.sel(sweep=sweep)
        mesh = _draw_map(above, one, norm)
        _draw_cuts(below, one)
    panels[0, 0].set_ylabel("end $T$ of the window $[10, T]$")
    panels[1, 0].set_ylabel("maximal norm of $(A, B)$")
    bar = figure.colorbar(mesh, ax=panels[0].tolist(), pad=0.01, aspect=14)
    bar.set_label(r"maximal $\ell^2$ of $(A, B)$")
    figure.legend(handles=_legend(data), loc="outside lower center", ncols=3, columnspacing=1.4)
    return figure


def _draw_map(axes: Axes, one: xr.Dataset, norm: LogNorm) -> QuadMesh:
    values = one["l2"].sel(statistic="mean").transpose("end", "half_width")
    ends = one["end"].values
    edges = np.append(ends - 0.5 * (ends[1] - ends[0]), ends[-1] + 0.5 * (ends[1] - ends[0]))
    mesh = axes.pcolormesh(
        _log_edges(one["half_width"].values), edges, values, norm=norm, cmap="viridis"
    )
    axes.set_ylim(edges[0], edges[-1])
    axes.plot(float(one["predicted_speed"]) * ends, ends, color="white", lw=1.2)
    axes.axhline(float(one["paper_end"]), color="white", lw=0.9, ls=(0, (4, 2)))
    place = (0.97, float(one["paper_end"]))
    axes.annotate(
        "the paper", place, (0, 2), ("axes fraction", "data"), "offset points",
        ha="right", color="white", fontsize=7,
    )  # fmt: skip
    axes.set_title(style.name_case(one).replace(",  ", "\n"), loc="left")
    _log_axis(axes, one)
    return mesh


def _log_edges(widths: np.ndarray) -> np.ndarray:
    """Return the edges of cells around half-widths on a logarithmic axis."""
    inner = np.sqrt(widths[1:] * widths[:-1])
    return np.array([widths[0] ** 2 / inner[0], *inner, widths[-1] ** 2 / inner[-1]])


def _draw_cuts(axes: Axes, one: xr.Dataset) -> None:
    for end, fill in ((float(one["paper_end"]), True), (float(one["end"][-1]), False)):
        cut = one.sel(end=end, method="nearest")
        for name in ("l2", "linf"):
            middle = cut[name].sel(statistic="mean").values
            bounds = [cut[name].sel(statistic=b).values for b in ("lowest", "highest")]
            errors = np.abs(np.array(bounds) - middle)
            axes.errorbar(one["half_width"], middle, errors, **_look(name, fill))
        axes.axvline(float(one["predicted_speed"]) * end, color="0.45", **_line(fill))
    axes.set_yscale("log")
    axes.set_xlabel("half-width $M$")
    _log_axis(axes, one)


def _look(name: str, fill: bool) -> dict:
    colour = style.COLOURS[name]
    return {
        "color": colour,
        "marker": {"l2": "o", "linf": "s"}[name],
        "ms": 3.2,
        "mfc": colour if fill else "white",
        "mew": 0.7,
        "lw": 0.6,
        "elinewidth": 0.8,
    }


def _mark(name: str, fill: bool) -> dict:
    return {key: value for key, value in _look(name, fill).items() if key != "elinewidth"}


def _line(fill: bool) -> dict:
    return {"lw": 0.9, "ls": (0, (4, 2)) if fill else "-"}


def _log_axis(axes: Axes, one: xr.Dataset) -> None:
    axes.set_xscale("log")
    edges = _log_edges(one["half_width"].values)
    axes.set_xlim(edges[0], edges[-1])
    axes.xaxis.set_major_locator(FixedLocator([10, 100, 1000]))
    axes.xaxis.set_minor_locator(NullLocator())
    axes.xaxis.set_major_formatter(StrMethodFormatter("{x:g}"))


def _legend(data: xr.Dataset) -> list[Line2D]:
    last = float(data["end"][-1])
    handles = [
        Line2D([], [], label=f"{TITLES[name]}, {text}", **_mark(name, fill))
        for name in TITLES
        for fill, text in ((True, "the paper's $T$"), (False, f"$T = {last:g}$"))
    ]
    handles += [
        Line2D([], [], color="0.45", label=f"$M = v^*T$, {text}", **_line(fill))
        for fill, text in ((True, "the paper's $T$"), (False, f"$T = {last:g}$"))
    ]
    return handles
