"""The figure of the transition at Omega = 0: its two times, and the share of P on the centre."""

import numpy as np
import xarray as xr
from latticode.drawing import style
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from .clocks import limits_of

PAPERS_END = 50.0
"""The end time of the paper's Fig 4."""
CLOCKS = {"transition": (style.BLUE, "o", -0.12), "life": (style.RED, "s", 0.12)}
"""Colour, mark and horizontal offset of each time."""
WORDS = {
    "middle": "median or mean of the",
    "low": "lower confidence limit of the",
    "high": "upper confidence limit of the",
}
LATER = "end of the runs, which comes before the"
OPEN = "end of the runs, which comes before the upper confidence limit of the"
CAPTION = (
    "(a) At Ω = {omega}, against the initial amplitude A₀, with B₀ = {ratio} A₀: the time at which "
    "P of the chain first reaches half of its final value, and the time at which the central pair "
    "first holds at most the mean power of a pair. (b) Share of P on the central pair, mean over "
    "[{window_start}, {window_end}], and the mean share of a pair (dotted). Pale: {members} runs "
    "from each A₀, perturbed by {perturbation}. Dark: medians in (a) and means in (b), with "
    "confidence intervals; an arrow means that the upper limit is later than the end of the runs. "
    "If the centre keeps more than the mean power until τ = {end_time}, the run is drawn there."
)


def gather_lifetimes(lifetimes: xr.Dataset) -> xr.Dataset:
    """Return times and shares of the runs, and their medians or means with confidence limits.

    Times later than the end of the runs are drawn at the end. Such medians and upper limits have
    their own rows, so the figure always has the same curves.
    """
    names, end = [*CLOCKS, "centre_share"], float(lifetimes.attrs["end_time"])
    drawn, limits = lifetimes[names].clip(max=end, keep_attrs=True), limits_of(lifetimes)
    for name in names:
        has_ended = limits[name].value < end
        rows = dict(zip(WORDS, limits[name], strict=True))
        rows |= {"middle": np.where(has_ended, rows["middle"], np.nan)}
        if name in CLOCKS:
            is_open = has_ended & (rows["high"] > end)
            rows |= {"later": np.where(has_ended, np.nan, end)}
            rows |= {"open": np.where(is_open, end, np.nan)}
            # a bar without an upper end stops at its mark: see `_draw_open_limits`
            rows |= {"high": np.where(is_open, rows["middle"], rows["high"])}
        for word, values in rows.items():
            meaning = (WORDS | {"later": LATER, "open": OPEN})[word]
            attributes = {"long_name": f"{meaning} {name.replace('_', ' ')}"}
            row = "start_amplitude", np.minimum(values, end), attributes
            drawn = drawn.assign({f"{name}_{word}": row})
    keys = ("omega", "members", "ratio", "end_time", "window_start", "window_end", "perturbation")
    numbers = {key: f"{float(lifetimes.attrs[key]):g}" for key in keys}
    pairs = 2 * int(lifetimes.attrs["half_width"]) + 1
    drawn = drawn.assign(pairs=((), pairs, {"long_name": "number of pairs"}))
    return drawn.assign_attrs(caption=CAPTION.format(**numbers))


@style.styled
def draw_lifetimes(data: xr.Dataset) -> Figure:
    """Draw both times against A_0 on the left, and the centre's share of P on the right."""
    figure = style.new_figure(style.WIDTH, 2.5)
    left, right = figure.subplots(1, 2, width_ratios=(1.25, 1.0))
    for name, label in (("transition", "chain"), ("life", "central pair")):
        _draw_runs(left, data, name, *CLOCKS[name], label)
        _draw_open_limits(left, data, name)
        colour, _, aside = CLOCKS[name]
        a0, later = data["start_amplitude"].values + aside, data[f"{name}_later"].values
        open_marks = {"markerfacecolor": "white", "markersize": 4.5}
        label_of_open = "median after the runs" if name == "life" else None
        left.plot(a0, later, "^", color=colour, label=label_of_open, **open_marks)
    left.axhline(PAPERS_END, color="0.5", lw=0.8, ls="--", label="end of Fig 4")
    left.set(yscale="log", ylabel=r"time $\tau$", ymargin=0.08)
    left.yaxis.set_major_formatter("{x:g}")
    _draw_runs(right, data, "centre_share", style.RED, "s", 0.0)
    right.axhline(1.0 / float(data["pairs"]), color="0.5", lw=0.8, ls=":", label="$1 / N$")
    right.set(ylabel="share of $P$", ylim=(0.0, None))
    for axes, letter in ((left, "a"), (right, "b")):
        axes.set(xlabel="initial amplitude $A_0$", xticks=data["start_amplitude"].values)
        axes.set_title(f"({letter})", loc="left")
    style.name_legend(figure, left, right, columns=4)
    return figure


def _draw_open_limits(axes: Axes, data: xr.Dataset, name: str) -> None:
    """Draw an arrow to the end of the runs from each median with a later upper limit."""
    colour, _, aside = CLOCKS[name]
    a0, middle = data["start_amplitude"].values + aside, data[f"{name}_middle"].values
    rise = data[f"{name}_open"].values - middle
    axes.errorbar(a0, middle, rise, lolims=True, color=colour, ls="none", elinewidth=0.8)


def _draw_runs(
    axes: Axes,
    data: xr.Dataset,
    name: str,
    colour: str,
    mark: str,
    aside: float,
    label: str | None = None,
) -> None:
    """Draw one number of all runs as small marks, and its median or mean with limits."""
    a0 = data["start_amplitude"].values + aside
    runs = data[name].transpose("start_amplitude", "member").values
    label_of_runs = f"single runs, {label}" if label else None
    axes.plot(a0, runs, ".", color=style.PALE[colour], markersize=2.5, label=label_of_runs)
    middle, low, high = (data[f"{name}_{word}"].values for word in WORDS)
    axes.errorbar(
        a0,
        middle,
        np.array([middle - low, high - middle]),
        marker=mark,
        color=colour,
        ls="none",
        elinewidth=0.8,
        capsize=2,
        markersize=3.5,
        label=label,
    )
