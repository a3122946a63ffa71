"""Figures of Lemma 1 and Theorems 1 to 3: the stability chart, and the cases with their bounds.

The bounds are on P = |A|^2 + |B|^2 in l2.
"""

from collections.abc import Sequence

import numpy as np
import xarray as xr
from latticode.drawing import style
from matplotlib.figure import Figure
from matplotlib.ticker import NullLocator
from replication.variables import REGULAR

from pendula.drawing import name_initial

HEAT = "YlOrRd"  # light for slow growth, so that the thresholds are seen
CHART = ["measured", "infinite_curve", "finite_curve", "sites"]
CURVES = {
    "finite_curve": {"color": "#4f86e8", "lw": 2.0, "label": "threshold of the finite chain"},
    "infinite_curve": {
        "color": "black",
        "lw": 0.9,
        "dashes": (4, 2),
        "label": "threshold of the infinite chain",
    },
}
CHART_CAPTION = (
    "Where the chain at rest is unstable, by detuning Ω and drive γ in units of the coupling ε. "
    "Growth rates of runs from tiny initial amplitudes, and the thresholds of Lemma 1, for the "
    "infinite chain (dashed) and for the finite one (solid). Circles mark the cases of Figs 2 to 4."
)
BOUNDS = {
    "theorem_1": (">", "#16876b", "Theorem 1"),
    "theorem_2": ("s", "#e0a100", "Theorem 2"),
    "widened": ("D", "#7a4fa3", "Theorem 2 with bonds"),
    "theorem_3": ("|", style.BLUE, "Theorem 3"),
}
BOUNDS_CAPTION = (
    "P = ‖A‖² + ‖B‖² in ℓ² in the cases of Figs 2 to 4: at the start, its largest value in each "
    "run, and the bounds of Theorems 1 to 3 that apply; Theorem 2 with bonds also counts the "
    "coupling energy."
)


def gather_chart(
    chart: xr.Dataset, points: Sequence[tuple[float, float]], of_paper: bool = True
) -> xr.Dataset:
    """Return the chart with the points of the cases.

    `points` are pairs (Omega, gamma) in units of epsilon; with `of_paper` they are the paper's.
    """
    data = chart[CHART].drop_attrs(deep=False).assign_attrs(caption=CHART_CAPTION, **REGULAR)
    owner = "the paper's cases" if of_paper else "the cases"
    for name, values in zip(("omega", "gamma"), np.reshape(points, (-1, 2)).T, strict=True):
        attributes = {"long_name": f"{name} of {owner}", "units": "1"}
        data[f"point_{name}"] = ("point", values.astype(float), attributes)
    return data if of_paper else data.assign_attrs(points="Figs 2 to 4 of this run")


@style.styled
def draw_chart(data: xr.Dataset) -> Figure:
    """Draw the growth rates, the thresholds and the points of the cases."""
    figure = style.new_figure(style.WIDTH, 2.8)
    axes = figure.subplots()
    rate = data["measured"].transpose("gamma", "omega").clip(min=0)
    look = {"shading": "nearest", "cmap": HEAT, "vmin": 0, "rasterized": True}
    image = axes.pcolormesh(data["omega"], data["gamma"], rate, **look)
    bar = figure.colorbar(image, ax=axes, pad=0.015, aspect=18)
    bar.set_label("measured growth rate\n(per unit of $\\epsilon \\tau$)")
    for name, look in CURVES.items():
        axes.plot(data["curve_omega"], data[name], **look)
    hollow = {"color": "white", "markeredgecolor": "black", "markersize": 6}
    label = data.attrs.get("points", "figures of the paper")
    axes.plot(data["point_omega"], data["point_gamma"], "o", label=label, **hollow)
    axes.set_xlim(float(data["omega"][0]), float(data["omega"][-1]))
    axes.set_ylim(0, float(data["gamma"][-1]))
    axes.set(xlabel=r"$\Omega / \epsilon$", ylabel=r"$\gamma / \epsilon$")
    axes.set_title(f"$N = {int(data['sites'])}$ sites, Dirichlet ends", loc="left")
    style.name_legend(figure, axes)
    return figure


def gather_bounds(cases: xr.Dataset) -> xr.Dataset:
    """Return the cases with their bounds."""
    seen = cases[["omega", "initial", "observed", "start", *BOUNDS]].drop_attrs(deep=False)
    return seen.assign_attrs(caption=BOUNDS_CAPTION)


@style.styled
def draw_bounds(data: xr.Dataset) -> Figure:
    """Draw the initial and the largest P of each case, and the bounds on P."""
    figure = style.new_figure(style.WIDTH, 2.8)
    axes, rows = figure.subplots(), np.arange(data.sizes["case"])
    hollow = {"color": "white", "markeredgecolor": "black", "label": "at the start"}
    axes.plot(data["start"], rows, "o", markersize=6, **hollow)
    axes.plot(data["observed"], rows, "o", color=style.RED, markersize=4, label="largest seen")
    for name, (marker, colour, label) in BOUNDS.items():
        bound = data[name].where(np.isfinite(data[name]))
        if bound.notnull().any():
            look = {"color": colour, "label": label, "markersize": 6, "markeredgewidth": 1.5}
            axes.plot(bound, rows, marker, **look)
    axes.set_yticks(rows, list(map(_name, data["omega"], data["initial"])))
    axes.tick_params(axis="y", labelsize=style.WITH_INDICES)
    xlabel = r"$P = \|A\|^2 + \|B\|^2$"
    axes.set(ylim=(rows[-1] + 0.5, -0.5), xscale="log", xlabel=xlabel)
    axes.xaxis.set_minor_locator(NullLocator())
    axes.xaxis.set_major_formatter("{x:g}")
    style.name_legend(figure, axes)
    return figure


def _name(omega: xr.DataArray, initial: xr.DataArray) -> str:
    return rf"$\Omega = {float(omega):g}$,  " + name_initial(str(initial.values))
