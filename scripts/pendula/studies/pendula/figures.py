"""Lemma 1 for the pendula, and how far the expansion (3) is from them, in pictures."""

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.ticker import NullLocator

from pendula.drawing import style
from pendula.numerics.elementary import power

from .claims_remainder import common_end

LOOKS = (("#9ecae1", (1, 0)), ("#4292c6", (5, 1.2)), ("#08519c", (3, 1.2)), ("#041f42", (1.2, 1.2)))
"""Colours and dashes by mu, from light to dark."""
SIDES = (("^", r"$\Omega < 0$: more"), ("v", r"$\Omega > 4\epsilon$: less"))
BY_LEMMA = {"color": style.RED, "lw": 1.8, "alpha": 0.7, "zorder": 1}

COLOURS = {8.0: style.BLUE, -4.0: "#16876b", 0.0: style.RED}
"""By the detuning; other detunings are grey."""
KINDS = {
    "leading": {"ls": "-", "fillstyle": "full"},
    "corrected": {"ls": "--", "fillstyle": "none"},
}
WIDTHS = (0.7, 1.6, 3.0, 4.8)
"""Of lines by mu, the largest first: the wide ones lie behind the narrow ones."""
MARKERS = {"small": "o", "large": "s"}
"""By the size of the initial data, with which the name of a case ends."""


def gather_threshold(threshold: xr.Dataset) -> xr.Dataset:
    """Return thresholds, corrections and rates as they are drawn, and epsilon."""
    drawn = ["gamma_0", "gamma_0_lemma", "correction", "curve_gamma_0", "curve_gamma_0_lemma"]
    drawn += ["wave_rate", "rate_lemma"]
    return threshold[drawn].assign_attrs(epsilon=threshold.attrs["epsilon"])


@style.styled
def draw_threshold(data: xr.Dataset) -> Figure:
    """Draw the chart; below it the shift of the threshold, and rates outside the band."""
    figure = style.new_figure(style.DOUBLE, 4.9)
    highest = 4.0 * data.attrs["epsilon"]
    outside = [float(one) for one in data["growth_omega"].values if not 0.0 <= one <= highest]
    looks = [
        (mu, {"color": colour, "dashes": dashes, "lw": 1.1})
        for mu, (colour, dashes) in zip(data["mu"].values, LOOKS, strict=False)
    ]
    above, below = figure.subfigures(2, 1, height_ratios=(1.15, 1))
    chart = above.subplots()
    _draw_chart(chart, data, looks)
    shift, *rates = below.subplots(1, 1 + len(outside))
    _draw_shift(shift, data)
    for letter, axes, omega in zip("cdef", rates, outside, strict=False):
        one = data.sel(growth_omega=omega)
        axes.plot(one["gamma"], one["rate_lemma"], **BY_LEMMA)
        for mu, look in looks:
            axes.plot(one["gamma"], one["wave_rate"].sel(mu=mu), **look)
        axes.set_xlim(float(one["gamma"][0]), float(one["gamma"][-1]))
        axes.set_ylim(0, None)
        axes.set(xlabel=r"strength of the drive $\gamma$", ylabel=r"rate per unit of $\tau$")
        axes.set_title(rf"({letter}) growth at $\Omega = {omega:g}$", loc="left")
    style.name_legend(figure, chart)
    return figure


def _draw_chart(axes: Axes, data: xr.Dataset, looks: list) -> None:
    curve, lemma = data["curve_omega"].values, data["curve_gamma_0_lemma"].values
    axes.plot(curve, lemma, label="Lemma 1", **BY_LEMMA)
    for mu, look in looks:
        axes.plot(curve, data["curve_gamma_0"].sel(mu=mu), label=rf"$\mu = {mu:g}$", **look)
    middle, low = 2.0 * data.attrs["epsilon"], 0.22 * lemma.max()
    axes.text(middle, low, "unstable with\nany drive", ha="center", fontsize=7.5)
    taken = ((data["curve_gamma_0"] == 0.0) & (data["curve_gamma_0_lemma"] > 0.0)).any("mu").values
    if taken.any():
        axes.text(curve[taken].max() + 0.25, low, "second resonance", fontsize=7.5)
    axes.set(xlabel=r"detuning $\Omega$", ylabel=r"strength of the drive $\gamma$")
    axes.set_xlim(curve[0], curve[-1])
    axes.set_ylim(0, None)
    axes.set_title(r"(a) threshold $\gamma_0(\mu)$: below the curve the pendula at rest are stable",
                   loc="left")  # fmt: skip


def _draw_shift(axes: Axes, data: xr.Dataset) -> None:
    """Draw the relative shift of each Omega and mu against its first order."""
    lemma, mu = data["gamma_0_lemma"], data["mu"]
    first = (data["correction"] / lemma * mu * mu).where(lemma > 0)
    shift = data["gamma_0"] / lemma - 1.0
    sizes = abs(first.values[np.isfinite(first.values)])
    ends = np.array([0.6 * sizes.min(), 1.5 * sizes.max()])
    axes.plot(ends, ends, **BY_LEMMA)
    for sign, (marker, label) in zip((1.0, -1.0), SIDES, strict=True):
        some = (sign * first.values > 0) & (sign * shift.values > 0)
        axes.plot(abs(first.values[some]), abs(shift.values[some]), marker, label=label,
                  color="0.25", markersize=3, markerfacecolor="none", lw=0)  # fmt: skip
    axes.set(xscale="log", yscale="log", xlabel=r"$\gamma_0 \mu^2 / 4$")
    axes.set_ylabel(r"$|\gamma_0(\mu) / \gamma_0 - 1|$")
    _without_minor_ticks(axes)
    axes.legend(fontsize=7, handletextpad=0.2)
    axes.set_title("(b) distance from Lemma 1", loc="left")


def _without_minor_ticks(axes: Axes) -> None:
    """Leave out the small ticks of several decades, which take time."""
    for axis in (axes.xaxis, axes.yaxis):
        axis.set_minor_locator(NullLocator())


# --- The expansion -------------------------------------------------------------------------------


def gather_remainder(remainder: xr.Dataset) -> xr.Dataset:
    """Return errors, orders and horizons as they are drawn."""
    shown = remainder[["error", "order", "visible_from", "omega"]]
    return shown.assign_attrs(common_end=common_end(remainder))


@style.styled
def draw_remainder(data: xr.Dataset) -> Figure:
    """Draw errors against mu, the remainder against time, and horizons against mu."""
    figure = style.new_figure(style.DOUBLE, 3.1)
    order, growth, horizon = figure.subplots(1, 3)
    looks = {}
    for case, omega in zip(data["case"].values, data["omega"].values, strict=True):
        marker = MARKERS.get(case.rpartition("_")[2], "^")
        looks[str(case)] = {"color": COLOURS.get(float(omega), "0.5"), "marker": marker}
        looks[str(case)]["markersize"] = 3.2
    _draw_orders(order, data, looks)
    _draw_growth(growth, data, looks)
    _draw_horizons(horizon, data, looks)
    lines = [
        Line2D([], [], color=COLOURS.get(one, "0.5"), lw=2.0, label=rf"$\Omega = {one:g}$")
        for one in dict.fromkeys(data["omega"].values)
    ]
    lines += [
        Line2D([], [], color="0.3", ls="", marker=MARKERS.get(size, "^"), markersize=4, label=size)
        for size in dict.fromkeys(case.rpartition("_")[2] for case in looks)
    ]
    kinds = [
        Line2D([], [], color="0.3", lw=1.2, marker="o", markersize=4, label=name, **kind)
        for name, kind in KINDS.items()
    ]
    figure.legend(handles=lines, loc="outside upper left", ncols=len(lines))
    figure.legend(handles=kinds, loc="outside upper right", ncols=len(kinds))
    return figure


def _draw_orders(axes: Axes, data: xr.Dataset, looks: dict) -> None:
    """Draw the error up to the end of the shortest run against mu, and two slopes."""
    end, mu = data.attrs["common_end"], data["mu"].values
    errors = data["error"].sel(end=end)
    for case, look in looks.items():
        for expansion, kind in KINDS.items():
            error = errors.sel(case=case, expansion=expansion)
            axes.loglog(mu, error, lw=0.8, **look, **kind)
    at = mu[-3:]
    for order, expansion, above in ((3.0, "leading", True), (5.0, "corrected", False)):
        first = errors.sel(expansion=expansion, mu=at[0])
        start = float(3.0 * first.max() if above else first.min() / 4.0)
        slope = start * power(at / at[0], order)
        axes.loglog(at, slope, color="0.4", lw=1.0, ls=":")
        place = {"ha": "right", "va": "bottom"} if above else {"ha": "left", "va": "top"}
        axes.annotate(rf"$\mu^{order:g}$", (at[1], slope[1]), **place)
    axes.set(xlabel=r"$\mu$", ylabel="largest error of an angle, rad")
    _name_mus(axes, mu)
    axes.set_title(rf"(a) up to $\tau = {end:g}$", loc="left")


def _draw_growth(axes: Axes, data: xr.Dataset, looks: dict) -> None:
    """Draw the error of (3) over mu^3 against time, from the small data, each mu to its end."""
    errors = data["error"].sel(expansion="leading")
    lines = [
        (mu, {"lw": width, "alpha": alpha})
        for mu, width, alpha in zip(
            data["mu"].values[2:], WIDTHS, np.linspace(1.0, 0.35, len(WIDTHS)), strict=False
        )
    ]
    for case in [case for case in looks if case.endswith("small")]:
        for mu, line in lines:
            error = errors.sel(case=case, mu=mu) / (mu * mu * mu)
            axes.loglog(data["end"], error, color=looks[case]["color"], zorder=2.0 + mu, **line)
    named = [Line2D([], [], color="0.2", label=rf"$\mu = {mu:g}$", **line) for mu, line in lines]
    axes.legend(handles=named, loc="upper left", fontsize=7)
    axes.set(xlabel=r"slow time $\tau$", ylabel=r"error of (3) over $\mu^3$, rad")
    _without_minor_ticks(axes)
    axes.set_title("(b) small initial amplitudes", loc="left")


def _draw_horizons(axes: Axes, data: xr.Dataset, looks: dict) -> None:
    """Draw when the error becomes visible at Omega = 0; what is beyond a run is left out."""
    for case in [case for case in looks if data["omega"].sel(case=case) == 0.0]:
        for expansion, kind in KINDS.items():
            horizon = data["visible_from"].sel(case=case, expansion=expansion).values
            shown = np.where(np.isfinite(horizon), horizon, np.nan)
            axes.semilogx(data["mu"], shown, lw=0.8, **looks[case], **kind)
    axes.set(xlabel=r"$\mu$", ylabel=r"slow time $\tau$ at which the error is visible")
    axes.set_ylim(-0.03 * axes.get_ylim()[1], None)  # all of the marks at zero
    _name_mus(axes, data["mu"].values)
    axes.set_title(r"(c) $\Omega = 0$", loc="left")


def _name_mus(axes: Axes, mus: np.ndarray) -> None:
    """Put a tick at each mu, and a number at every second one."""
    axes.set_xticks(mus[::2], [f"{mu:g}" for mu in mus[::2]])
    axes.set_xticks(mus[1::2], minor=True)
    axes.set_xticklabels([""] * len(mus[1::2]), minor=True)
