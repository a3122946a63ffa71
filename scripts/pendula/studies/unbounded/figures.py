"""Infinite chains in pictures: norms against time, and maxima over half-widths and windows."""

from functools import partial

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.collections import QuadMesh
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from matplotlib.patheffects import withStroke
from matplotlib.ticker import MaxNLocator, NullFormatter

from pendula.drawing import panels, style

LOOKS = {
    "fig4_small": {"color": style.RED, "ls": "-", "lw": 1.1},
    "fig3_large": {"color": style.BLUE, "ls": "-", "lw": 1.1},
    "fig2_large": {"color": "#16876b", "ls": "--", "lw": 1.1},
    "fig3_small": {"color": "#b07800", "ls": ":", "lw": 1.1},
}
LAW = {"color": "black", "lw": 0.9, "ls": (0, (4, 2))}
OFFSET = {"color": "black", "lw": 0.8, "ls": ":"}
NORMS = {name: panels.NORMS[name] for name in ("l2", "linf")}
CAPTION = (
    "Infinite chains against τ. (a): the square of the ℓ² norm over τ. (b): its relative "
    "deviation from its law. (c): the exponent of τ in the ℓ² norm over each doubling of τ, with "
    "a line at 1/2. (d): the ℓ∞ norm. The dashed law has no fitted constant: it takes the chain "
    "to be in the thermal state up to the front. The dotted line adds a fitted constant to the "
    "square of the norm. Bands reach from the lowest to the highest run of an ensemble; bars are "
    "confidence intervals of the mean."
)


def gather_growth_law(growth: xr.Dataset) -> xr.Dataset:
    """Return what `measured.measure_growth` has made."""
    return growth.assign_attrs(caption=CAPTION)


@style.styled
def draw_growth_law(data: xr.Dataset) -> Figure:
    """Draw l2^2 / tau beside its law, what is left over, exponents over octaves, l-infinity."""
    figure = style.new_figure(style.DOUBLE, 4.4)
    (rate, rest), (exponents, linf) = figure.subplots(2, 2, sharex=True)
    rest.axhline(0.0, **LAW)
    exponents.axhline(0.5, color="black", lw=0.8)
    start = float(data["span_tau"].min())
    for i, case in enumerate(data["case"].values):
        one, look = data.sel(case=case), LOOKS[str(case)]
        rate.plot(
            one["span_tau"], one["l2_rate"].sel(band="mean"), label=style.name_case(one), **look
        )
        _shade(rate, one["span_tau"], one["l2_rate"], look)
        rate.plot(one["span_tau"], one["law_rate"], **LAW)
        if np.isfinite(one["law"]):
            _draw_rest(rest, one, look["color"])
        exponent, error = one["l2_exponent"].values, one["l2_exponent_error"].values
        aside = 1.0 + 0.04 * (i - 1.5)  # so that error bars stand beside each other
        dots = {"color": look["color"], "marker": "osD^"[i], "ms": 3.5, "lw": 0, "capsize": 2}
        exponents.errorbar(aside * one["octave_tau"], exponent, error, elinewidth=0.9, **dots)
        late = one["tau"].where(one["tau"] >= start)
        linf.plot(late, one["linf"].sel(band="mean"), **look)
        _shade(linf, late, one["linf"], look)
        linf.plot(late, one["thermal_linf"], **LAW)
    rate.set_yscale("log")
    rate.set_xscale("log")
    rate.set_xlim(left=0.9 * start)
    rate.xaxis.set_minor_formatter(NullFormatter())
    linf.set_ylim(bottom=0)
    named = {
        rate: r"$(\ell^2)^2 / \tau$",
        rest: r"$(\ell^2)^2$ / law - 1 (%)",
        exponents: r"exponent of $\tau$ in $\ell^2$",
        linf: NORMS["linf"],
    }
    for (axes, label), letter in zip(named.items(), "abcd", strict=True):
        axes.set_ylabel(label)
        axes.set_title(f"({letter})", loc="left", fontsize=8)
    for axes in (exponents, linf):
        axes.set_xlabel(r"$\tau$")
    handles, labels = rate.get_legend_handles_labels()
    bar = Line2D([], [], color="0.3", marker="|", ms=9, mew=0.9, lw=0)
    handles += [Line2D([], [], **LAW), Line2D([], [], **OFFSET), Patch(color="0.75"), bar]
    labels += ["law: thermal state up to the front", "law plus a fitted constant"]
    labels += ["range of the ensemble", "95 % confidence interval of the mean"]
    figure.legend(handles, labels, loc="outside upper center", ncols=3, columnspacing=1.4)
    return figure


def _shade(axes: Axes, tau: xr.DataArray, bands: xr.DataArray, look: dict) -> None:
    low, high = (bands.sel(band=bound) for bound in ("lowest", "highest"))
    axes.fill_between(tau, low, high, color=look["color"], alpha=0.3, lw=0)


def _draw_rest(axes: Axes, one: xr.Dataset, colour: str) -> None:
    """Draw by how many per cent l2^2 of a case differs from its law."""
    off = 100.0 * (one["l2_rate"] / one["law_rate"] - 1.0)
    _shade(axes, one["span_tau"], off, {"color": colour})
    axes.plot(one["span_tau"], 100.0 * one["offset_rate"] / one["law_rate"], **OFFSET)
    bars = 100.0 * one["rate_limits"] / one["law_rate"]
    dots = {"color": colour, "marker": "o", "ms": 2.5, "lw": 0, "elinewidth": 0.9}
    axes.errorbar(one["span_tau"], off.sel(band="mean"), bars, **dots)


def gather_window_map(
    maps: list[xr.Dataset], sweeps: list[str], paper_ends: list[float]
) -> xr.Dataset:
    """Return the maps of `sweeps`: lowest, mean and highest value over each ensemble.

    `paper_ends` are the ends T of the paper's windows [10, T], one a sweep; NaN stands for one that
    lies beyond the map.
    """
    found = []
    for data in maps:
        both = data[["l2", "linf"]]
        parts = [both.min("member"), both.mean("member"), both.max("member")]
        words = {"long_name": "value over the members of the ensemble"}
        panel = xr.concat(parts, xr.Variable("band", ["lowest", "mean", "highest"], words))
        for name in both:
            panel[name].attrs = both[name].attrs
        panel = panel.assign(predicted_speed=data["predicted_speed"], pulled=data["pulled"])
        found.append(panel.assign_attrs(data.attrs))
    joined = style.join(found, sweeps, "sweep")
    ends = np.where(np.array(paper_ends) <= float(joined["end"][-1]), paper_ends, np.nan)
    return joined.assign(paper_end=("sweep", ends, {"long_name": "end of the paper's window"}))


@style.styled
def draw_window_map(data: xr.Dataset) -> Figure:
    """Draw a column for each sweep: the map of l2 above, maxima at two ends T below.

    Each map has colours of its own, since a map of what hardly changes would show nothing in those
    of one that grows a hundredfold.
    """
    figure = style.new_figure(style.DOUBLE, 4.9)
    grid = figure.subplots(2, data.sizes["sweep"], sharex=True, sharey="row").reshape(2, -1)
    letters = iter("abcdefgh")
    for (above, below), sweep in zip(grid.T, data["sweep"].values, strict=True):
        one = data.sel(sweep=sweep)
        mesh = _draw_map(above, one, f"({next(letters)})")
        bar = figure.colorbar(mesh, ax=above, location="bottom", pad=0.04, aspect=16)
        bar.ax.tick_params(labelsize=7, length=2)
        bar.locator = MaxNLocator(3)
        bar.set_label(r"maximal $\ell^2$")
        _draw_at_ends(below, one)
        for axes in (above, below):
            panels.half_width_axis(axes, [10, 100, 1000])
            axes.set_xlim(*_log_edges(one)[[0, -1]])
    for axes in grid[1]:
        axes.set_title(f"({next(letters)})", loc="left")
    grid[0, 0].set_ylabel("end $T$ of the window $[10, T]$")
    grid[1, 0].set_ylabel("maximal norm of $(A, B)$")
    figure.legend(handles=_legend(data), loc="outside lower center", ncols=4, columnspacing=1.2)
    return figure


OUTLINED = [withStroke(linewidth=2.2, foreground="black")]
"""So that white lines and words are seen on bright colours too."""


def _draw_map(axes: Axes, one: xr.Dataset, letter: str) -> QuadMesh:
    values = one["l2"].sel(band="mean").transpose("end", "half_width")
    ends, half = one["end"].values, 0.5 * float(one["end"][1] - one["end"][0])
    edges = np.append(ends - half, ends[-1] + half)
    mesh = axes.pcolormesh(_log_edges(one), edges, values, cmap="viridis")
    axes.set_ylim(edges[0], edges[-1])
    look = {"color": "white", "lw": 1.1, "path_effects": OUTLINED}
    way = float(one["predicted_speed"]) * ends
    axes.plot(way, ends, ls="-" if one["pulled"] else (0, (1, 1)), **look)
    if one["paper_end"].notnull():
        axes.axhline(float(one["paper_end"]), ls=(0, (4, 2)), **look)
        axes.annotate(
            "the paper", (0.97, float(one["paper_end"])), (0, 3), ("axes fraction", "data"),
            "offset points", ha="right", color="white", fontsize=7, path_effects=OUTLINED,
        )  # fmt: skip
    axes.set_title(f"{letter} {style.name_case(one)}".replace(",  ", "\n"), loc="left")
    return mesh


def _log_edges(one: xr.Dataset) -> np.ndarray:
    """Return the edges of cells around half-widths on a logarithmic axis."""
    widths = one["half_width"].values
    inner = np.sqrt(widths[1:] * widths[:-1])
    return np.array([widths[0] * widths[0] / inner[0], *inner, widths[-1] * widths[-1] / inner[-1]])


def _draw_at_ends(axes: Axes, one: xr.Dataset) -> None:
    ends = ((float(one["paper_end"]), True), (float(one["end"][-1]), False))
    for end, fill in ends if one["paper_end"].notnull() else ends[1:]:
        maxima = one.sel(end=end, method="nearest")
        for name in NORMS:
            low, middle, high = maxima[name].transpose("band", ...).values
            errors = np.abs(np.array([low, high]) - middle)
            axes.errorbar(one["half_width"], middle, errors, elinewidth=0.8, **_mark(name, fill))
        axes.axvline(float(one["predicted_speed"]) * end, **_line(fill, bool(one["pulled"])))
    axes.set_yscale("log")
    axes.set_xlabel("half-width $M$")


def _mark(name: str, fill: bool) -> dict:
    colour = style.COLOURS[name]
    dots = {"marker": panels.MARKERS[name], "ms": 3.2, "mfc": colour if fill else "white"}
    return {"color": colour, "mew": 0.7, "lw": 0.6, **dots}


def _line(fill: bool, pulled: bool) -> dict:
    """Return the look of M = v T, where v is a front's speed or that of the fastest waves."""
    dashes = {(True, True): (0, (4, 2)), (False, True): "-", (True, False): (0, (1, 1.6)),
              (False, False): (0, (4, 1.2, 1, 1.2))}  # fmt: skip
    return {"color": "0.35" if pulled else "0.55", "lw": 0.9, "ls": dashes[fill, pulled]}


def _legend(data: xr.Dataset) -> list[Line2D]:
    ends = [(True, "the paper's $T$"), (False, f"$T = {float(data['end'][-1]):g}$")]
    if data["paper_end"].isnull().all():
        del ends[0]
    looks = [(NORMS[name], partial(_mark, name)) for name in NORMS]
    looks += [("front at $M$", partial(_line, pulled=True))]
    looks += [("waves at $M$", partial(_line, pulled=False))]
    return [
        Line2D([], [], label=f"{label}, {text}", **look(fill))
        for label, look in looks
        for fill, text in ends
    ]
