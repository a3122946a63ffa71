"""Lemma 1 for the pendula in a picture: the chart, how it differs from Lemma 1's, and growth."""

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import NullLocator

from pendula.drawing import style

LOOKS = (("#9ecae1", (1, 0)), ("#4292c6", (5, 1.2)), ("#08519c", (3, 1.2)), ("#041f42", (1.2, 1.2)))
"""Colours and dashes by mu, from light to dark."""
SIDES = (("^", r"$\Omega < 0$: more"), ("v", r"$\Omega > 4\epsilon$: less"))
BY_LEMMA = {"color": style.RED, "lw": 1.8, "alpha": 0.7, "zorder": 1}
DRAWN = (
    *("gamma_0", "gamma_0_lemma", "correction", "curve_gamma_0", "curve_gamma_0_lemma"),
    *("wave_rate", "rate_lemma"),
)


def gather_threshold(threshold: xr.Dataset) -> xr.Dataset:
    """Return thresholds, corrections and rates as they are drawn, and epsilon."""
    return threshold[list(DRAWN)].assign_attrs(epsilon=threshold.attrs["epsilon"])


@style.styled
def draw_threshold(data: xr.Dataset) -> Figure:
    """Draw the chart; below it the shift of the threshold, and rates outside the band."""
    figure = style.new_figure(style.DOUBLE, 4.9)
    outside = [float(omega) for omega in data["growth_omega"].values if _is_outside(data, omega)]
    above, below = figure.subfigures(2, 1, height_ratios=(1.15, 1))
    chart = above.subplots()
    _draw_chart(chart, data)
    shift, *rates = below.subplots(1, 1 + len(outside))
    _draw_shift(shift, data)
    for letter, axes, omega in zip("cdef", rates, outside, strict=False):
        _draw_rates(axes, data.sel(growth_omega=omega))
        axes.set_title(rf"({letter}) growth at $\Omega = {omega:g}$", loc="left")
    style.name_legend(figure, chart)
    return figure


def _is_outside(data: xr.Dataset, omega: float) -> bool:
    return not 0.0 <= omega <= 4.0 * data.attrs["epsilon"]


def _draw_chart(axes: Axes, data: xr.Dataset) -> None:
    curve, lemma = data["curve_omega"].values, data["curve_gamma_0_lemma"].values
    axes.plot(curve, lemma, label="Lemma 1", **BY_LEMMA)
    for mu, look in _by_mu(data):
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


def _by_mu(data: xr.Dataset):
    for mu, (colour, dashes) in zip(data["mu"].values, LOOKS, strict=False):
        yield mu, {"color": colour, "dashes": dashes, "lw": 1.1}


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
    for axis in (axes.xaxis, axes.yaxis):
        axis.set_minor_locator(NullLocator())  # several decades, whose ticks take time
    axes.legend(fontsize=7, handletextpad=0.2)
    axes.set_title("(b) distance from Lemma 1", loc="left")


def _draw_rates(axes: Axes, data: xr.Dataset) -> None:
    gamma = data["gamma"].values
    axes.plot(gamma, data["rate_lemma"], **BY_LEMMA)
    for mu, look in _by_mu(data):
        axes.plot(gamma, data["wave_rate"].sel(mu=mu), **look)
    axes.set_xlim(gamma[0], gamma[-1])
    axes.set_ylim(0, None)
    axes.set(xlabel=r"strength of the drive $\gamma$", ylabel=r"rate per unit of $\tau$")
