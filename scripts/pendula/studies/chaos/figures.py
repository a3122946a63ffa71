"""How long the central pair stays excited, as a picture."""

import numpy as np
import xarray as xr
from latticode.drawing import style
from matplotlib.figure import Figure

PAPERS_END = 50.0
"""The paper runs Fig 4 up to this time."""
CAPTION = (
    "Time of the transition at Ω = {omega}, when the central pair loses its excess of power, "
    "against its initial amplitude A₀, with B₀ = {ratio} A₀: {members} runs from each (dots), and "
    "their median with its confidence interval. Runs without a transition by τ = {end_time} stand "
    "at this time. Dashed: the end of the runs of Fig 4."
)


def gather_lifetimes(lifetimes: xr.Dataset) -> xr.Dataset:
    """Return the lives and their medians with their limits."""
    shown = lifetimes[["life", "median", "median_low", "median_high"]]
    said = ("omega", "members", "ratio", "end_time")
    numbers = {name: f"{float(lifetimes.attrs[name]):g}" for name in said}
    about = {"long_name": "end of the runs", "units": "1"}
    ended = shown.assign(end=((), float(lifetimes.attrs["end_time"]), about))
    return ended.assign_attrs(caption=CAPTION.format(**numbers))


@style.styled
def draw_lifetimes(data: xr.Dataset) -> Figure:
    """Draw the lives against A_0, their medians, and as an arrow that a median is after the end."""
    figure, end = style.new_figure(0.6 * style.WIDTH, 2.2), float(data["end"])
    axes, a0 = figure.subplots(), data["start_amplitude"].values
    lives = np.minimum(data["life"].transpose("start_amplitude", "member").values, end)
    axes.plot(a0, lives, ".", color=style.PALE[style.BLUE], markersize=3)
    middle, low, high = (
        np.minimum(data[f"median{part}"].values, end) for part in ("", "_low", "_high")
    )
    known = np.isfinite(data["median"].values)
    bars = np.abs([middle - low, high - middle])[:, known]
    look = {"color": style.BLUE, "linestyle": "none", "markersize": 3.5}
    label = "median"
    axes.errorbar(
        a0[known], middle[known], bars, marker="o", elinewidth=0.8, capsize=2, label=label, **look
    )
    if not known.all():
        axes.plot(a0[~known], low[~known], marker="^", label="lower bound of the median", **look)
    axes.axhline(PAPERS_END, color="0.5", lw=0.8, ls="--", label="end of Fig 4")
    axes.legend(loc="lower right")
    axes.set(yscale="log", xlabel="initial amplitude $A_0$", ylabel=r"time $\tau$")
    return figure
