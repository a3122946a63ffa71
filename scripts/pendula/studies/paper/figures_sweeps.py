"""Figures 5-6: the norms over a window of time against the half-width M of the chain."""

from collections.abc import Sequence

import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.ticker import FixedLocator, NullLocator, StrMethodFormatter

from pendula.drawing import style

NORMS = {"l2": r"$\ell^2$", "linf": r"$\ell^\infty$"}
MARKERS = {"l2": "o", "linf": "s"}  # told apart in grey by their shape too
SIZES = {"text": 3.6, "caption": 2.4}
TICKS = [a * 10**k for k in range(5) for a in (1, 2, 5)]


def gather(
    left: xr.Dataset,
    right: xr.Dataset,
    text_window: str,
    caption_window: str,
    norms: Sequence[str] = ("l2", "linf"),
) -> xr.Dataset:
    """Return the pair's norms of two sweeps: the maximum over one window, the mean over another.

    The paper's text speaks of the maximum, its captions of the average, over windows of their own.
    The windows are named as in the sweeps, such as "[10, 50]"; `norms` are those to be drawn.
    """
    return join_panels({"left": left, "right": right}, text_window, caption_window, norms)


def join_panels(
    sweeps: dict[str, xr.Dataset], text_window: str, caption_window: str, norms: Sequence[str]
) -> xr.Dataset:
    """Return the same of any number of sweeps by the name of their panel."""
    readings = {"text": ("max", text_window), "caption": ("mean", caption_window)}
    panels = [_read(sweep[list(norms)], readings) for sweep in sweeps.values()]
    data = style.join(panels, list(sweeps), "panel", "panel of the figure")
    for name, title in (("statistic", "statistic over the window"), ("window", "window of tau")):
        column = [reading[name == "window"] for reading in readings.values()]
        data[name] = ("reading", column, {"long_name": title, "units": "1"})
    return data


def _read(sweep: xr.Dataset, readings: dict[str, tuple[str, str]]) -> xr.Dataset:
    chosen = [
        sweep.sel(quantity="pair", statistic=statistic, window=window, drop=True)
        for statistic, window in readings.values()
    ]
    title = {"long_name": "reading of the paper", "units": "1"}
    read = xr.concat(chosen, xr.Variable("reading", list(readings), title))
    return read.assign_attrs(sweep.attrs)


@style.styled
def draw(data: xr.Dataset) -> Figure:
    """Draw both panels: l2 red dots, l-infinity blue squares; the captions' reading is hollow."""
    figure = style.new_figure(style.DOUBLE, 2.7)
    for axes, name in zip(figure.subplots(1, 2), data["panel"].values, strict=True):
        draw_panel(axes, data.sel(panel=name))
    figure.legend(handles=legend(data), loc="outside upper center", ncols=4, columnspacing=1.2)
    return figure


def draw_panel(axes: Axes, panel: xr.Dataset) -> None:
    """Draw the norms that one panel holds against the half-width."""
    norms = [name for name in NORMS if name in panel]
    for name in norms:
        for reading in panel["reading"].values:
            dots = panel[name].sel(reading=reading).dropna("half_width")
            axes.plot(dots["half_width"], dots, **_look(name, reading))
    axes.set_xscale("log")
    axes.xaxis.set_major_locator(FixedLocator(TICKS))
    axes.xaxis.set_minor_locator(NullLocator())
    axes.xaxis.set_major_formatter(StrMethodFormatter("{x:g}"))
    axes.set_ylim(*_limits(panel[norms]))
    axes.set_xlabel("half-width $M$  ($N = 2M + 1$ sites)")
    axes.set_ylabel(f"{' and '.join(NORMS[name] for name in norms)} of $(A, B)$")
    axes.set_title(style.name_case(panel), loc="left")


def _limits(norms: xr.Dataset) -> tuple[float, float]:
    values = norms.to_dataarray()
    low, high = float(values.min()), float(values.max())
    # from zero, unless that would leave the panel empty below a band of dots
    return (0 if low < 0.85 * high else 0.8 * low), 1.08 * high


def _look(name: str, reading: str) -> dict:
    colour = style.COLOURS[name]
    return {
        "linestyle": "none",
        "marker": MARKERS[name],
        "markersize": SIZES[reading],
        "color": colour,
        "markerfacecolor": colour if reading == "text" else "white",
        "markeredgewidth": 0.7,
    }


def legend(data: xr.Dataset) -> list[Line2D]:
    """Return one entry for each norm and reading."""
    names = {
        str(reading): "{} on {}".format(
            *(str(data[key].sel(reading=reading).values) for key in ("statistic", "window"))
        )
        for reading in data["reading"].values
    }
    return [
        Line2D([], [], label=f"{NORMS[name]}, {names[reading]}", **_look(name, reading))
        for name in NORMS
        if name in data
        for reading in names
    ]
