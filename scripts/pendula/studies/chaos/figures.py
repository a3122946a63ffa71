"""Chaos in pictures: exponents, how evenness is lost, and ensembles beside the paper's runs."""

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from pendula.drawing import panels, style
from pendula.numerics.elementary import exp, geometric, log
from pendula.problem import is_even

COLOURS = {8.0: "#e0a100", -4.0: style.BLUE, 0.0: style.RED}
"""By detuning, of different lightness."""
WIDTHS = {"small": 0.7, "large": 1.5}
DASHES = {"even": (None, None), "odd": (3, 1.5)}
MARKERS = ["o", "s", "^", "D"]
DRAWN = ["running", "exponents", "exponents_error", "divergence_predicted", "divergence_measured"]
DRAWN += ["omega", "initial"]
LIGHT = "#f2a15f"
BANDS = [((0.05, 0.95), "#f9d3c0"), ((0.25, 0.75), "#ee9a75")]
MEDIAN = {"color": style.RED, "lw": 1.3}
MEAN = {"color": style.RED, "marker": "o", "markersize": 3, "linestyle": "none"}
OWN = {"color": style.BLUE, "lw": 0.6}
TRUE = {"color": "black", "lw": 0.6}
COMPARED = ["omega", "initial", "run", "true", "run_inside", "l2_mean", "l2_deviation"]
COMPARED += ["swept_run", "swept_window", "swept_omega", "swept_initial"]
OWN_DOT = {"color": style.BLUE, "marker": "x", "markersize": 4, "linestyle": "none"}
NORM = r"$\ell^2$ norm"


def gather_lyapunov(lyapunov: xr.Dataset) -> xr.Dataset:
    """Return what is drawn: rates on their way, the spectra, and divergence times."""
    later = lyapunov.isel(tau=slice(1, None))
    running = later["log_growth"] / later["tau"]
    running.attrs = {"long_name": "mean rate of growth since the start, per unit of tau"}
    return later.assign(running=running)[DRAWN]


@style.styled
def draw_lyapunov(data: xr.Dataset) -> Figure:
    """Draw the rates of growth, all exponents of short chains, and divergence times."""
    figure = style.new_figure(style.DOUBLE, 3.1)
    running, spectrum, times = figure.subplots(1, 3, width_ratios=(1.25, 1, 1))
    _draw_running(running, data)
    _draw_spectrum(spectrum, data)
    _draw_divergence(times, data)
    figure.legend(handles=_lyapunov_legend(data), loc="outside upper center", ncols=4)
    return figure


def _look(data: xr.Dataset, case: str) -> dict:
    colour = COLOURS.get(float(data["omega"].sel(case=case)), "0.5")
    return {"color": colour, "lw": WIDTHS.get(str(case).rpartition("_")[2], 1.0)}


def _marked(data: xr.Dataset, case: str) -> dict:
    """Return the same with a dot, hollow for small data."""
    look = _look(data, case)
    face = look["color"] if look["lw"] > 1 else "white"
    return {**look, "marker": "o", "markersize": 4, "markerfacecolor": face}


def _draw_running(axes: Axes, data: xr.Dataset) -> None:
    for case in data["case"].values:
        for parity in data["parity"].values:
            curve = data["running"].sel(case=case, parity=parity)
            shown = abs(curve.isel(tau=_evenly_on_log(curve["tau"])))
            axes.plot(shown["tau"], shown, dashes=DASHES[parity], **_look(data, case))
    axes.set_xscale("log")
    axes.set_yscale("log")
    axes.set_xlim(1, float(data["tau"].max()))
    axes.set_ylim(3e-4, 5)
    axes.set_xlabel(r"$\tau$")
    axes.set_ylabel("mean rate of growth (per unit of $\\tau$)")
    axes.set_title("one small change", loc="left")


def _evenly_on_log(tau: xr.DataArray, count: int = 40) -> np.ndarray:
    """Return where to sample equal steps of time so that a logarithmic axis is not crowded."""
    return np.unique(geometric(1.0, tau.size, count).round().astype(int)) - 1


def _draw_spectrum(axes: Axes, data: xr.Dataset) -> None:
    axes.axhline(0.0, color="0.5", lw=0.6)
    lengths = data["spectrum_half_width"].values
    for case in data["spectrum_case"].values:
        for marker, half_width in zip(MARKERS, lengths, strict=False):
            one = {"spectrum_case": case, "spectrum_half_width": half_width}
            rates, errors = data["exponents"].sel(one), data["exponents_error"].sel(one)
            place = (rates["index"] - 0.5) / float(rates.notnull().sum())
            look = {"color": _look(data, case)["color"], "marker": marker, "markersize": 2.2}
            axes.fill_between(
                place, rates - errors, rates + errors, color=look["color"], alpha=0.2, lw=0
            )
            axes.plot(place, rates, linestyle="none", mew=0, **look)
    # the other half are the same with the opposite sign
    axes.set_xlim(0, 0.52)
    axes.set_ylim(-0.2, None)
    axes.set_title("all changes: the upper half", loc="left")
    axes.set_xlabel("number of the exponent over $4N$")
    axes.set_ylabel("Lyapunov exponent (per unit of $\\tau$)")
    axes.legend(
        handles=_spectrum_legend(data), loc="upper right", handlelength=1.2, handletextpad=0.5
    )


def _spectrum_legend(data: xr.Dataset) -> list[Line2D]:
    dot = {"linestyle": "none", "markersize": 3.5, "mew": 0}
    lengths = zip(MARKERS, data["spectrum_half_width"].values, strict=False)
    chains = [
        Line2D([], [], color="0.4", marker=marker, label=f"$M = {half_width}$", **dot)
        for marker, half_width in lengths
    ]
    cases = [
        Line2D([], [], color=_look(data, case)["color"], lw=2,
               label=rf"$\Omega = {float(data['omega'].sel(case=case)):g}$")
        for case in data["spectrum_case"].values
    ]  # fmt: skip
    return chains + cases


def _draw_divergence(axes: Axes, data: xr.Dataset) -> None:
    tops = [1.0]
    for case in data["case"].values:
        predicted = data["divergence_predicted"].sel(case=case)
        measured = data["divergence_measured"].sel(case=case)
        look = _marked(data, case) | {"linestyle": "none"}
        for marker, rtol in zip(MARKERS, data["rtol"].values, strict=False):
            point = predicted.sel(rtol=rtol), measured.sel(rtol=rtol)
            axes.plot(*point, **look | {"marker": marker})
            tops += [float(time) for time in point if np.isfinite(time)]
    top = 1.1 * max(tops)
    axes.plot([0, top], [0, top], color="black", lw=0.8)
    axes.set_xlim(0, top)
    axes.set_ylim(0, top)
    axes.set_xlabel(r"predicted divergence time $\tau$")
    axes.set_ylabel(r"measured divergence time $\tau$")
    axes.set_title("runs differ by 1 %", loc="left")
    look = {"color": "0.3", "linestyle": "none", "markersize": 4}
    exponents = (log(data["rtol"].values) / log(10.0)).round().astype(int)
    handles = [
        Line2D([], [], marker=marker, label=rf"$10^{{{exponent}}}$", **look)
        for marker, exponent in zip(MARKERS, exponents, strict=False)
    ]
    axes.legend(handles=handles, title="tolerance", loc="lower right", handletextpad=0.1)


def _lyapunov_legend(data: xr.Dataset) -> list[Line2D]:
    cases = [
        Line2D([], [], label=style.name_case(data.sel(case=case)), **_marked(data, case))
        for case in data["case"].values
    ]
    kept = all(map(is_even, map(str, data["initial"].values)))
    first = "" if kept else " at first"  # uneven data mix both parities
    parities = [
        Line2D([], [], color="0.3", lw=1, dashes=dashes, label=f"{parity} in $n${first}")
        for parity, dashes in DASHES.items()
    ]
    return cases + parities


def gather_symmetry(symmetry: xr.Dataset, lyapunov: xr.Dataset) -> xr.Dataset:
    """Return the odd parts, and what the odd tangent dynamics makes of the same perturbation."""
    log_growth = lyapunov["log_growth"].sel(parity="odd", drop=True)
    l2 = lyapunov["l2"]
    relative = symmetry.attrs["perturbation"] * l2.isel(tau=0, drop=True) / l2
    curve = (log_growth + relative.copy(data=log(relative.values))).clip(max=0.0)
    predicted = curve.copy(data=exp(curve.values))
    predicted = predicted.sel(tau=predicted["tau"] <= float(symmetry["tau"].max()))
    predicted.attrs = {"long_name": "odd part predicted by tangent dynamics"}
    predicted = predicted.rename(tau="predicted_tau")
    predicted["predicted_tau"].attrs = {"long_name": "slow time of the prediction"}
    names = ["rounded", "perturbed", "omega", "initial"]
    # on a time of its own, coarser than that of the runs
    return symmetry[names].assign(predicted=predicted)


@style.styled
def draw_symmetry(data: xr.Dataset) -> Figure:
    """Draw one panel a case: rounding alone, odd perturbations, and their predicted growth."""
    return panels.draw_cases(data, _draw_odd_part, r"odd part / whole, $\ell^2$ norms")


def _draw_odd_part(axes: Axes, case: xr.Dataset) -> None:
    for member in range(case.sizes["member"]):
        curve = panels.positive(case["perturbed"].isel(member=member))
        label = "from odd perturbations" if member == 0 else None
        axes.plot(curve["tau"], curve, color=LIGHT, lw=0.6, label=label)
    curve = panels.positive(case["rounded"])
    axes.plot(curve["tau"], curve, color=style.BLUE, lw=1, label="by rounding alone")
    look = {"color": "black", "lw": 0.9, "dashes": (3, 1.5)}
    axes.plot(case["predicted_tau"], case["predicted"], label="tangent dynamics", **look)
    axes.set_ylim(1e-17, 10)


def gather_ensembles(ensembles: xr.Dataset, comparison: xr.Dataset) -> xr.Dataset:
    """Return the pair's bands, and all that they are compared with (see `ensembles.compare`)."""
    return comparison[COMPARED].assign(l2=ensembles["l2"].sel(quantity="pair", drop=True))


@style.styled
def draw_ensembles(data: xr.Dataset) -> Figure:
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
    figure.legend(handles=_ensembles_legend(data), loc="outside upper center", ncols=3)
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
    panels.half_width_axis(axes)
    tops = sweep["l2_mean"] + sweep["l2_deviation"], sweep["swept_run"]
    axes.set_ylim(0, 1.08 * max(float(top.max()) for top in tops))
    axes.set_xlabel("half-width $M$")
    axes.set_ylabel(f"largest {NORM} on {sweep['swept_window'].item()}")
    labels = {"swept_omega": "omega", "swept_initial": "initial"}
    axes.set_title(style.name_case(sweep[list(labels)].rename(labels)), loc="left")


def _ensembles_legend(data: xr.Dataset) -> list:
    true = [Line2D([], [], label="the true run", **{**TRUE, "lw": 1.2})]
    whose = "its own" if "other_solvers" in data.attrs else "the paper's"
    bands = [
        Patch(color=colour, label=f"{100 * low:g} to {100 * high:g} % of the ensemble")
        for (low, high), colour in BANDS
    ]
    return [
        *bands,
        Line2D([], [], label="median", **MEDIAN),
        *(true if data["true"].notnull().any() else ()),
        Line2D([], [], label="mean and standard deviation", **MEAN),
        Line2D([], [], label=f"one run by {whose} solver", **{**OWN_DOT, "linestyle": "-"}),
    ]
