"""Lemma 1 in pictures: the stability chart, measured growth rates, growth at the threshold."""

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
CHARTS = {
    "long": {"marker": "o", "color": "#f2a15f", "markersize": 3.5},
    "short": {"marker": "x", "color": style.BLUE, "markersize": 3},
}
ERRORS = {
    "exact_flow": ("s", "#16876b", "linear flow of the data"),
    "finite_rate": (".", "0.55", "fastest mode"),
}
PREDICTED = "rate of the fastest mode\n(per unit of $\\tau$)"
COMPARED = ["measured", "exact_flow", "finite_rate"]


def gather_chart(
    chart: xr.Dataset,
    short_chart: xr.Dataset,
    windows: xr.Dataset,
    points: Sequence[tuple[float, float]],
) -> xr.Dataset:
    """Return the charts of a long and of a short chain, the stable shares, the paper's points.

    `points` are pairs (Omega, gamma) in units of epsilon.
    """
    short = short_chart[CHART]
    renamed = {name: f"short_{name}" for name in (*short.data_vars, *short.coords)}
    closing = windows[["share"]].rename(gamma="window_gamma")
    data = xr.merge([chart[CHART], short.rename(renamed), closing], combine_attrs="drop_conflicts")
    omegas, gammas = np.array(points, float).reshape(-1, 2).T
    for name, values in (("point_omega", omegas), ("point_gamma", gammas)):
        about = {"long_name": f"{name.removeprefix('point_')} of the paper's cases", "units": "1"}
        data[name] = ("point", values, about)
    return data


@style.styled
def draw_chart(data: xr.Dataset) -> Figure:
    """Draw the chart of the long chain above; below the short chain's, and the windows' share."""
    figure = style.new_figure(style.DOUBLE, 5.2)
    panels = figure.subplot_mosaic([["long", "long"], ["short", "share"]])
    _draw_rates_over(figure, panels["long"], data)
    _mark_points(panels["long"], data)
    _draw_rates_over(figure, panels["short"], _short_chart(data))
    _draw_share(panels["share"], data)
    style.name_legend(figure, panels["long"])
    return figure


def _short_chart(data: xr.Dataset) -> xr.Dataset:
    names = [name for name in data.data_vars if name.startswith("short_")]
    short = data[names].drop_vars(["omega", "gamma", "curve_omega"], errors="ignore")
    return short.rename({name: str(name).removeprefix("short_") for name in short.variables})


def _draw_rates_over(figure: Figure, axes: Axes, chart: xr.Dataset) -> None:
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


def gather_rates(chart: xr.Dataset, short_chart: xr.Dataset, threshold: xr.Dataset) -> xr.Dataset:
    """Return every measured cell of two charts in one row each, and the growth at the threshold."""
    rows = []
    for name, cells in (("long", chart), ("short", short_chart)):
        row = cells[COMPARED].stack(cell=("omega", "gamma")).reset_index("cell")
        row["chain"] = ("cell", np.full(row.sizes["cell"], name))
        row["sites"] = ("cell", np.full(row.sizes["cell"], int(cells["sites"])))
        rows.append(row)
    joined = xr.concat(rows, "cell", combine_attrs="drop_conflicts").reset_coords()
    joined["chain"].attrs = {"long_name": "chart to which a cell belongs", "units": "1"}
    joined["sites"].attrs = {"long_name": "number of sites N", "units": "1"}
    names = {"omega": "threshold_omega"}
    growth = threshold[["grown", "threshold", "spreading"]].rename(names)
    return xr.merge([joined, growth], combine_attrs="drop_conflicts")


@style.styled
def draw_rates(data: xr.Dataset) -> Figure:
    """Draw rates against each other, their relative errors, and the growth at the threshold."""
    figure = style.new_figure(style.DOUBLE, 2.9)
    rates, errors, threshold = figure.subplots(1, 3)
    _draw_measured(rates, data)
    _draw_errors(errors, data)
    _draw_threshold(threshold, data)
    return figure


def _draw_measured(axes: Axes, data: xr.Dataset) -> None:
    for name, look in CHARTS.items():
        cells = data.isel(cell=data["chain"].values == name)
        label = f"$N = {int(cells['sites'][0])}$"
        axes.plot(cells["finite_rate"], cells["measured"], linestyle="none", label=label, **look)
    top = float(data["finite_rate"].max())
    axes.plot([0, top], [0, top], color="black", lw=0.8, label="equal")
    axes.set_xlabel(PREDICTED)
    axes.set_ylabel("measured growth rate (per unit of $\\tau$)")
    axes.legend(loc="upper left")


def _draw_errors(axes: Axes, data: xr.Dataset) -> None:
    growing = data.isel(cell=data["finite_rate"].values > 0)
    for name, (marker, colour, label) in ERRORS.items():
        with np.errstate(divide="ignore"):
            error = abs(growing["measured"] / growing[name] - 1)
        shown = error.where(error > 0)
        look = {"marker": marker, "color": colour, "markersize": 2.5}
        axes.plot(growing["finite_rate"], shown, linestyle="none", label=label, **look)
    axes.set_yscale("log")
    axes.set_xlabel(PREDICTED)
    axes.set_ylabel("relative error of the measured rate")
    axes.set_ylim(top=1e6)  # room for the legend
    axes.legend(loc="upper right", title="against the", handletextpad=0.1)


def _draw_threshold(axes: Axes, data: xr.Dataset) -> None:
    wave = data.isel(threshold_omega=0)
    tau = np.array([float(data["tau"].min()), float(data["tau"].max())])
    line = 4 * float(wave["threshold"]) * tau
    axes.plot(tau, line, color="black", lw=0.8, label=r"$4 \gamma \tau$")
    _draw_both(axes, data["tau"], data["grown"], "o", style.RED, "one mode, finite chain")
    for norm, marker, colour in (("l2", "s", "#16876b"), ("linf", "^", style.BLUE)):
        spread = data["spreading"].sel(norm=norm)
        name = {"l2": r"$\ell^2$", "linf": r"$\ell^\infty$"}[norm]
        _draw_both(axes, data["long_tau"], spread, marker, colour, f"{name}, infinite chain")
    axes.set_xscale("log")
    axes.set_yscale("log")
    axes.set_xlabel(r"$\tau$")
    axes.set_ylabel("growth of $A - B$ at the threshold")
    axes.set_ylim(1, 2e4)  # room for the legend
    axes.legend(loc="upper left")


def _draw_both(
    axes: Axes, times: xr.DataArray, values: xr.DataArray, marker: str, colour: str, label: str
) -> None:
    """Draw the first Omega as hollow marks, and the others, which coincide, as dots within."""
    for i, omega in enumerate(values["threshold_omega"].values):
        look = {"color": colour, "marker": marker, "linestyle": "none"}
        if i == 0:
            look |= {"markersize": 5, "markerfacecolor": "white", "label": label}
        else:
            look["markersize"] = 2
        axes.plot(times, values.sel(threshold_omega=omega), **look)
