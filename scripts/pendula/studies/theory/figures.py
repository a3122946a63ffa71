"""Lemma 1 in a picture: the chart of stability, and the windows of stability of finite chains."""

from collections.abc import Sequence

import numpy as np
import xarray as xr
from latticode.drawing import style
from matplotlib.axes import Axes
from matplotlib.figure import Figure

HEAT = "YlOrRd"  # from light to dark: the boundaries, where growth is slow, lie on light ground
SHADES = ["#9ecae1", "#6baed6", "#3182bd", "#08519c", "#041f42"]
DASHES = [(1, 0), (5, 1.5), (3, 1.5), (1.2, 1.2), (6, 1.5, 1.2, 1.5)]
CHART = ["measured", "infinite_curve", "finite_curve", "sites"]
CURVES = {
    "finite_curve": {"color": style.BLUE, "lw": 1.1, "label": "threshold of the finite chain"},
    "infinite_curve": {
        "color": "black",
        "lw": 1.4,
        "dashes": (4, 2),
        "label": r"$\gamma_0$ of the infinite chain",
    },
}
CHART_CAPTION = (
    "Where the chain at rest is unstable, by detuning Ω and drive γ in units of the coupling ε. "
    "(a), (b): growth rates of runs from tiny initial amplitudes on a long and on a short chain, "
    "and the thresholds of Lemma 1, for the infinite chain (dashed) and for the finite one "
    "(solid). Circles mark the cases of Figs 2 to 4. (c): share of the detunings between 0 and 4ε "
    "at which a chain of N sites is stable."
)


def gather_chart(
    chart: xr.Dataset,
    short_chart: xr.Dataset,
    windows: xr.Dataset,
    points: Sequence[tuple[float, float]],
    of_paper: bool = True,
) -> xr.Dataset:
    """Return the charts of a long and of a short chain, the stable shares, the cases' points.

    `points` are pairs (Omega, gamma) in units of epsilon, `of_paper` says whether of its figures.
    """
    short = short_chart[CHART]
    renamed = {name: f"short_{name}" for name in (*short.data_vars, *short.coords)}
    closing = windows[["share"]].rename(gamma="window_gamma")
    data = xr.merge([chart[CHART], short.rename(renamed), closing], combine_attrs="drop_conflicts")
    data.attrs["caption"] = CHART_CAPTION
    whose = "the paper's cases" if of_paper else "the cases"
    for name, values in zip(("omega", "gamma"), np.reshape(points, (-1, 2)).T, strict=True):
        about = {"long_name": f"{name} of {whose}", "units": "1"}
        data[f"point_{name}"] = ("point", values.astype(float), about)
    return data if of_paper else data.assign_attrs(points="Figs 2 to 4 of this run")


@style.styled
def draw_chart(data: xr.Dataset) -> Figure:
    """Draw the chart of the long chain above; below the short chain's, and the windows' share."""
    figure = style.new_figure(style.WIDTH, 4.8)
    panels = figure.subplot_mosaic([["long", "long"], ["short", "share"]])
    _draw_rates_over(figure, panels["long"], data, "(a)")
    hollow = {"color": "white", "markeredgecolor": "black", "markersize": 6}
    label = data.attrs.get("points", "figures of the paper")
    panels["long"].plot(data["point_omega"], data["point_gamma"], "o", label=label, **hollow)
    short = data[[name for name in data.data_vars if name.startswith("short_")]]
    short = short.drop_vars(["omega", "gamma", "curve_omega"], errors="ignore")
    short = short.rename({name: str(name).removeprefix("short_") for name in short.variables})
    _draw_rates_over(figure, panels["short"], short, "(b)")
    _draw_share(panels["share"], data)
    style.name_legend(figure, panels["long"])
    return figure


def _draw_rates_over(figure: Figure, axes: Axes, chart: xr.Dataset, letter: str) -> None:
    rate = chart["measured"].transpose("gamma", "omega").clip(min=0)
    look = {"shading": "nearest", "cmap": HEAT, "vmin": 0, "rasterized": True}
    image = axes.pcolormesh(chart["omega"], chart["gamma"], rate, **look)
    bar = figure.colorbar(image, ax=axes, pad=0.015, aspect=18)
    bar.set_label("measured growth rate\n(per unit of $\\epsilon \\tau$)")
    for name, look in CURVES.items():
        axes.plot(chart["curve_omega"], chart[name], **look)
    axes.set_xlim(float(chart["omega"][0]), float(chart["omega"][-1]))
    axes.set_ylim(0, float(chart["gamma"][-1]))
    axes.set(xlabel=r"$\Omega / \epsilon$", ylabel=r"$\gamma / \epsilon$")
    axes.set_title(f"{letter} $N = {int(chart['sites'])}$ sites, Dirichlet ends", loc="left")


def _draw_share(axes: Axes, data: xr.Dataset) -> None:
    looks = zip(data["half_width"].values, SHADES, DASHES, strict=False)
    for half_width, colour, dashes in looks:
        share = data["share"].sel(half_width=half_width)
        look = {"color": colour, "dashes": dashes, "label": f"$N = {2 * int(half_width) + 1}$"}
        axes.plot(share["window_gamma"], share, lw=1.3, **look)
    ends = float(data["window_gamma"][0]), float(data["window_gamma"][-1])
    axes.set(xscale="log", xlim=ends, ylim=(0, 1), xlabel=r"$\gamma / \epsilon$")
    axes.set_ylabel(r"stable share of $0 \leq \Omega \leq 4 \epsilon$")
    axes.set_title("(c) windows of stability of finite chains", loc="left")
    axes.legend()
