"""Lemma 1 in pictures: the chart of stability, growth rates, and growth at the threshold."""

from collections.abc import Sequence

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from pendula.drawing import style

HEAT = "YlOrRd"  # from light to dark: the boundaries, where growth is slow, lie on light ground
SHADES = ["#9ecae1", "#6baed6", "#3182bd", "#08519c", "#041f42"]
DASHES = [(1, 0), (5, 1.5), (3, 1.5), (1.2, 1.2), (6, 1.5, 1.2, 1.5)]
CHART = ["measured", "infinite_curve", "finite_curve", "sites"]
CHARTS = {"long": ("o", "#f2a15f", 3.5), "short": ("x", style.BLUE, 3)}
ERRORS = {
    "exact_flow": ("s", "#16876b", "linearised flow"),
    "finite_rate": (".", "0.55", "fastest mode"),
}
CURVES = {
    "finite_curve": {"color": style.BLUE, "lw": 1.1, "label": "threshold of the finite chain"},
    "infinite_curve": {
        "color": "black",
        "lw": 1.4,
        "dashes": (4, 2),
        "label": r"$\gamma_0$ of the infinite chain",
    },
}
PREDICTED = "rate of the fastest mode\n(per unit of $\\tau$)"
NORMS = {"l2": (1, 0), "linf": (3, 1.5)}
"""The norms at the threshold, and the dashes of their curves."""
DECAYS = [style.BLUE, "#16876b", "#7b4fa3", "#b3541e"]
CHART_CAPTION = (
    "Where the chain at rest is unstable, by detuning Ω and drive γ in units of the coupling ε. "
    "(a), (b): growth rates of runs from tiny initial amplitudes on a long and on a short chain, "
    "and the thresholds of Lemma 1, for the infinite chain (dashed) and for the finite one "
    "(solid). Circles mark the cases that are run. (c): share of the detunings between 0 and 4ε "
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
    figure = style.new_figure(style.DOUBLE, 5.2)
    panels = figure.subplot_mosaic([["long", "long"], ["short", "share"]])
    _draw_rates_over(figure, panels["long"], data, "(a)")
    hollow = {"color": "white", "markeredgecolor": "black", "markersize": 6}
    label = data.attrs.get("points", "the paper's figures")
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


def gather_rates(chart: xr.Dataset, short_chart: xr.Dataset, threshold: xr.Dataset) -> xr.Dataset:
    """Return every measured cell of two charts in one row each, and the growth at the threshold."""
    rows = []
    for name, cells in (("long", chart), ("short", short_chart)):
        row = cells[["measured", *ERRORS]].stack(cell=("omega", "gamma")).reset_index("cell")
        row["chain"] = ("cell", np.full(row.sizes["cell"], name))
        row["sites"] = ("cell", np.full(row.sizes["cell"], int(cells["sites"])))
        rows.append(row)
    joined = xr.concat(rows, "cell", combine_attrs="drop_conflicts").reset_coords()
    joined["chain"].attrs = {"long_name": "chart to which a cell belongs", "units": "1"}
    joined["sites"].attrs = chart["sites"].attrs
    growth = threshold[["grown", "threshold", "spreading", "spreading_exponent"]]
    growth = growth.rename(omega="threshold_omega")
    return xr.merge([joined, growth], combine_attrs="drop_conflicts")


@style.styled
def draw_rates(data: xr.Dataset) -> Figure:
    """Draw rates against each other, their relative errors, and the growth at the threshold."""
    figure = style.new_figure(style.DOUBLE, 3.2)
    rates, errors, threshold = figure.subplots(1, 3)
    for name, (marker, colour, size) in CHARTS.items():
        cells = data.isel(cell=data["chain"].values == name)
        look = {"color": colour, "markersize": size, "label": f"$N = {int(cells['sites'][0])}$"}
        rates.plot(cells["finite_rate"], cells["measured"], marker, **look)
    top = float(data["finite_rate"].max())
    rates.plot([0, top], [0, top], color="black", lw=0.8, label="equal")
    rates.set(xlabel=PREDICTED, ylabel="measured growth rate (per unit of $\\tau$)")
    _legend_above(rates)
    growing = data.isel(cell=data["finite_rate"].values > 0)
    for name, (marker, colour, label) in ERRORS.items():
        with np.errstate(divide="ignore"):
            error = abs(growing["measured"] / growing[name] - 1)
        look = {"color": colour, "markersize": 2.5, "label": label}
        errors.plot(growing["finite_rate"], error.where(error > 0), marker, **look)
    errors.set(yscale="log", xlabel=PREDICTED, ylabel="relative error of the measured rate")
    errors.set_ylim(top=100)  # the letter of the panel has room above the largest errors
    _legend_above(errors, title="measured against the")
    _draw_threshold(threshold, data)
    for letter, axes in zip("abc", figure.axes, strict=True):
        axes.text(0.03, 0.97, f"({letter})", transform=axes.transAxes, va="top")
    return figure


def _legend_above(axes: Axes, **look) -> None:
    """Put the legend above the panel, so that its axes belong to the data alone."""
    place = {"loc": "lower left", "bbox_to_anchor": (-0.02, 1.0), "borderaxespad": 0.2}
    look = {"handlelength": 1.4, "handletextpad": 0.6, "labelspacing": 0.25, **look}
    axes.legend(**place, alignment="left", title_fontsize=7, **look)


def _draw_threshold(axes: Axes, data: xr.Dataset) -> None:
    """Draw one wave, and what spreads from data that decay in different ways, by both norms.

    All Omega give the same but for rounding; the first is drawn. Of the decays below one every
    other is, and one site.
    """
    first, decays = data.isel(threshold_omega=0), data["decay"].values
    tau = first["tau"]
    axes.plot(tau, 4 * float(first["threshold"]) * tau, color="0.6", lw=2.5)
    wave = {"color": style.RED, "marker": "o", "markersize": 3.5, "linestyle": "none"}
    axes.plot(tau, first["grown"], **wave, label="one wave: 1")
    drawn = [*decays[decays < 1.0][1::2], decays[-1]]
    for colour, decay in zip(DECAYS, drawn, strict=False):
        own = first.sel(decay=decay)
        exponents = (f"{float(own['spreading_exponent'].sel(norm=n)):.2f}" for n in NORMS)
        name = "one site" if np.isinf(decay) else f"$s = {decay:g}$"
        label = f"{name}: {' and '.join(exponents)}".replace("-", "\N{MINUS SIGN}")
        for norm, dashes in NORMS.items():
            look = {"color": colour, "dashes": dashes, "lw": 1.2}
            spread = own["spreading"].sel(norm=norm)
            axes.plot(data["long_tau"], spread, **look, label=label if norm == "l2" else None)
    axes.set(xscale="log", yscale="log", xlabel=r"$\tau$")
    axes.set_ylabel("growth of $A - B$ at the threshold")
    _legend_above(axes, title=r"exponents: $\ell^2$ full, $\ell^\infty$ dashed")
