"""Lemma 1 as a chart: where the chain at rest is unstable, measured and predicted."""

from collections.abc import Sequence

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from pendula.drawing import style

HEAT = "YlOrRd"  # from light to dark: the boundaries, where growth is slow, lie on light ground
SHADES = ["#9ecae1", "#6baed6", "#3182bd", "#08519c", "#041f42"]
DASHES = [(1, 0), (5, 1.5), (3, 1.5), (1.2, 1.2), (6, 1.5, 1.2, 1.5)]
VARIABLES = ["measured", "infinite_curve", "finite_curve", "sites"]


def gather(
    chart: xr.Dataset,
    short_chart: xr.Dataset,
    windows: xr.Dataset,
    points: Sequence[tuple[float, float]],
) -> xr.Dataset:
    """Return the charts of a long and of a short chain, the stable shares, the paper's points.

    `points` are pairs (Omega, gamma) in units of epsilon.
    """
    short = short_chart[VARIABLES]
    renamed = {name: f"short_{name}" for name in (*short.data_vars, *short.coords)}
    closing = windows[["share"]].rename(gamma="window_gamma")
    data = xr.merge(
        [chart[VARIABLES], short.rename(renamed), closing], combine_attrs="drop_conflicts"
    )
    omegas, gammas = np.array(points, float).reshape(-1, 2).T
    for name, values in (("point_omega", omegas), ("point_gamma", gammas)):
        about = {"long_name": f"{name.removeprefix('point_')} of the paper's cases", "units": "1"}
        data[name] = ("point", values, about)
    return data


@style.styled
def draw(data: xr.Dataset) -> Figure:
    """Draw the chart of the long chain above; below the short chain's, and the windows' share."""
    figure = style.new_figure(style.DOUBLE, 5.2)
    panels = figure.subplot_mosaic([["long", "long"], ["short", "share"]])
    _draw_chart(figure, panels["long"], data)
    _mark_points(panels["long"], data)
    _draw_chart(figure, panels["short"], _short_chart(data))
    _draw_share(panels["share"], data)
    style.name_legend(figure, panels["long"])
    return figure


def _short_chart(data: xr.Dataset) -> xr.Dataset:
    names = [name for name in data.data_vars if name.startswith("short_")]
    short = data[names].drop_vars(["omega", "gamma", "curve_omega"], errors="ignore")
    return short.rename({name: str(name).removeprefix("short_") for name in short.variables})


def _draw_chart(figure: Figure, axes: Axes, chart: xr.Dataset) -> None:
    rate = chart["measured"].transpose("gamma", "omega").clip(min=0)
    image = axes.pcolormesh(
        chart["omega"], chart["gamma"], rate, shading="nearest", cmap=HEAT, vmin=0, rasterized=True
    )
    bar = figure.colorbar(image, ax=axes, pad=0.015, aspect=18)
    bar.set_label("measured growth rate\n(per unit of $\\epsilon \\tau$)")
    sites = int(chart["sites"])
    curve = chart["curve_omega"]
    axes.plot(
        curve,
        chart["finite_curve"],
        color=style.BLUE,
        lw=1.1,
        label="threshold of the finite chain",
    )
    axes.plot(
        curve,
        chart["infinite_curve"],
        color="black",
        lw=1.4,
        dashes=(4, 2),
        label=r"$\gamma_0$ of the infinite chain",
    )
    axes.set_xlim(float(chart["omega"][0]), float(chart["omega"][-1]))
    axes.set_ylim(0, float(chart["gamma"][-1]))
    axes.set_xlabel(r"$\Omega / \epsilon$")
    axes.set_ylabel(r"$\gamma / \epsilon$")
    axes.set_title(f"$N = {sites}$ sites, Dirichlet ends", loc="left")


def _mark_points(axes: Axes, data: xr.Dataset) -> None:
    axes.plot(
        data["point_omega"],
        data["point_gamma"],
        "o",
        color="white",
        markeredgecolor="black",
        markersize=6,
        label="the paper's figures",
    )


def _draw_share(axes: Axes, data: xr.Dataset) -> None:
    looks = zip(data["half_width"].values, SHADES, DASHES, strict=False)
    for half_width, colour, dashes in looks:
        share = data["share"].sel(half_width=half_width)
        axes.plot(
            share["window_gamma"],
            share,
            color=colour,
            dashes=dashes,
            lw=1.3,
            label=f"$N = {2 * int(half_width) + 1}$",
        )
    axes.set_xscale("log")
    axes.set_ylim(0, 1)
    axes.set_xlim(float(data["window_gamma"][0]), float(data["window_gamma"][-1]))
    axes.set_xlabel(r"$\gamma / \epsilon$")
    axes.set_ylabel(r"stable share of $0 \leq \Omega \leq 4 \epsilon$")
    axes.set_title("windows of stability of finite chains", loc="left")
    axes.legend()
