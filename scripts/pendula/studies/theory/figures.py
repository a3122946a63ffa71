"""The theory in pictures: Lemma 1's chart and growth rates, and the bounds of Theorems 1 to 3.

The bounds are on P = |A|^2 + |B|^2 in l2.
"""

from collections.abc import Sequence

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure, SubFigure
from matplotlib.ticker import NullLocator

from pendula.drawing import style
from pendula.drawing.panels import half_width_axis

HEAT = "YlOrRd"  # from light to dark: the boundaries, where growth is slow, lie on light ground
SHADES = ["#9ecae1", "#6baed6", "#3182bd", "#08519c", "#041f42"]
DASHES = [(1, 0), (5, 1.5), (3, 1.5), (1.2, 1.2), (6, 1.5, 1.2, 1.5)]
CHART = ["measured", "infinite_curve", "finite_curve", "sites"]
CHARTS = {"long": ("o", "#f2a15f", 3.5), "short": ("x", style.BLUE, 3)}
ERRORS = {
    "exact_flow": ("s", "#16876b", "linear flow of the data"),
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
    look = {"shading": "nearest", "cmap": HEAT, "vmin": 0, "rasterized": True}
    image = axes.pcolormesh(chart["omega"], chart["gamma"], rate, **look)
    bar = figure.colorbar(image, ax=axes, pad=0.015, aspect=18)
    bar.set_label("measured growth rate\n(per unit of $\\epsilon \\tau$)")
    sites = int(chart["sites"])
    curve = chart["curve_omega"]
    for name, look in CURVES.items():
        axes.plot(curve, chart[name], **look)
    axes.set_xlim(float(chart["omega"][0]), float(chart["omega"][-1]))
    axes.set_ylim(0, float(chart["gamma"][-1]))
    axes.set(xlabel=r"$\Omega / \epsilon$", ylabel=r"$\gamma / \epsilon$")
    axes.set_title(f"$N = {sites}$ sites, Dirichlet ends", loc="left")


def _mark_points(axes: Axes, data: xr.Dataset) -> None:
    hollow = {"color": "white", "markeredgecolor": "black", "markersize": 6}
    axes.plot(data["point_omega"], data["point_gamma"], "o", label="the paper's figures", **hollow)


def _draw_share(axes: Axes, data: xr.Dataset) -> None:
    looks = zip(data["half_width"].values, SHADES, DASHES, strict=False)
    for half_width, colour, dashes in looks:
        share = data["share"].sel(half_width=half_width)
        look = {"color": colour, "dashes": dashes, "label": f"$N = {2 * int(half_width) + 1}$"}
        axes.plot(share["window_gamma"], share, lw=1.3, **look)
    axes.set(xscale="log", ylim=(0, 1), xlabel=r"$\gamma / \epsilon$")
    axes.set_xlim(float(data["window_gamma"][0]), float(data["window_gamma"][-1]))
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
    joined["sites"].attrs = chart["sites"].attrs
    growth = threshold[["grown", "threshold", "spreading"]].rename(omega="threshold_omega")
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
    for name, (marker, colour, size) in CHARTS.items():
        cells = data.isel(cell=data["chain"].values == name)
        look = {"color": colour, "markersize": size, "label": f"$N = {int(cells['sites'][0])}$"}
        axes.plot(cells["finite_rate"], cells["measured"], marker, **look)
    top = float(data["finite_rate"].max())
    axes.plot([0, top], [0, top], color="black", lw=0.8, label="equal")
    axes.set(xlabel=PREDICTED, ylabel="measured growth rate (per unit of $\\tau$)")
    axes.legend(loc="upper left")


def _draw_errors(axes: Axes, data: xr.Dataset) -> None:
    growing = data.isel(cell=data["finite_rate"].values > 0)
    for name, (marker, colour, label) in ERRORS.items():
        with np.errstate(divide="ignore"):
            error = abs(growing["measured"] / growing[name] - 1)
        shown = error.where(error > 0)
        axes.plot(growing["finite_rate"], shown, marker, color=colour, markersize=2.5, label=label)
    axes.set(yscale="log", xlabel=PREDICTED, ylabel="relative error of the measured rate")
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
    axes.set(xscale="log", yscale="log", xlabel=r"$\tau$")
    axes.set_ylabel("growth of $A - B$ at the threshold")
    axes.set_ylim(1, 2e4)  # room for the legend
    axes.legend(loc="upper left")


def _draw_both(
    axes: Axes, times: xr.DataArray, values: xr.DataArray, marker: str, colour: str, label: str
) -> None:
    """Draw the first Omega as hollow marks, and the others, which coincide, as dots within."""
    looks = [{"markersize": 5, "markerfacecolor": "white", "label": label}]
    looks += [{"markersize": 2}] * (values.sizes["threshold_omega"] - 1)
    for i, look in enumerate(looks):
        axes.plot(times, values.isel(threshold_omega=i), marker, color=colour, **look)


# --- The bounds ----------------------------------------------------------------------------------

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
    seen = cases[["omega", "initial", "observed", "start", "region", "ratio", *BOUNDS]]
    shared = ["omega", "initial", "theorem_3", "best"]
    swept = sweeps[[*shared, "swept_observed"]].rename({name: f"swept_{name}" for name in shared})
    searched = worst[["worst", "small_data", "searched_family", "boundary", "sites"]].rename(
        boundary="searched_boundary", sites="searched_sites"
    )
    drawn = [seen, swept, samples[["sampled"]], searched]
    return xr.merge(drawn, combine_attrs="drop_conflicts")


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
