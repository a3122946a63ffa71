"""Infinite chains in pictures: norms against time, and the exponents that they follow."""

import numpy as np
import xarray as xr
from latticode.drawing import panels, style
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from matplotlib.ticker import NullFormatter

from pendula.drawing import name_case

LOOKS = {
    "fig4_small": {"color": style.RED, "ls": "-", "lw": 1.1},
    "fig3_large": {"color": style.BLUE, "ls": "-", "lw": 1.1},
    "fig2_large": {"color": "#16876b", "ls": "--", "lw": 1.1},
    "fig3_small": {"color": "#b07800", "ls": ":", "lw": 1.1},
}
LAW = {"color": "black", "lw": 0.9, "ls": (0, (4, 2))}
OFFSET = {"color": "black", "lw": 0.8, "ls": ":"}
CAPTION = (
    "The infinite chain against τ. (a): the square of the ℓ² norm divided by τ. (b): its relative "
    "deviation from the predicted law. (c): the exponent of τ in the ℓ² norm over each doubling of "
    "τ, with a line at 1/2. (d): the ℓ∞ norm. The dashed law is predicted from the thermal states "
    "behind the two fronts and the predicted speeds of these, without a fit. The dotted line adds "
    "a fitted constant to the square of the norm. Bands reach from the lowest to the highest run "
    "of an ensemble; bars are confidence intervals of the mean."
)


def gather_growth_law(growth: xr.Dataset) -> xr.Dataset:
    """Return what `measured.measure_growth` has made."""
    return growth.assign_attrs(caption=CAPTION)


@style.styled
def draw_growth_law(data: xr.Dataset) -> Figure:
    """Draw l2^2 / tau beside its law, what is left over, exponents over octaves, l-infinity."""
    figure = style.new_figure(style.WIDTH, 3.8)
    (rate, rest), (exponents, linf) = figure.subplots(2, 2, sharex=True)
    rest.axhline(0.0, **LAW)
    exponents.axhline(0.5, color="black", lw=0.8)
    start = float(data["span_tau"].min())
    for i, case in enumerate(data["case"].values):
        one, look = data.sel(case=case), LOOKS[str(case)]
        rate.plot(one["span_tau"], one["l2_rate"].sel(band="mean"), label=name_case(one), **look)
        _shade(rate, one["span_tau"], one["l2_rate"], look)
        rate.plot(one["span_tau"], one["law_rate"], **LAW)
        if np.isfinite(one["law_rate"]).any():
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
        rate: r"squared $\ell^2$ norm / $\tau$",
        rest: "deviation from law (%)",
        exponents: r"exponent of $\ell^2$ norm",
        linf: rf"{panels.NORMS['linf']} norm",
    }
    for (axes, label), letter in zip(named.items(), "abcd", strict=True):
        axes.set_ylabel(label)
        axes.set_title(f"({letter})", loc="left")
    for axes in (exponents, linf):
        axes.set_xlabel(r"$\tau$")
    handles, labels = rate.get_legend_handles_labels()
    bar = Line2D([], [], color="0.3", marker="|", ms=9, mew=0.9, lw=0)
    handles += [Line2D([], [], **LAW), Line2D([], [], **OFFSET), Patch(color="0.75"), bar]
    labels += ["law in the text", "law plus a fitted constant"]
    labels += ["range of the ensemble", "95 % confidence interval"]
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
