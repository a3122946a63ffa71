"""The chain without ends: norms against time, and the powers of time that they follow."""

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from pendula.drawing import style
from pendula.measures.growth import local_powers

LOOKS = {
    "fig4_small": {"color": style.RED, "ls": "-"},
    "fig3_large": {"color": style.BLUE, "ls": "-"},
    "fig2_large": {"color": "#16876b", "ls": "--"},
    "fig3_small": {"color": "#b07800", "ls": ":"},
}
POINTS, OCTAVES = 120, 4
NORMS = {"l2": r"$\ell^2$", "linf": r"$\ell^\infty$"}
RANGE = ["lowest", "mean", "highest"]


def gather(runs: dict[str, xr.Dataset], thermal: xr.Dataset) -> xr.Dataset:
    """Return the ensembles' norms at times equally spaced in log tau, and their local powers.

    Beside them, where the chain at rest is unstable, the law of a front at the speed v of linear
    spreading with a thermal sea of the power P behind it: l2 = (2 v P tau)^(1/2).
    """
    cases = [_read(run) for run in runs.values()]
    laws = [_law(run, thermal) for run in runs.values()]
    data = style.join(cases, list(runs), "case", "case of the paper, on a chain without ends")
    title = "coefficient of tau^(1/2) by linear spreading and the thermal sea"
    data["law"] = ("case", laws, {"long_name": title, "units": "1"})
    data["statistic"].attrs = {"long_name": "over the ensemble", "units": "1"}
    return data


def _law(run: xr.Dataset, thermal: xr.Dataset) -> float:
    """Return (2 v P)^(1/2), NaN where the chain at rest is stable or no state was sampled."""
    run = run.isel(variant=0)
    near = thermal.sel(omega=run["omega"], method="nearest")
    if not (run["predicted_delay"] > 0 and abs(near["omega"] - run["omega"]) < 1e-9):
        return float("nan")
    return float(np.sqrt(2.0 * run["predicted_speed"] * near["power"]))


def _read(run: xr.Dataset) -> xr.Dataset:
    run = run.isel(variant=0)
    tau = run["tau"].values
    grid = np.geomspace(1.0, tau[-1], POINTS)
    read = xr.Dataset({"tau": ("point", grid, {"long_name": "slow time", "units": "1"})})
    for name, title in NORMS.items():
        values = run[name].transpose("member", "tau").values
        drawn = np.array([np.interp(grid, tau, series) for series in values])
        band = [drawn.min(axis=0), drawn.mean(axis=0), drawn.max(axis=0)]
        attrs = {"long_name": f"{title} norm of (A, B)", "units": "1"}
        read[name] = (("statistic", "point"), np.array(band), attrs)
        middles, powers = local_powers(tau, values, OCTAVES)
        attrs = {"long_name": f"power of tau in the {title} norm, and its error", "units": "1"}
        read[f"{name}_power"] = (("octave", "part"), np.array(powers), attrs)
    read["middle"] = ("octave", middles, {"long_name": "middle of an octave of tau", "units": "1"})
    named = {"long_name": "power, or its standard error", "units": "1"}
    read["part"] = ("part", ["power", "error"], named)
    return read.assign_coords(statistic=RANGE).assign_attrs(run.attrs)


@style.styled
def draw(data: xr.Dataset) -> Figure:
    """Draw l2 with its law, the local powers of l2, and l-infinity."""
    figure = style.new_figure(style.DOUBLE, 2.9)
    l2, powers, linf = figure.subplots(1, 3)
    for axes, name in ((l2, "l2"), (linf, "linf")):
        _draw_norm(axes, data, name)
    _draw_law(l2, data)
    _draw_powers(powers, data)
    l2.set_yscale("log")
    powers.set_xlim(8.0, l2.get_xlim()[1])
    handles, labels = linf.get_legend_handles_labels()
    figure.legend(handles, labels, loc="outside upper center", ncols=2)
    return figure


def _draw_norm(axes: Axes, data: xr.Dataset, name: str) -> None:
    for case in data["case"].values:
        one = data.sel(case=case)
        look = {"label": style.name_case(one), "lw": 1.1, **LOOKS[str(case)]}
        axes.plot(one["tau"], one[name].sel(statistic="mean"), **look)
        low, high = (one[name].sel(statistic=bound) for bound in ("lowest", "highest"))
        axes.fill_between(one["tau"], low, high, color=look["color"], alpha=0.25, lw=0)
    axes.set_xscale("log")
    axes.set_xlabel(r"$\tau$")
    axes.set_ylabel(f"{NORMS[name]} of $(A, B)$")
    if name == "linf":
        axes.set_ylim(bottom=0)


def _draw_law(axes: Axes, data: xr.Dataset) -> None:
    for case in data["case"].values:
        one = data.sel(case=case)
        if np.isfinite(one["law"]):
            law = float(one["law"]) * np.sqrt(one["tau"])
            axes.plot(one["tau"], law, color="black", lw=0.9, ls=(0, (4, 2)))
            middle = data.sizes["point"] // 2
            axes.annotate(
                r"$(2 v^* P\,\tau)^{1/2}$",
                (float(one["tau"][middle]), float(law[middle])),
                (-3, 5),
                textcoords="offset points",
                ha="right",
            )


def _draw_powers(axes: Axes, data: xr.Dataset) -> None:
    axes.axhline(0.5, color="black", lw=0.8)
    for i, case in enumerate(data["case"].values):
        one = data.sel(case=case)
        power = one["l2_power"].sel(part="power").values
        error = one["l2_power"].sel(part="error").values
        aside = 1.0 + 0.04 * (i - 1.5)  # so that error bars stand beside each other
        look = {"color": LOOKS[str(case)]["color"], "marker": "osD^"[i], "ms": 3.5, "lw": 0}
        axes.errorbar(aside * one["middle"], power, error, elinewidth=0.9, capsize=2, **look)
    axes.set_xscale("log")
    axes.set_xlabel(r"$\tau$ (octaves)")
    axes.set_ylabel(r"power of $\tau$ in $\ell^2$")
