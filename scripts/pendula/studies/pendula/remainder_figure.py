"""How far the expansion is from the pendula, in a picture: orders, growth in time, and horizons."""

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.ticker import NullLocator

from pendula.drawing import style
from pendula.numerics.elementary import power

from .claims_remainder import common_end

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
KEPT = ["error", "order", "visible_from", "omega"]


def gather_remainder(remainder: xr.Dataset) -> xr.Dataset:
    """Return errors, orders and horizons as they are drawn."""
    return remainder[KEPT].assign_attrs(common_end=common_end(remainder))


@style.styled
def draw_remainder(data: xr.Dataset) -> Figure:
    """Draw errors against mu, the remainder against time, and horizons against mu."""
    figure = style.new_figure(style.DOUBLE, 3.1)
    order, growth, horizon = figure.subplots(1, 3)
    _draw_orders(order, data)
    _draw_growth(growth, data)
    _draw_horizons(horizon, data)
    for lines, corner in zip(_named(data), ("left", "right"), strict=True):
        figure.legend(handles=lines, loc=f"outside upper {corner}", ncols=len(lines))
    return figure


def _look(data: xr.Dataset, case: str, expansion: str) -> dict:
    colour = COLOURS.get(float(data["omega"].sel(case=case)), "0.5")
    marker = MARKERS.get(case.rpartition("_")[2], "^")
    return {"color": colour, "marker": marker, "markersize": 3.2, **KINDS[expansion]}


def _named(data: xr.Dataset) -> tuple[list[Line2D], list[Line2D]]:
    """Return what the legends explain: detunings and sizes of the data; orders."""
    omegas = dict.fromkeys(float(one) for one in data["omega"].values)
    sizes = dict.fromkeys(case.rpartition("_")[2] for case in _cases(data))
    lines = [
        Line2D([], [], color=COLOURS.get(one, "0.5"), lw=2.0, label=rf"$\Omega = {one:g}$")
        for one in omegas
    ]
    lines += [
        Line2D([], [], color="0.3", ls="", marker=MARKERS.get(size, "^"), markersize=4, label=size)
        for size in sizes
    ]
    kinds = [
        Line2D([], [], color="0.3", lw=1.2, marker="o", markersize=4, label=name, **kind)
        for name, kind in KINDS.items()
    ]
    return lines, kinds


def _cases(data: xr.Dataset) -> list[str]:
    return [str(case) for case in data["case"].values]


def _draw_orders(axes: Axes, data: xr.Dataset) -> None:
    """Draw the error up to the end of the shortest run against mu, and two slopes."""
    end, mu = data.attrs["common_end"], data["mu"].values
    for case in _cases(data):
        for expansion in KINDS:
            error = data["error"].sel(case=case, expansion=expansion, end=end)
            axes.loglog(mu, error, lw=0.8, **_look(data, case, expansion))
    at = mu[-3:]
    for order, expansion, above in ((3.0, "leading", True), (5.0, "corrected", False)):
        first = data["error"].sel(expansion=expansion, end=end, mu=at[0])
        start = float(3.0 * first.max() if above else first.min() / 4.0)
        slope = start * power(at / at[0], order)
        axes.loglog(at, slope, color="0.4", lw=1.0, ls=":")
        place = {"ha": "right", "va": "bottom"} if above else {"ha": "left", "va": "top"}
        axes.annotate(rf"$\mu^{order:g}$", (at[1], slope[1]), **place)
    axes.set(xlabel=r"$\mu$", ylabel="largest error of an angle, rad")
    _name_mus(axes, mu)
    axes.set_title(rf"(a) up to $\tau = {end:g}$", loc="left")


def _draw_growth(axes: Axes, data: xr.Dataset) -> None:
    """Draw the error of (3) over mu^3 against time, from the small data, each mu to its end."""
    mus = data["mu"].values[2:]
    looks = [
        {"lw": width, "alpha": alpha}
        for width, alpha in zip(WIDTHS, np.linspace(1.0, 0.35, len(WIDTHS)), strict=True)
    ]
    for case in _cases(data):
        if not case.endswith("small"):
            continue
        look = _look(data, case, "leading")
        for mu, line in zip(mus, looks, strict=False):
            error = data["error"].sel(case=case, expansion="leading", mu=mu) / (mu * mu * mu)
            axes.loglog(data["end"], error, color=look["color"], zorder=2.0 + mu, **line)
    named = [
        Line2D([], [], color="0.2", label=rf"$\mu = {mu:g}$", **line)
        for mu, line in zip(mus, looks, strict=False)
    ]
    axes.legend(handles=named, loc="upper left", fontsize=7)
    axes.set(xlabel=r"slow time $\tau$", ylabel=r"error of (3) over $\mu^3$, rad")
    for axis in (axes.xaxis, axes.yaxis):
        axis.set_minor_locator(NullLocator())  # several decades, whose ticks take time
    axes.set_title("(b) from small data", loc="left")


def _draw_horizons(axes: Axes, data: xr.Dataset) -> None:
    """Draw when the error becomes visible at Omega = 0; what is beyond a run is left out."""
    for case in _cases(data):
        if data["omega"].sel(case=case) != 0.0:
            continue
        for expansion in KINDS:
            horizon = data["visible_from"].sel(case=case, expansion=expansion).values
            shown = np.where(np.isfinite(horizon), horizon, np.nan)
            axes.semilogx(data["mu"], shown, lw=0.8, **_look(data, case, expansion))
    axes.set(xlabel=r"$\mu$", ylabel=r"slow time $\tau$ at which the error is visible")
    axes.set_ylim(-0.03 * axes.get_ylim()[1], None)  # all of the marks at zero
    _name_mus(axes, data["mu"].values)
    axes.set_title(r"(c) $\Omega = 0$", loc="left")


def _name_mus(axes: Axes, mus: np.ndarray) -> None:
    """Put a tick at each mu, and a number at every second one."""
    axes.set_xticks(mus[::2], [f"{mu:g}" for mu in mus[::2]])
    axes.set_xticks(mus[1::2], minor=True)
    axes.set_xticklabels([""] * len(mus[1::2]), minor=True)
