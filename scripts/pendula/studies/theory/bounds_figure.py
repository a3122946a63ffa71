"""Theorems 1 to 3: the largest P = |A|^2 + |B|^2 in l2 that was seen, against its bounds."""

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure, SubFigure
from matplotlib.ticker import NullLocator

from pendula.drawing import style
from pendula.drawing.panels import half_width_axis

BOUNDS = {
    "theorem_1": (">", "#16876b", "Theorem 1"),
    "theorem_2": ("s", "#e0a100", "Theorem 2"),
    "widened": ("D", "#7a4fa3", "Theorem 2 with bonds"),
    "theorem_3": ("|", style.BLUE, "Theorem 3"),
}
FAMILIES = {
    "theorem_1": "Theorem 1",
    "theorem_2_ball": "Theorem 2\n" r"($C_0 \delta$)",
    "theorem_2_energy": "Theorem 2\n(its energy)",
    "theorem_2_widened": "Theorem 2\nwith bonds",
    "theorem_3": "Theorem 3",
}
SEARCHES = {
    "dirichlet": {"color": style.RED, "label": "chain"},
    "periodic": {"color": style.RED, "markerfacecolor": "white", "label": "ring"},
}
POWER = r"$P = \|A\|^2 + \|B\|^2$"


def gather_bounds(
    cases: xr.Dataset, sweeps: xr.Dataset, samples: xr.Dataset, worst: xr.Dataset
) -> xr.Dataset:
    """Return the cases and sweeps with their bounds, and the ratios that data drawn reach."""
    named = ["omega", "initial", "observed"]
    seen = cases[[*named, "start", "region", "ratio", *BOUNDS]]
    swept = sweeps[[*named, "theorem_3", "best"]].rename(
        {name: f"swept_{name}" for name in (*named, "theorem_3", "best")}
    )
    drawn = samples[["ratio"]].rename(ratio="sampled")
    searched = worst[["worst", "small_data", "family", "boundary", "sites"]].rename(
        {name: f"searched_{name}" for name in ("family", "boundary", "sites")}
    )
    return xr.merge([seen, swept, drawn, searched], combine_attrs="drop_conflicts")


@style.styled
def draw_bounds(data: xr.Dataset) -> Figure:
    """Draw the cases and the data drawn at random above, the four sweeps below."""
    figure = style.new_figure(style.DOUBLE, 5.8)
    above, below = figure.subfigures(2, 1, height_ratios=[1.3, 1])
    left, right = above.subfigures(1, 2, width_ratios=[1.35, 1])
    _draw_cases(left.subplots(), data)
    _draw_samples(right.subplots(), data)
    panels = below.subplots(1, data.sizes["sweep"], sharex=True, sharey=True, squeeze=False)[0]
    for axes, name in zip(panels, data["sweep"].values, strict=True):
        _draw_sweep(axes, data.sel(sweep=name))
    panels[0].set_ylabel(f"largest {POWER}")
    for part, columns in ((left, 3), (right, 2), (below, 3)):
        _put_legend(part, columns)
    return figure


def _put_legend(part: SubFigure, columns: int) -> None:
    look = {"ncols": columns, "columnspacing": 0.8, "handlelength": 1.3, "handletextpad": 0.3}
    part.legend(*part.axes[0].get_legend_handles_labels(), loc="outside upper center", **look)


def _draw_cases(axes: Axes, data: xr.Dataset) -> None:
    rows = np.arange(data.sizes["case"])
    hollow = {"color": "white", "markeredgecolor": "black", "label": "at the start"}
    axes.plot(data["start"], rows, "o", **hollow)
    for name, (marker, colour, label) in BOUNDS.items():
        bound = data[name].where(np.isfinite(data[name]))
        if bound.notnull().any():
            look = {"color": colour, "label": label, "markersize": 5, "markeredgewidth": 1.5}
            axes.plot(bound, rows, marker, **look)
    axes.plot(data["observed"], rows, "o", color=style.RED, markersize=5, label="largest seen")
    for row in rows:
        case, edge = data.isel(case=row), axes.get_yaxis_transform()
        axes.text(1.02, row, _standing(case), transform=edge, va="center")
    axes.set_yticks(rows, list(map(_name, data["omega"], data["initial"])))
    axes.set_ylim(rows[-1] + 0.5, -0.5)
    axes.set_xscale("log")
    axes.xaxis.set_minor_locator(NullLocator())
    axes.set_xlabel(POWER)


def _standing(case: xr.Dataset) -> str:
    region, ratio = str(case["region"].values), float(case["ratio"])
    if region == "none":
        return f"outside; {ratio:.2g}\nof Theorem 3"
    covered = region.replace("theorem", "Theorem").replace("widened", "with bonds")
    return f"inside; {ratio:.2g} of\n{covered}"


def _name(omega: xr.DataArray, initial: xr.DataArray) -> str:
    return rf"$\Omega = {float(omega):g}$" + "\n" + style.name_initial(str(initial.values))


def _draw_samples(axes: Axes, data: xr.Dataset) -> None:
    rows = np.arange(data.sizes["family"])
    for row, family in zip(rows, data["family"].values, strict=True):
        ratio = data["sampled"].sel(family=family).values.ravel()
        height = row + np.linspace(-0.32, 0.32, len(ratio))
        label = r"random data, any $\epsilon$, $\gamma$" if row == 0 else None
        axes.plot(ratio, height, ".", color="0.62", markersize=2.5, label=label)
    searched = list(data["family"].values).index
    for boundary, look in SEARCHES.items():
        runs = data.isel(question=data["searched_boundary"].values == boundary)
        places = [searched(family) for family in runs["searched_family"].values]
        label = f"worst, {look['label']} of {int(data['searched_sites'])}"
        tiny = {"markersize": 16, "markeredgewidth": 1.2, "color": "black"}
        axes.plot(runs["small_data"], places, "|", **tiny)
        axes.plot(runs["worst"], places, "D", markersize=4, **{**look, "label": label})
    axes.plot([], [], "|", **{**tiny, "markersize": 9}, label="its limit for tiny data")
    axes.axvline(1, color="black", lw=0.8, dashes=(4, 2))
    axes.set_yticks(rows, [FAMILIES[name] for name in data["family"].values])
    axes.invert_yaxis()
    axes.set_xlim(0, 1.06)
    axes.set_xlabel("largest $P$ over its bound")


def _draw_sweep(axes: Axes, sweep: xr.Dataset) -> None:
    m = sweep["half_width"]
    best = {"color": "#f2b824", "lw": 3.5, "label": "smallest bound"}
    finite = {"color": style.BLUE, "lw": 1.1, "dashes": (4, 2), "label": "Theorem 3"}
    axes.plot(m, sweep["swept_best"], **best)
    axes.plot(m, sweep["swept_theorem_3"], **finite)
    axes.plot(m, sweep["swept_observed"], "o", color=style.RED, markersize=3, label="largest seen")
    half_width_axis(axes)
    axes.set_yscale("log")
    axes.yaxis.set_minor_locator(NullLocator())
    axes.set_xlabel("half-width $M$")
    axes.set_title(_name(sweep["swept_omega"], sweep["swept_initial"]), loc="left")
