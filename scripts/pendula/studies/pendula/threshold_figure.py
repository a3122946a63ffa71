"""Lemma 1 for the pendula in a picture: the chart, how it differs from Lemma 1's, and growth."""

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from pendula.drawing import style

LOOKS = (("#9ecae1", (1, 0)), ("#4292c6", (5, 1.2)), ("#08519c", (3, 1.2)), ("#041f42", (1.2, 1.2)))
"""Colours and dashes by mu, from light to dark."""
SIDES = {-1.0: ("s", r"$\Omega < 0$"), 1.0: ("o", r"$\Omega > 4\epsilon$")}
DRAWN = (
    *("gamma_0", "gamma_0_lemma", "correction", "curve_gamma_0", "curve_gamma_0_lemma"),
    *("rate", "rate_lemma"),
)
BY_LEMMA = {"color": style.RED, "lw": 1.0}


def gather_threshold(threshold: xr.Dataset) -> xr.Dataset:
    """Return thresholds, corrections and rates as they are drawn, and epsilon."""
    return threshold[list(DRAWN)].assign_attrs(epsilon=threshold.attrs["epsilon"])


@style.styled
def draw_threshold(data: xr.Dataset) -> Figure:
    """Draw the chart, and below it the shift of the threshold and rates of growth."""
    figure = style.new_figure(style.DOUBLE, 4.9)
    panels = figure.subplot_mosaic([["chart", "chart"], ["shift", "rate"]])
    _draw_chart(panels["chart"], data)
    _draw_shift(panels["shift"], data)
    _draw_rates(panels["rate"], data)
    style.name_legend(figure, panels["chart"])
    return figure


def _by_mu(data: xr.Dataset):
    return zip(data["mu"].values, LOOKS, strict=False)


def _draw_chart(axes: Axes, data: xr.Dataset) -> None:
    curve = data["curve_omega"].values
    lemma = data["curve_gamma_0_lemma"].values
    axes.plot(curve, lemma, label="Lemma 1", zorder=1, color=style.RED, lw=2.2, alpha=0.6)
    for mu, (colour, dashes) in _by_mu(data):
        values = data["curve_gamma_0"].sel(mu=mu)
        look = {"color": colour, "dashes": dashes, "lw": 1.1}
        axes.plot(curve, values, label=rf"$\mu = {mu:g}$", **look)
    axes.text(2.0 * data.attrs["epsilon"], 0.35 * lemma.max(), "unstable\nfor every drive",
              ha="center", va="center", fontsize=7.5)  # fmt: skip
    axes.set(xlabel=r"detuning $\Omega$", ylabel=r"threshold $\gamma_0(\mu)$")
    axes.set_xlim(curve[0], curve[-1])
    axes.set_ylim(0, None)
    axes.set_title("(a) largest drive at which all waves are stable", loc="left")


def _draw_shift(axes: Axes, data: xr.Dataset) -> None:
    """Draw the relative shift over mu^2 gamma_0 / 4, its first order, which is 1 on both sides."""
    lemma = data["gamma_0_lemma"]
    outside = (lemma > 0).values
    mu = data["mu"].values
    for omega in data["omega"].values[outside]:
        one = data.sel(omega=omega)
        first = float(one["correction"]) * mu * mu
        shift = (one["gamma_0"].values - float(one["gamma_0_lemma"])) / first
        marker = SIDES[np.sign(omega)][0]
        axes.plot(mu, shift, color="0.6", lw=0.7, marker=marker, markersize=3)
    axes.axhline(1.0, **BY_LEMMA)
    axes.set(xlabel=r"$\mu$", ylabel="shift over its first order")


def _draw_rates(axes: Axes, data: xr.Dataset) -> None:
    gamma = data["gamma"].values
    for omega in data["growth_omega"].values:
        one = data.sel(growth_omega=omega)
        axes.plot(gamma, one["rate_lemma"], **BY_LEMMA)
        for mu, (colour, dashes) in _by_mu(data):
            axes.plot(gamma, one["rate"].sel(mu=mu), color=colour, dashes=dashes, lw=1.1)
    axes.set(xlabel=r"strength of the drive $\gamma$", ylabel=r"growth rate per unit of $\tau$")
