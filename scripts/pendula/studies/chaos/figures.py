"""How long the central pair stays excited, as a picture."""

import numpy as np
import xarray as xr
from latticode.drawing import style
from matplotlib import colormaps
from matplotlib.axes import Axes
from matplotlib.figure import Figure

PAPERS_END = 50.0
"""The paper runs Fig 4 up to this time."""
STROKES = ("-", (0, (5, 1.5)), (0, (1.2, 1.2)), (0, (6, 1.5, 1.2, 1.5)))
CAPTION = (
    "Time of the transition at Ω = {omega}, when the central pair loses its excess of power: "
    "{members} runs from each initial amplitude A₀, with B₀ = {ratio} A₀. (a): share of runs "
    "before the transition against τ, with confidence intervals (bands), for amplitudes at which "
    "its time varies from run to run. (b): median time of the transition, with confidence "
    "intervals (bars). Dashed: the end of the runs of Fig 4."
)


def gather_lifetimes(lifetimes: xr.Dataset) -> xr.Dataset:
    """Return the shares that survive and the median lives, with their limits."""
    ends = ("", "_low", "_high")
    shown = lifetimes[[f"{name}{end}" for name in ("surviving", "median") for end in ends]]
    numbers = {name: f"{float(lifetimes.attrs[name]):g}" for name in ("omega", "members", "ratio")}
    return shown.assign_attrs(caption=CAPTION.format(**numbers))


@style.styled
def draw_lifetimes(data: xr.Dataset) -> Figure:
    """Draw the share that is still excited against tau, and the median life against A_0."""
    figure = style.new_figure(style.WIDTH, 2.2)
    shares, medians = figure.subplots(1, 2)
    _draw_shares(shares, data)
    _draw_medians(medians, data)
    return figure


def _draw_shares(axes: Axes, data: xr.Dataset) -> None:
    """Draw the shares of amplitudes whose lives differ from run to run, each with its limits."""
    tau, end = data["tau"], float(data["tau"][-1])
    differ = (data["median_high"] > data["median_low"]) | ~np.isfinite(data["median"])
    shown = data.isel(start_amplitude=differ.values)
    for k, a0 in enumerate(shown["start_amplitude"].values):
        one = shown.isel(start_amplitude=k)
        colour = colormaps["viridis"](0.85 * k / max(1, shown.sizes["start_amplitude"] - 1))
        band = one["surviving_low"], one["surviving_high"]
        axes.fill_between(tau, *band, step="post", color=colour, alpha=0.15, lw=0)
        axes.step(tau, one["surviving"], where="post", label=f"$A_0 = {a0:g}$",
                  color=colour, lw=1.2, ls=STROKES[k % len(STROKES)])  # fmt: skip
    _mark_end(axes.axvline)
    axes.set(xscale="log", xlim=(1, end), xlabel=r"$\tau$", ylim=(0, 1.03), ylabel="share of runs")
    axes.set_title("(a) centre still excited", loc="left")
    axes.legend(loc="lower left")


def _draw_medians(axes: Axes, data: xr.Dataset) -> None:
    a0, end = data["start_amplitude"].values, float(data["tau"][-1])
    middle, low, high = (data[f"median{part}"].values for part in ("", "_low", "_high"))
    known = np.isfinite(middle)
    above = np.where(np.isfinite(high), high, end)
    bars = np.abs([middle[known] - low[known], above[known] - middle[known]])
    look = {"color": style.BLUE, "linestyle": "none"}
    axes.errorbar(
        a0[known], middle[known], bars, marker="o", markersize=3.5, elinewidth=0.8, capsize=2,
        **look,
    )  # fmt: skip
    if not known.all():
        later = np.where(np.isfinite(low), low, end)[~known]
        axes.plot(a0[~known], later, marker="^", label="lower bound", **look)
    _mark_end(axes.axhline)
    axes.legend(loc="upper left")
    axes.set(yscale="log", xlabel="initial amplitude $A_0$", ylabel=r"median time $\tau$")
    axes.set_title("(b) time of the transition", loc="left")


def _mark_end(line) -> None:
    line(PAPERS_END, color="0.5", lw=0.8, ls="--", label="end of Fig 4")
