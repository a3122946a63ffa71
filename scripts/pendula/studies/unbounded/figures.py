"""Figures of infinite chains: norms against time, and the two fronts against Omega."""

from collections.abc import Sequence

import numpy as np
import xarray as xr
from latticode.drawing import panels, style
from latticode.numerics.elementary import geometric
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from replication.variables import ALL_TIMES, missing

from pendula.drawing import name_case

from .measured import law_of, with_first_choices

LOOKS = {
    "fig4_small": {"color": style.RED, "ls": "-", "lw": 1.1},
    "fig3_large": {"color": style.BLUE, "ls": "-", "lw": 1.1},
    "fig2_large": {"color": "#16876b", "ls": "--", "lw": 1.1},
    "fig3_small": {"color": "#b07800", "ls": ":", "lw": 1.1},
}
LAW = {"color": "black", "lw": 0.9, "ls": (0, (4, 2))}
CHAOTIC = ("fig4_small", "fig3_large")
"""The cases with visibly different members, for the legend of the bands."""
BAND_ALPHA = 0.3
FIRST_TAU, POINTS = 10.0, 120
BAND = ("lowest", "mean", "highest")
GROWTH_CAPTION = (
    "The infinite chain against τ. (a): the square of the ℓ² norm. (b): the ℓ∞ norm. "
    "(c): the square of the ℓ² norm divided by the law, if its states were solved. "
    "The dashed law follows from the thermal states behind the two fronts and the fronts' speeds. "
    "Bands reach from the lowest to the highest run of an ensemble."
)


def gather_growth_law(runs: Sequence[xr.Dataset], thermal: xr.Dataset) -> xr.Dataset:
    """Return the norms of the first variant of each run at times equally spaced in log tau.

    The law of l2^2 is added for cases with solved thermal states.
    """
    cases = xr.Variable("case", [run.attrs["name"] for run in runs])
    bands = xr.concat([_bands_of(run, thermal) for run in runs], cases, join="outer")
    bands["band"].attrs["long_name"] = "value over the members of the ensemble"
    bands["law"].attrs = {
        "long_name": "l2^2 by thermal states and speeds of fronts",
        **missing("no thermal state was solved"),
        **ALL_TIMES,
    }
    bands["initial"].attrs["long_name"] = "initial {site: [A, B]}"
    return bands.assign_attrs(title="Growth of the norms", caption=GROWTH_CAPTION)


def _bands_of(run: xr.Dataset, thermal: xr.Dataset) -> xr.Dataset:
    run = with_first_choices(run)
    known = all(thermal.attrs[name] == run.attrs[name] for name in ("epsilon", "gamma"))
    law = law_of(run, thermal)[0] if known else np.full(run.sizes["tau"], np.nan)
    norms = run[["l2", "linf"]].isel(variant=0)
    bands = [norms.min("member"), norms.mean("member"), norms.max("member")]
    data = xr.concat(bands, xr.Variable("band", list(BAND)))
    data = data.assign(omega=run["omega"][0], initial=run.attrs["initial"], law=("tau", law))
    times = geometric(FIRST_TAU, float(run["tau"][-1]), POINTS)
    return data.sel(tau=np.unique(data["tau"].sel(tau=times, method="nearest")))


@style.styled
def draw_growth_law(data: xr.Dataset) -> Figure:
    """Draw l2^2 with its law, l-infinity, and the ratio of l2^2 to its law."""
    figure = style.new_figure(style.WIDTH, 2.8)
    square, linf, ratio = figure.subplots(1, 3, sharex=True)
    for case in data["case"].values:
        case_data, look = data.sel(case=case), LOOKS[str(case)]
        tau = case_data["tau"]
        _draw_band(square, tau, case_data["l2"] ** 2, look, name_case(case_data))
        square.plot(tau, case_data["law"], **LAW)
        _draw_band(linf, tau, case_data["linf"], look)
        if case_data["law"].notnull().any():
            _draw_band(ratio, tau, case_data["l2"] ** 2 / case_data["law"], look)
    ratio.axhline(1.0, **LAW)
    square.set_yscale("log")
    square.set_xscale("log")
    for axis in (square.yaxis, square.xaxis, linf.xaxis, ratio.xaxis):
        axis.set_major_formatter("{x:g}")
    linf.set_ylim(bottom=0)
    square.set_ylabel(r"squared $\ell^2$ norm")
    ratio.set_ylabel(r"squared $\ell^2$ norm / law")
    linf.set_ylabel(rf"{panels.NORMS['linf']} norm")
    for axes, letter in ((square, "a"), (linf, "b"), (ratio, "c")):
        axes.set_title(f"({letter})", loc="left")
        axes.set_xlabel(r"$\tau$")
    handles, labels = square.get_legend_handles_labels()
    bands = tuple(Patch(color=LOOKS[case]["color"], alpha=BAND_ALPHA, lw=0) for case in CHAOTIC)
    handles += [Line2D([], [], **LAW), bands]
    labels += ["law in the text", "range of the ensemble"]
    style.legend_above(figure, handles, labels, ncols=2, fontsize=style.WITH_INDICES)
    return figure


def _draw_band(
    axes: Axes, tau: xr.DataArray, bands: xr.DataArray, look: dict, label: str | None = None
) -> None:
    """Draw the mean of an ensemble and the range of its members."""
    mean, low, high = (bands.sel(band=bound) for bound in ("mean", "lowest", "highest"))
    axes.plot(tau, mean, label=label, **look)
    axes.fill_between(tau, low, high, color=look["color"], alpha=BAND_ALPHA, lw=0)


# --- The two fronts -------------------------------------------------------------------------------

DOTS = {"marker": "o", "ms": 3.0, "lw": 0, "elinewidth": 0.9, "capsize": 1.5}
FIRST = {**DOTS, "color": style.RED}
SECOND = {**DOTS, "color": style.BLUE, "marker": "s", "mfc": "white", "mew": 0.8}
LINE = LAW | {"ls": "-"}
CHAIN = ("epsilon", "gamma")
"""Attributes that are equal if two studies are of the same chain."""
FRONTS_CAPTION = (
    "The two fronts on the infinite chain. (a): their speeds; lines are predictions, dotted for "
    "the second front from a longer study. (b): the power per pair behind the second front and "
    "between the fronts, divided by that of the thermal state of both fields; dashed: the same "
    "ratio for the thermal state with A = −B. Bars are confidence intervals of the mean."
)


def gather_fronts(fronts: xr.Dataset, long: xr.Dataset | None = None) -> xr.Dataset:
    """Return the dataset of `measure_fronts` with the predicted speed of the second front.

    The prediction is from the `long` study. It is NaN if that study is of another chain.
    """
    speed = xr.full_like(fronts["linear_speed"], np.nan, float)
    if long is not None and all(long.attrs[name] == fronts.attrs[name] for name in CHAIN):
        near = {"method": "nearest", "tolerance": 1e-9}
        speed = long["predicted_second_speed"].reindex(omega=fronts["omega"].values, **near)
    attributes = {"long_name": "predicted speed of the second front, in sites per unit of tau"}
    predicted = "omega", speed.values, attributes
    return fronts.assign(predicted_second_speed=predicted).assign_attrs(caption=FRONTS_CAPTION)


@style.styled
def draw_fronts(data: xr.Dataset) -> Figure:
    """Draw the speeds of both fronts, and the ratios of powers to thermal ones, against Omega."""
    figure = style.new_figure(style.WIDTH, 2.2)
    speeds, powers = figure.subplots(1, 2)
    omega, thermal = data["omega"], data["thermal_power"]
    speeds.plot(omega, data["linear_speed"], **LINE)
    speeds.plot(omega, data["predicted_second_speed"], **LAW | {"ls": ":"})
    powers.axhline(1.0, **LINE)
    powers.plot(omega, data["thermal_antisymmetric_power"] / thermal, **LAW)
    for axes, name, over, look, label in (
        (speeds, "front_speed", 1.0, FIRST, "first"),
        (speeds, "second_front_speed", 1.0, SECOND, "second"),
        (powers, "power_between", thermal, FIRST, "between"),
        (powers, "power_behind", thermal, SECOND, "behind both"),
    ):
        limits = data[f"{name}_error"] / over
        bars = limits.where(np.isfinite(limits))
        axes.errorbar(omega, data[name] / over, bars, label=label, **look)
    speeds.set_ylim(bottom=0)
    powers.set_ylim(bottom=0.6)
    speeds.set_ylabel(r"speed (sites per $\tau$)")
    powers.set_ylabel("power / thermal power")
    for axes, letter in ((speeds, "a"), (powers, "b")):
        axes.set_title(f"({letter})", loc="left")
        axes.set_xlabel(r"$\Omega$")
        axes.legend(loc="lower left", handlelength=1.0)
    return figure
