"""First passages of the pendula over the top, in a picture."""

import numpy as np
import xarray as xr
from latticode.drawing import style
from matplotlib import colormaps
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import NullLocator

MARKS = "osD^vPX*"
COLOURS = colormaps["viridis"]
BESIDE = 0.025
"""Confidence limits at the end stand so far beside each other, as a part of the time."""
TOP_CAPTION = (
    "Pendula at Ω = {omega} by μ. (a): share of the runs in which a pendulum has gone over the top "
    "by τ, with confidence intervals at the end. (b): the largest angle of any pendulum so far, as "
    "a mean over the runs; the top is at half a turn (dashed)."
)


def gather_over_the_top(over_the_top: xr.Dataset):
    """Return by mu how many members have gone over the top, and how far pendula turn."""
    turns = (over_the_top["angle_so_far"] / (2.0 * np.pi)).mean("member", skipna=False)
    shown = {name: over_the_top[name] for name in ("passed", "passed_low", "passed_high")}
    shown["turns"] = turns.assign_attrs(
        long_name="largest angle of any pendulum so far in turns, mean over the members", units="1"
    )
    omega = over_the_top.attrs["omega"]
    caption = TOP_CAPTION.format(omega=f"{float(omega):g}")
    return xr.Dataset(shown, attrs={"omega": omega, "caption": caption})


@style.styled
def draw_over_the_top(data: xr.Dataset) -> Figure:
    """Draw the share that has passed, and the angles."""
    figure = style.new_figure(style.WIDTH, 2.5)
    passed, turns = figure.subplots(1, 2)
    count = data.sizes["mu"]
    colours = [COLOURS(0.95 * i / max(1, count - 1)) for i in range(count)]
    looks = [{"color": colour, "marker": MARKS[i % len(MARKS)], "markersize": 3}
             for i, colour in enumerate(colours)]  # fmt: skip
    _draw_passed(passed, data, looks)
    for mu, look in zip(data["mu"].values, looks, strict=True):
        named = look | {"label": rf"$\mu = {mu:g}$", "markevery": 0.1, "lw": 1.3}
        turns.plot(data["tau"], data["turns"].sel(mu=mu), **named)
    turns.axhline(0.5, color="0.6", dashes=(4, 2), zorder=1)
    turns.set(xscale="log", yscale="log", xlabel=r"$\tau$", ylabel="largest angle (turns)")
    turns.set_xlim(1.0, float(data["tau"].max()))
    turns.yaxis.set_minor_locator(NullLocator())
    turns.set_title("(b) largest angle so far (dashed: the top)", loc="left")
    style.name_legend(figure, turns)
    return figure


def _draw_passed(axes: Axes, data: xr.Dataset, looks: list[dict]) -> None:
    """Draw the share that has gone over the top, with limits at the end."""
    tau = data["tau"].values
    for i, look in enumerate(looks):
        one = data.isel(mu=i)
        axes.step(tau, one["passed"], where="post", lw=1.3, color=look["color"])
        last, low, high = (float(one[name][-1]) for name in ("passed", "passed_low", "passed_high"))
        axes.errorbar(tau[-1] * (1.03 + BESIDE * i), last, [[last - low], [high - last]],
                      capsize=1.5, elinewidth=0.9, **look)  # fmt: skip
    axes.set(xlabel=r"$\tau$", ylabel="share of runs")
    axes.set_xlim(0, tau[-1] * (1.03 + BESIDE * data.sizes["mu"]))
    axes.set_ylim(-0.03, 1.05)
    axes.set_title("(a) gone over the top by $\\tau$", loc="left")
