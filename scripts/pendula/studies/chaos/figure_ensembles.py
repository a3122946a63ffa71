"""Runs from almost equal data: the bands that they fill, and the paper's own run among them."""

from collections.abc import Mapping

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from matplotlib.ticker import FixedLocator, NullLocator, StrMethodFormatter

from pendula.drawing import style
from pendula.measures.divergence import is_of_same_case
from pendula.studies.paper.figures_sweeps import TICKS

BANDS = [((0.05, 0.95), "#f9d3c0"), ((0.25, 0.75), "#ee9a75")]
MEDIAN = {"color": style.RED, "lw": 1.3}
MEAN = {"color": style.RED, "marker": "o", "markersize": 3, "linestyle": "none"}
OWN = {"color": style.BLUE, "lw": 0.6}
TRUE = {"color": "black", "lw": 0.6}
OWN_DOT = {"color": style.BLUE, "marker": "x", "markersize": 4, "linestyle": "none"}
NORM = r"$\ell^2$ norm"


def gather(
    ensembles: xr.Dataset,
    runs: Mapping[str, xr.Dataset],
    references: Mapping[str, xr.Dataset],
    sweeps: Mapping[str, xr.Dataset],
    windows: Mapping[str, str],
) -> xr.Dataset:
    """Return the pair's bands and swept maxima, and the same of the paper's runs, by name.

    The true runs of the same cases stand beside them, and how long each run is within its band.
    `windows` names the window of each sweep, such as "[10, 50]".
    """
    pair = ensembles.sel(quantity="pair", drop=True)
    names = xr.Variable("case", list(runs), ensembles["case"].attrs)
    known = [
        references[case].where(is_of_same_case(run, references[case])) for case, run in runs.items()
    ]
    run, true = (_norms_of(pair, names, data) for data in (runs.values(), known))
    run.attrs = {"long_name": "l2 norm of the paper's run", "units": "1"}
    true.attrs = {"long_name": "l2 norm of the true run", "units": "1"}
    swept = [_read_sweep(pair, name, sweeps[name], window) for name, window in windows.items()]
    swept = style.join(swept, list(windows), "sweep", "sweep")
    swept = swept.rename(omega="swept_omega", initial="swept_initial")
    cases = pair[["l2", "omega", "initial"]].assign(run=run, true=true)
    cases["run_inside"], cases["true_inside"] = (_inside(pair, norm) for norm in (run, true))
    return xr.merge([cases, swept])


def _norms_of(pair: xr.Dataset, names: xr.Variable, runs) -> xr.DataArray:
    norms = [np.sqrt((run["l2"] ** 2).sum("component", skipna=False)) for run in runs]
    return xr.concat(norms, names, join="outer").reindex(tau=pair["tau"], method="nearest")


def _inside(pair: xr.Dataset, norm: xr.DataArray) -> xr.DataArray:
    """Return the part of the later half of the time in which a norm is within the wider band."""
    low, high = (pair["l2"].sel(quantile=quantile) for quantile in BANDS[0][0])
    inside = ((norm >= low) & (norm <= high)).where(norm.notnull())
    late = inside.sel(tau=slice(float(pair["tau"].max()) / 2, None)).mean("tau")
    name = f"part of the later half that {norm.attrs['long_name']} is within 5 to 95 %"
    return late.drop_vars("quantile", errors="ignore").assign_attrs(long_name=name, units="1")


def _read_sweep(pair: xr.Dataset, name: str, own: xr.Dataset, window: str) -> xr.Dataset:
    at = {"statistic": "max", "window": window, "drop": True}
    data = pair[["l2_mean", "l2_deviation"]].sel(sweep=name, **at)
    run = own["l2"].sel(quantity="pair", **at).reindex(half_width=data["half_width"])
    data["swept_run"] = run.assign_attrs(long_name="maximum of the paper's run", units="1")
    data["swept_window"] = xr.Variable(
        (), window, {"long_name": "window of the maximum", "units": "1"}
    )
    return data.assign_attrs({key: own.attrs[key] for key in ("omega", "initial")})


@style.styled
def draw(data: xr.Dataset) -> Figure:
    """Draw bands of the norms of each case above, and the swept maxima below."""
    figure = style.new_figure(style.DOUBLE, 4.4)
    rows = figure.add_gridspec(2, 1)
    above = rows[0].subgridspec(1, data.sizes["case"]).subplots(sharey=True, squeeze=False)[0]
    below = rows[1].subgridspec(1, data.sizes["sweep"]).subplots(squeeze=False)[0]
    for axes, case in zip(above, data["case"].values, strict=True):
        _draw_bands(axes, data.sel(case=case))
    for axes, name in zip(below, data["sweep"].values, strict=True):
        _draw_sweep(axes, data.sel(sweep=name))
    above[0].set_ylabel(NORM)
    above[0].set_ylim(bottom=0)
    figure.legend(handles=_legend(), loc="outside upper center", ncols=3)
    return figure


def _draw_bands(axes: Axes, case: xr.Dataset) -> None:
    for (low, high), colour in BANDS:
        edges = (case["l2"].sel(quantile=quantile) for quantile in (low, high))
        axes.fill_between(case["tau"], *edges, color=colour, lw=0)
    axes.plot(case["tau"], case["l2"].sel(quantile=0.5), **MEDIAN)
    axes.plot(case["tau"], case["true"], **TRUE)
    axes.plot(case["tau"], case["run"], **OWN)
    axes.set_xlim(0, float(case["tau"].max()))
    axes.set_xlabel(r"$\tau$")
    axes.set_title(style.name_case(case), loc="left")


def _draw_sweep(axes: Axes, sweep: xr.Dataset) -> None:
    axes.errorbar(
        sweep["half_width"], sweep["l2_mean"], sweep["l2_deviation"],
        elinewidth=0.8, capsize=2, **MEAN,
    )  # fmt: skip
    axes.plot(sweep["half_width"], sweep["swept_run"], **OWN_DOT)
    axes.set_xscale("log")
    axes.xaxis.set_major_locator(FixedLocator(TICKS))
    axes.xaxis.set_minor_locator(NullLocator())
    axes.xaxis.set_major_formatter(StrMethodFormatter("{x:g}"))
    tops = sweep["l2_mean"] + sweep["l2_deviation"], sweep["swept_run"]
    axes.set_ylim(0, 1.08 * max(float(top.max()) for top in tops))
    axes.set_xlabel("half-width $M$")
    axes.set_ylabel(f"largest {NORM} on {sweep['swept_window'].item()}")
    labels = {"swept_omega": "omega", "swept_initial": "initial"}
    axes.set_title(style.name_case(sweep[list(labels)].rename(labels)), loc="left")


def _legend() -> list:
    bands = [
        Patch(color=colour, label=f"{100 * low:g} to {100 * high:g} % of the ensemble")
        for (low, high), colour in BANDS
    ]
    return [
        *bands,
        Line2D([], [], label="median", **MEDIAN),
        Line2D([], [], label="the true run", **{**TRUE, "lw": 1.2}),
        Line2D([], [], label="mean and standard deviation", **MEAN),
        Line2D([], [], label="one run by the paper's solver", **{**OWN_DOT, "linestyle": "-"}),
    ]
