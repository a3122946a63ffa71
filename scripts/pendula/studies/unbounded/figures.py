"""Chains without ends in pictures: norms against time, and maxima over half-widths and windows."""

from functools import partial

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.collections import QuadMesh
from matplotlib.colors import LogNorm
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from pendula.drawing import panels, style

LOOKS = {
    "fig4_small": {"color": style.RED, "ls": "-"},
    "fig3_large": {"color": style.BLUE, "ls": "-"},
    "fig2_large": {"color": "#16876b", "ls": "--"},
    "fig3_small": {"color": "#b07800", "ls": ":"},
}
NORMS = {name: panels.NORMS[name] for name in ("l2", "linf")}


@style.styled
def draw_growth_law(data: xr.Dataset) -> Figure:
    """Draw l2 with its law, the exponents of l2 over octaves of time, and l-infinity."""
    figure = style.new_figure(style.DOUBLE, 2.9)
    l2, exponents, linf = figure.subplots(1, 3)
    for axes, name in ((l2, "l2"), (linf, "linf")):
        _draw_norm(axes, data, name)
    _draw_law(l2, data)
    _draw_exponents(exponents, data)
    l2.set_yscale("log")
    exponents.set_xlim(8.0, l2.get_xlim()[1])
    handles, labels = linf.get_legend_handles_labels()
    figure.legend(handles, labels, loc="outside upper center", ncols=2)
    return figure


def _draw_norm(axes: Axes, data: xr.Dataset, name: str) -> None:
    for case in data["case"].values:
        one = data.sel(case=case)
        look = {"label": style.name_case(one), "lw": 1.1, **LOOKS[str(case)]}
        axes.plot(one["tau"], one[name].sel(band="mean"), **look)
        low, high = (one[name].sel(band=bound) for bound in ("lowest", "highest"))
        axes.fill_between(one["tau"], low, high, color=look["color"], alpha=0.25, lw=0)
    axes.set_xscale("log")
    axes.set_xlabel(r"$\tau$")
    axes.set_ylabel(f"{NORMS[name]} of $(A, B)$")
    if name == "linf":
        axes.set_ylim(bottom=0)


def _draw_law(axes: Axes, data: xr.Dataset) -> None:
    for case in data["case"].values:
        one = data.sel(case=case)
        if np.isfinite(one["law"]):
            law = float(one["law"]) * np.sqrt(one["tau"])
            axes.plot(one["tau"], law, color="black", lw=0.9, ls=(0, (4, 2)))
            middle = data.sizes["point"] // 2
            place = float(one["tau"][middle]), float(law[middle])
            axes.annotate(
                r"$(2 v^* P\,\tau)^{1/2}$", place, (-3, 5), textcoords="offset points", ha="right"
            )


def _draw_exponents(axes: Axes, data: xr.Dataset) -> None:
    axes.axhline(0.5, color="black", lw=0.8)
    for i, case in enumerate(data["case"].values):
        one = data.sel(case=case)
        exponent, error = one["l2_exponent"].values, one["l2_exponent_error"].values
        aside = 1.0 + 0.04 * (i - 1.5)  # so that error bars stand beside each other
        look = {"color": LOOKS[str(case)]["color"], "marker": "osD^"[i], "ms": 3.5, "lw": 0}
        axes.errorbar(aside * one["octave_tau"], exponent, error, elinewidth=0.9, capsize=2, **look)
    axes.set_xscale("log")
    axes.set_xlabel(r"$\tau$ (octaves)")
    axes.set_ylabel(r"power of $\tau$ in $\ell^2$")


def gather_window_map(maps: dict[str, xr.Dataset], paper_ends: list[float]) -> xr.Dataset:
    """Return the maps of all sweeps: lowest, mean and highest value over each ensemble.

    `paper_ends` are the ends T of the paper's windows [10, T], one a sweep.
    """
    found = []
    for data in maps.values():
        both = data[["l2", "linf"]]
        parts = [both.min("member"), both.mean("member"), both.max("member")]
        words = {"long_name": "value over the members of the ensemble"}
        panel = xr.concat(parts, xr.Variable("band", ["lowest", "mean", "highest"], words))
        for name in both:
            panel[name].attrs = both[name].attrs
        found.append(panel.assign(predicted_speed=data["predicted_speed"]).assign_attrs(data.attrs))
    joined = style.join(found, list(maps), "sweep")
    ends = np.minimum(paper_ends, float(joined["end"][-1]))
    return joined.assign(paper_end=("sweep", ends, {"long_name": "end of the paper's window"}))


@style.styled
def draw_window_map(data: xr.Dataset) -> Figure:
    """Draw a column for each sweep: the map of l2 above, maxima at two ends T below."""
    figure = style.new_figure(style.DOUBLE, 4.2)
    grid = figure.subplots(2, data.sizes["sweep"], sharex=True, sharey="row")
    shown = data["l2"].sel(band="mean")
    norm = LogNorm(float(shown.min()), float(shown.max()))
    for (above, below), sweep in zip(grid.T, data["sweep"].values, strict=True):
        one = data.sel(sweep=sweep)
        mesh = _draw_map(above, one, norm)
        _draw_at_ends(below, one)
    grid[0, 0].set_ylabel("end $T$ of the window $[10, T]$")
    grid[1, 0].set_ylabel("maximal norm of $(A, B)$")
    bar = figure.colorbar(mesh, ax=grid[0].tolist(), pad=0.01, aspect=14)
    bar.set_label(r"maximal $\ell^2$ of $(A, B)$")
    figure.legend(handles=_legend(data), loc="outside lower center", ncols=3, columnspacing=1.4)
    return figure


def _draw_map(axes: Axes, one: xr.Dataset, norm: LogNorm) -> QuadMesh:
    values = one["l2"].sel(band="mean").transpose("end", "half_width")
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


def _draw_at_ends(axes: Axes, one: xr.Dataset) -> None:
    for end, fill in ((float(one["paper_end"]), True), (float(one["end"][-1]), False)):
        maxima = one.sel(end=end, method="nearest")
        for name in ("l2", "linf"):
            middle = maxima[name].sel(band="mean").values
            bounds = [maxima[name].sel(band=b).values for b in ("lowest", "highest")]
            errors = np.abs(np.array(bounds) - middle)
            axes.errorbar(one["half_width"], middle, errors, elinewidth=0.8, **_mark(name, fill))
        axes.axvline(float(one["predicted_speed"]) * end, **_line(fill))
    axes.set_yscale("log")
    axes.set_xlabel("half-width $M$")
    _log_axis(axes, one)


def _mark(name: str, fill: bool) -> dict:
    colour = style.COLOURS[name]
    dots = {"marker": panels.MARKERS[name], "ms": 3.2, "mfc": colour if fill else "white"}
    return {"color": colour, "mew": 0.7, "lw": 0.6, **dots}


def _line(fill: bool) -> dict:
    return {"color": "0.45", "lw": 0.9, "ls": (0, (4, 2)) if fill else "-"}


def _log_axis(axes: Axes, one: xr.Dataset) -> None:
    panels.half_width_axis(axes, [10, 100, 1000])
    edges = _log_edges(one["half_width"].values)
    axes.set_xlim(edges[0], edges[-1])


def _legend(data: xr.Dataset) -> list[Line2D]:
    ends = ((True, "the paper's $T$"), (False, f"$T = {float(data['end'][-1]):g}$"))
    looks = [(NORMS[name], partial(_mark, name)) for name in NORMS]
    looks += [("$M = v^*T$", _line)]
    return [
        Line2D([], [], label=f"{label}, {text}", **look(fill))
        for label, look in looks
        for fill, text in ends
    ]
