"""Chaos in pictures: exponents, lost evenness, ensembles beside the paper's runs, and lifetimes."""

import numpy as np
import xarray as xr
from matplotlib import colormaps
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from pendula.drawing import panels, style
from pendula.numerics.elementary import exp, geometric, log
from pendula.problem import is_even

NORM = r"$\ell^2$ norm"

# --- Exponents ------------------------------------------------------------------------------------

COLOURS = {8.0: "#e0a100", -4.0: style.BLUE, 0.0: style.RED}
"""By detuning, of different lightness."""
WIDTHS = {"small": 0.7, "large": 1.5}
DASHES = {"even": (None, None), "odd": (3, 1.5)}
MARKERS = ["o", "s", "^", "D"]
GROWTH = ["running", "exponents", "exponents_error", "divergence_predicted", "divergence_measured"]


def gather_lyapunov(lyapunov: xr.Dataset) -> xr.Dataset:
    """Return what is drawn: rates on their way, the spectra, and divergence times."""
    later = lyapunov.isel(tau=slice(1, None))
    running = later["log_growth"] / later["tau"]
    running.attrs = {"long_name": "mean rate of growth since the start, per unit of tau"}
    return later.assign(running=running)[[*GROWTH, "omega", "initial"]]


@style.styled
def draw_lyapunov(data: xr.Dataset) -> Figure:
    """Draw the rates of growth, all exponents of short chains, and divergence times."""
    figure = style.new_figure(style.DOUBLE, 3.1)
    running, spectrum, times = figure.subplots(1, 3, width_ratios=(1.25, 1, 1))
    _draw_running(running, data)
    _draw_spectrum(spectrum, data)
    _draw_divergence(times, data)
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
    figure.legend(handles=cases + parities, loc="outside upper center", ncols=4)
    return figure


def _look(data: xr.Dataset, case: str) -> dict:
    colour = COLOURS.get(float(data["omega"].sel(case=case)), "0.5")
    return {"color": colour, "lw": WIDTHS.get(str(case).rpartition("_")[2], 1.0)}


def _marked(data: xr.Dataset, case: str) -> dict:
    """Return the same with a dot, hollow for small amplitudes."""
    look = _look(data, case)
    face = look["color"] if look["lw"] > 1 else "white"
    return {**look, "marker": "o", "markersize": 4, "markerfacecolor": face}


def _draw_running(axes: Axes, data: xr.Dataset) -> None:
    # equal steps of the logarithm, so that its axis is not crowded
    sampled = np.unique(geometric(1.0, data.sizes["tau"], 40).round().astype(int)) - 1
    for case in data["case"].values:
        for parity in data["parity"].values:
            shown = abs(data["running"].sel(case=case, parity=parity).isel(tau=sampled))
            axes.plot(shown["tau"], shown, dashes=DASHES[parity], **_look(data, case))
    axes.set(xscale="log", yscale="log", xlim=(1, float(data["tau"].max())), ylim=(3e-4, 5))
    axes.set(xlabel=r"$\tau$", ylabel="mean rate of growth (per unit of $\\tau$)")
    axes.set_title("one small change", loc="left")


def _draw_spectrum(axes: Axes, data: xr.Dataset) -> None:
    axes.axhline(0.0, color="0.5", lw=0.6)
    chains = list(zip(MARKERS, data["spectrum_half_width"].values, strict=False))
    dot = {"linestyle": "none", "markersize": 3.5, "mew": 0}
    handles = [
        Line2D([], [], color="0.4", marker=marker, label=f"$M = {half_width}$", **dot)
        for marker, half_width in chains
    ]
    for case in data["spectrum_case"].values:
        colour = _look(data, case)["color"]
        for marker, half_width in chains:
            one = data.sel(spectrum_case=case, spectrum_half_width=half_width)
            rates, errors = one["exponents"], one["exponents_error"]
            place = (rates["index"] - 0.5) / float(rates.notnull().sum())
            axes.fill_between(place, rates - errors, rates + errors, color=colour, alpha=0.2, lw=0)
            look = {"color": colour, "marker": marker, "markersize": 2.2}
            axes.plot(place, rates, linestyle="none", mew=0, **look)
        label = rf"$\Omega = {float(data['omega'].sel(case=case)):g}$"
        handles.append(Line2D([], [], color=colour, lw=2, label=label))
    # the other half are the same with the opposite sign
    axes.set(xlim=(0, 0.52), ylim=(-0.2, None), xlabel="number of the exponent over $4N$")
    axes.set_ylabel("Lyapunov exponent (per unit of $\\tau$)")
    axes.set_title("all changes: the upper half", loc="left")
    axes.legend(handles=handles, loc="upper right", handlelength=1.2, handletextpad=0.5)


def _draw_divergence(axes: Axes, data: xr.Dataset) -> None:
    times = data[["divergence_predicted", "divergence_measured"]]
    tolerances = list(zip(MARKERS, data["rtol"].values, strict=False))
    for case in data["case"].values:
        look = _marked(data, case) | {"linestyle": "none"}
        for marker, rtol in tolerances:
            axes.plot(*times.sel(case=case, rtol=rtol).values(), **look | {"marker": marker})
    shown = times.to_array().isel(rtol=slice(len(tolerances)))
    top = 1.1 * max(1.0, float(shown.where(np.isfinite(shown)).max()))
    axes.plot([0, top], [0, top], color="black", lw=0.8)
    axes.set(xlim=(0, top), xlabel=r"predicted divergence time $\tau$")
    axes.set(ylim=(0, top), ylabel=r"measured divergence time $\tau$")
    axes.set_title("runs differ by 1 %", loc="left")
    look = {"color": "0.3", "linestyle": "none", "markersize": 4}
    handles = [
        Line2D([], [], marker=marker, label=rf"$10^{{{round(log(rtol) / log(10.0))}}}$", **look)
        for marker, rtol in tolerances
    ]
    axes.legend(handles=handles, title="tolerance", loc="lower right", handletextpad=0.1)


# --- Lost evenness --------------------------------------------------------------------------------


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
    # on a time of its own, coarser than that of the runs
    return symmetry[["rounded", "perturbed", "omega", "initial"]].assign(predicted=predicted)


@style.styled
def draw_symmetry(data: xr.Dataset) -> Figure:
    """Draw one panel a case: rounding alone, odd perturbations, and their predicted growth."""
    return panels.draw_cases(data, _draw_odd_part, r"odd part / whole, $\ell^2$ norms")


def _draw_odd_part(axes: Axes, case: xr.Dataset) -> None:
    for member in range(case.sizes["member"]):
        curve = panels.positive(case["perturbed"].isel(member=member))
        label = "from odd perturbations" if member == 0 else None
        axes.plot(curve["tau"], curve, color="#f2a15f", lw=0.6, label=label)
    curve = panels.positive(case["rounded"])
    axes.plot(curve["tau"], curve, color=style.BLUE, lw=1, label="by rounding alone")
    look = {"color": "black", "lw": 0.9, "dashes": (3, 1.5)}
    axes.plot(case["predicted_tau"], case["predicted"], label="tangent dynamics", **look)
    axes.set_ylim(1e-17, 10)


# --- Ensembles ------------------------------------------------------------------------------------

BANDS = [((0.05, 0.95), "#f9d3c0"), ((0.25, 0.75), "#ee9a75")]
MEDIAN = {"color": style.RED, "lw": 1.3}
MEAN = {"color": style.RED, "marker": "o", "markersize": 3, "linestyle": "none"}
OWN = {"color": style.BLUE, "lw": 0.6}
TRUE = {"color": "black", "lw": 0.6}
OWN_DOT = {"color": style.BLUE, "marker": "x", "markersize": 4, "linestyle": "none"}
COMPARED = ["omega", "initial", "run", "true", "run_inside", "l2_mean", "l2_deviation"]
COMPARED += ["swept_run", "swept_window", "swept_omega", "swept_initial"]


def gather_ensembles(ensembles: xr.Dataset, comparison: xr.Dataset) -> xr.Dataset:
    """Return the pair's bands, and what they are compared with (see `ensembles.compare_runs`)."""
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
    true = [Line2D([], [], label="the true run", **{**TRUE, "lw": 1.2})]
    whose = "its own" if "other_solvers" in data.attrs else "the paper's"
    bands = [
        Patch(color=colour, label=f"{100 * low:g} to {100 * high:g} % of the ensemble")
        for (low, high), colour in BANDS
    ]
    handles = [
        *bands,
        Line2D([], [], label="median", **MEDIAN),
        *(true if data["true"].notnull().any() else ()),
        Line2D([], [], label="mean and standard deviation", **MEAN),
        Line2D([], [], label=f"one run by {whose} solver", **{**OWN_DOT, "linestyle": "-"}),
    ]
    figure.legend(handles=handles, loc="outside upper center", ncols=3)
    return figure


def _draw_bands(axes: Axes, case: xr.Dataset) -> None:
    for (low, high), colour in BANDS:
        edges = (case["l2"].sel(quantile=quantile) for quantile in (low, high))
        axes.fill_between(case["tau"], *edges, color=colour, lw=0)
    axes.plot(case["tau"], case["l2"].sel(quantile=0.5), **MEDIAN)
    axes.plot(case["tau"], case["true"], **TRUE)
    axes.plot(case["tau"], case["run"], **OWN)
    axes.set(xlim=(0, float(case["tau"].max())), xlabel=r"$\tau$")
    axes.set_title(style.name_case(case), loc="left")


def _draw_sweep(axes: Axes, sweep: xr.Dataset) -> None:
    axes.errorbar(
        sweep["half_width"], sweep["l2_mean"], sweep["l2_deviation"],
        elinewidth=0.8, capsize=2, **MEAN,
    )  # fmt: skip
    axes.plot(sweep["half_width"], sweep["swept_run"], **OWN_DOT)
    panels.half_width_axis(axes)
    tops = sweep["l2_mean"] + sweep["l2_deviation"], sweep["swept_run"]
    axes.set(ylim=(0, 1.08 * max(float(top.max()) for top in tops)), xlabel="half-width $M$")
    axes.set_ylabel(f"largest {NORM} on {sweep['swept_window'].item()}")
    labels = {"swept_omega": "omega", "swept_initial": "initial"}
    axes.set_title(style.name_case(sweep[list(labels)].rename(labels)), loc="left")


# --- Lifetimes ------------------------------------------------------------------------------------

LINE = 0.075
"""The height of a line of text, as a share."""
BESIDE = 0.18
"""How far the marks of means are beside those of medians, in units of A_0."""
LIFETIMES_CAPTION = (
    "How long a motion of large amplitude stays localised on the central pair. (a): share of the "
    "runs that are still localised at τ, by initial amplitude A₀, with confidence intervals "
    "(bands). Grey: amplitudes at which runs have no common rate of transition. (b): median time "
    "of the transition, and its mean over the runs that are localised at τ = {settled}, with "
    "confidence intervals. Triangles are lower bounds."
)


def gather_lifetimes(lifetimes: xr.Dataset) -> xr.Dataset:
    """Return the shares that survive, median lives and rates, all with their limits."""
    ends = ("", "_low", "_high")
    shown = [f"{name}{end}" for name in ("surviving", "median", "rate") for end in ends]
    caption = LIFETIMES_CAPTION.format(settled=f"{float(lifetimes.attrs['settled']):g}")
    return lifetimes[shown].assign_attrs(caption=caption)


@style.styled
def draw_lifetimes(data: xr.Dataset) -> Figure:
    """Draw the share that is still localised against tau, and the life against A_0."""
    figure = style.new_figure(style.DOUBLE, 2.9)
    shares, lives = figure.subplots(1, 2, width_ratios=(1.2, 1))
    _draw_shares(shares, data)
    _draw_lives(lives, data)
    return figure


def _draw_shares(axes: Axes, data: xr.Dataset) -> None:
    tau, end = data["tau"], float(data["tau"][-1])
    # before chaos sets in all members have the same life
    differ = np.isfinite(data["rate"].values)
    fast, slow = data.isel(start_amplitude=~differ), data.isel(start_amplitude=differ)
    for share in fast["surviving"]:
        axes.step(tau, share, where="post", color="0.6", lw=0.8)
    free = -np.inf
    for k, a0 in enumerate(slow["start_amplitude"].values):
        one = slow.isel(start_amplitude=k)
        colour = colormaps["viridis"](0.85 * k / max(1, slow.sizes["start_amplitude"] - 1))
        band = one["surviving_low"], one["surviving_high"]
        axes.fill_between(tau, *band, step="post", color=colour, alpha=0.15, lw=0)
        axes.step(tau, one["surviving"], where="post", color=colour, lw=1.3)
        free = max(free + LINE, float(one["surviving"][-1]))
        axes.text(1.07 * end, free, f"$A_0 = {a0:g}$", color=colour, va="center", fontsize=7)
    if amplitudes := fast["start_amplitude"].values.tolist():
        last = f" to {amplitudes[-1]:g}" if len(amplitudes) > 1 else ""
        axes.text(0.93 * float(fast["median"].min()), 0.04, f"$A_0 = {amplitudes[0]:g}${last}",
                  color="0.45", fontsize=7, ha="right")  # fmt: skip
    axes.set(xscale="log", xlim=(1, end), xlabel=r"$\tau$")
    axes.set(ylim=(0, 1.03), ylabel="share of runs still localised")
    axes.set_title("(a) runs that have not changed over", loc="left")


def _draw_lives(axes: Axes, data: xr.Dataset) -> None:
    a0, end = data["start_amplitude"].values, float(data["tau"][-1])
    middle, low, high = (data[f"median{part}"].values for part in ("", "_low", "_high"))
    known = np.isfinite(middle)
    above = np.where(np.isfinite(high), high, end)
    bars = np.abs([middle[known] - low[known], above[known] - middle[known]])
    look = {"color": style.BLUE, "marker": "o", "markersize": 3.5, "elinewidth": 0.8, "capsize": 2}
    axes.errorbar(a0[known], middle[known], bars, linestyle="none", label="median", **look)
    later = np.where(np.isfinite(low), low, end)
    _draw_bounds(axes, a0[~known], later[~known], style.BLUE, "median at least")
    settled, seen, unseen = data.attrs["settled"], data["rate"].values > 0, data["rate"].values == 0
    rates = (data[f"rate{part}"].values for part in ("", "_high", "_low"))
    value, least, most = (settled + 1.0 / rate[seen] for rate in rates)
    look |= {"color": style.RED, "marker": "s"}
    axes.errorbar(
        a0[seen] + BESIDE, value, [value - least, most - value], linestyle="none",
        label=rf"mean, if localised at $\tau = {settled:g}$", **look,
    )  # fmt: skip
    least = settled + 1.0 / data["rate_high"].values[unseen]
    _draw_bounds(axes, a0[unseen] + BESIDE, least, style.RED, "mean at least")
    axes.set(yscale="log", xlabel="initial amplitude $A_0$", ylabel="life, units of $\\tau$")
    axes.set_title("(b) how long it takes", loc="left")
    axes.legend(loc="upper left", handletextpad=0.3)


def _draw_bounds(axes: Axes, a0: np.ndarray, least: np.ndarray, colour: str, label: str) -> None:
    """Draw lower bounds as triangles, if there are any."""
    if a0.size:
        axes.plot(a0, least, color=colour, marker="^", markersize=5, linestyle="none",
                  markerfacecolor="white", label=label)  # fmt: skip
