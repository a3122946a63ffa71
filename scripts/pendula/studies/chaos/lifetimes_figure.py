"""How long the central pendulum stays localised, in a picture: survival, and median lives."""

import numpy as np
import xarray as xr
from matplotlib import colormaps
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from pendula.drawing import style

DRAWN = ["surviving", "surviving_low", "surviving_high", "median", "median_low", "median_high"]
DRAWN += ["rate", "rate_low", "rate_high"]
COLOURS = colormaps["viridis"]
LINE = 0.075
"""The height of a line of text, as a share."""
BESIDE = 0.18
"""How far the marks of means stand beside those of medians, in units of A_0."""


def gather_lifetimes(lifetimes: xr.Dataset) -> xr.Dataset:
    """Return the shares that survive, median lives and rates, all with their limits."""
    return lifetimes[DRAWN]


@style.styled
def draw_lifetimes(data: xr.Dataset) -> Figure:
    """Draw the share that is still localised against tau, and the life against A_0."""
    figure = style.new_figure(style.DOUBLE, 2.9)
    shares, lives = figure.subplots(1, 2, width_ratios=(1.2, 1))
    _draw_shares(shares, data)
    _draw_lives(lives, data)
    return figure


def _slow(data: xr.Dataset) -> list[int]:
    """Return where the lives of members differ at all: before chaos sets in they are all alike."""
    return [i for i in range(data.sizes["start_amplitude"]) if np.isfinite(data["rate"][i])]


def _draw_shares(axes: Axes, data: xr.Dataset) -> None:
    tau, slow = data["tau"], _slow(data)
    fast = [i for i in range(data.sizes["start_amplitude"]) if i not in slow]
    for i in fast:
        axes.step(tau, data["surviving"][i], where="post", color="0.6", lw=0.8)
    free = -np.inf
    for k, i in enumerate(slow):
        colour = COLOURS(0.85 * k / max(1, len(slow) - 1))
        low, high = data["surviving_low"][i], data["surviving_high"][i]
        axes.fill_between(tau, low, high, step="post", color=colour, alpha=0.15, lw=0)
        axes.step(tau, data["surviving"][i], where="post", color=colour, lw=1.3)
        free = max(free + LINE, float(data["surviving"][i, -1]))
        label = f"$A_0 = {float(data['start_amplitude'][i]):g}$"
        axes.text(1.07 * float(tau[-1]), free, label, color=colour, va="center", fontsize=7)
    if fast:
        words = _range(data["start_amplitude"].values[fast])
        axes.text(0.93 * float(data["median"][fast].min()), 0.04, words, color="0.45", fontsize=7,
                  ha="right")  # fmt: skip
    axes.set_xscale("log")
    axes.set_xlim(1, float(tau[-1]))
    axes.set_ylim(0, 1.03)
    axes.set_xlabel(r"$\tau$")
    axes.set_ylabel("share of runs still localised")
    axes.set_title("(a) runs that have not changed over", loc="left")


def _range(amplitudes: np.ndarray) -> str:
    last = f" to {amplitudes[-1]:g}" if len(amplitudes) > 1 else ""
    return f"$A_0 = {amplitudes[0]:g}${last}"


def _draw_lives(axes: Axes, data: xr.Dataset) -> None:
    a0, end = data["start_amplitude"].values, float(data["tau"][-1])
    middle, low, high = (data[f"median{part}"].values for part in ("", "_low", "_high"))
    known = np.isfinite(middle)
    above = np.where(np.isfinite(high), high, end)
    bars = np.abs([middle[known] - low[known], above[known] - middle[known]])
    look = {"color": style.BLUE, "marker": "o", "markersize": 3.5, "elinewidth": 0.8, "capsize": 2}
    axes.errorbar(a0[known], middle[known], bars, linestyle="none", label="median", **look)
    later = np.where(np.isfinite(low), low, end)
    _draw_bounds(axes, a0[~known], later[~known], style.BLUE, "median at least")
    settled, seen, unseen = data.attrs["settled"], data["rate"].values > 0, data["rate"].values == 0
    rates = (data[f"rate{part}"].values for part in ("", "_high", "_low"))
    value, least, most = (settled + 1.0 / rate[seen] for rate in rates)
    look |= {"color": style.RED, "marker": "s"}
    axes.errorbar(
        a0[seen] + BESIDE, value, [value - least, most - value], linestyle="none",
        label=rf"mean, if localised at $\tau = {settled:g}$", **look,
    )  # fmt: skip
    least = settled + 1.0 / data["rate_high"].values[unseen]
    _draw_bounds(axes, a0[unseen] + BESIDE, least, style.RED, "mean at least")
    axes.set_yscale("log")
    axes.set_xlabel("initial amplitude $A_0$")
    axes.set_ylabel("life, units of $\\tau$")
    axes.set_title("(b) how long it takes", loc="left")
    axes.legend(loc="upper left", handletextpad=0.3)


def _draw_bounds(axes: Axes, a0: np.ndarray, least: np.ndarray, colour: str, label: str) -> None:
    """Draw lower bounds as triangles, if there are any."""
    if a0.size:
        axes.plot(a0, least, color=colour, marker="^", markersize=5, linestyle="none",
                  markerfacecolor="white", label=label)  # fmt: skip
