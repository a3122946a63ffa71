"""The sea of the pendula at Omega = 0 in a picture, and who leaves it over the top."""

import numpy as np
import xarray as xr
from matplotlib import colormaps
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import NullLocator

from pendula.drawing import style

from .thermal_beside import thermal_beside

SEA = ("o", "s", "^", "D", "v")
MARKED = {"markersize": 3.2, "markerfacecolor": "none", "linestyle": "none", "mew": 0.8}
THERMAL = {"color": "0.6", "lw": 2.2, "zorder": 1}
COLOURS = colormaps["viridis"]
BESIDE = 0.025
"""Confidence limits at the end stand so far beside each other, as a part of the time."""
FIRST = 1.0
"""The axis of time is logarithmic from here on."""


def gather_over_the_top(sea: xr.Dataset, over_the_top: xr.Dataset, thermal: xr.Dataset):
    """Return the sea's spectra and distributions beside the thermal ones, and passages by mu."""
    omega = sea.attrs["omega"]
    cell = float(sea["modulus"][1] - sea["modulus"][0])
    means = sea[["wave_power", "modulus_share"]].mean("member", keep_attrs=True)
    density = (means["modulus_share"] / cell).assign_attrs(
        long_name="probability density of the modulus", units="1"
    )
    turns = over_the_top["angle_so_far"] / (2.0 * np.pi)
    known = thermal_beside(sea, thermal, "spectrum", "density")
    return xr.Dataset(
        {
            "wave_power": means["wave_power"].rename(mu="sea_mu"),
            "sea_density": density.rename(mu="sea_mu", modulus="sea_modulus"),
            **{
                f"thermal_{name}": known[name].assign_attrs(
                    long_name=f"{known[name].attrs['long_name']}, thermal state"
                )
                for name in ("spectrum", "density")
            },
            "wave_number": thermal["wave_number"],
            "turns": turns.mean("member", skipna=False).assign_attrs(
                long_name="largest angle of any pendulum so far in turns, mean over the members",
                units="1",
            ),
            **{name: over_the_top[name] for name in ("passed", "passed_low", "passed_high")},
        },
        attrs={"omega": omega},
    )


@style.styled
def draw_over_the_top(data: xr.Dataset) -> Figure:
    """Draw spectrum and distribution above; below, the share that has passed, and the angles."""
    figure = style.new_figure(style.DOUBLE, 4.9)
    (spectrum, density), (passed, turns) = figure.subplots(2, 2)
    _draw_spectrum(spectrum, data)
    _draw_density(density, data)
    named = _draw_passed(passed, data)
    _draw_turns(turns, data)
    figure.legend(handles=named, loc="outside lower center", ncols=len(named), fontsize=7.5,
                  handlelength=1.2, columnspacing=1.2)  # fmt: skip
    return figure


def _draw_spectrum(axes: Axes, data: xr.Dataset) -> None:
    half = data["wave_number"] <= np.pi
    waves, thermal = data["wave_number"].values[half], data["thermal_spectrum"].values[half]
    if np.isfinite(thermal).any():
        axes.plot(waves, thermal, label="thermal, no ends", **THERMAL)
    for mark, colour, mu in _seas(data):
        power = data["wave_power"].sel(sea_mu=mu)
        axes.plot(data["even_wave"], power, mark, color=colour, label=_name(mu), **MARKED)
    axes.set(xlabel="wave number $k$ (rad)", ylabel="mean $|A(k)|^2$", xlim=(0, np.pi))
    axes.set_ylim(0, None)
    axes.legend(fontsize=7, handletextpad=0.4)
    axes.set_title(rf"(a) spectrum of the sea at $\Omega = {data.attrs['omega']:g}$", loc="left")


def _seas(data: xr.Dataset):
    mus = data["sea_mu"].values
    for i, mu in enumerate(mus):
        yield SEA[i % len(SEA)], "black" if mu == 0 else COLOURS(0.85 * i / len(mus)), mu


def _name(mu: float) -> str:
    return rf"$\mu = {mu:g}$" if mu else "equations (4)"


def _draw_density(axes: Axes, data: xr.Dataset) -> None:
    axes.plot(data["modulus"], data["thermal_density"], **THERMAL)
    for mark, colour, mu in _seas(data):
        share = data["sea_density"].sel(sea_mu=mu)
        axes.plot(data["sea_modulus"], share, mark, color=colour, **MARKED)
    axes.set(xlabel="modulus $|A_n|$", ylabel="probability density")
    axes.set_xlim(0, float(data["sea_modulus"].max()))
    axes.set_ylim(0, None)
    axes.set_title("(b) distribution of moduli", loc="left")


def _passing(data: xr.Dataset):
    mus = data["mu"].values
    for i, mu in enumerate(mus):
        yield {"color": COLOURS(0.9 * i / max(1, len(mus) - 1)), "lw": 1.3}, data.sel(mu=mu)


def _draw_passed(axes: Axes, data: xr.Dataset) -> list:
    tau, lines = data["tau"].values, []
    for i, (look, one) in enumerate(_passing(data)):
        lines += axes.step(tau, one["passed"], where="post", label=_name(float(one["mu"])), **look)
        last, low, high = (float(one[name][-1]) for name in ("passed", "passed_low", "passed_high"))
        off = [[last - low], [high - last]]
        beside = tau[-1] * (1.03 + BESIDE * i)
        axes.errorbar(beside, last, off, fmt="o", markersize=2, capsize=1.5, elinewidth=0.9,
                      color=look["color"])  # fmt: skip
    axes.set(xlabel=r"$\tau$", ylabel="share of members")
    axes.set_xlim(0, tau[-1] * (1.03 + BESIDE * data.sizes["mu"]))
    axes.set_ylim(-0.03, 1.05)
    axes.set_title("(c) gone over the top by then", loc="left")
    return lines


def _draw_turns(axes: Axes, data: xr.Dataset) -> None:
    for look, one in _passing(data):
        axes.plot(data["tau"], one["turns"], **look)
    axes.axhline(0.5, color="0.6", dashes=(4, 2), zorder=1)
    axes.set(xscale="log", yscale="log", xlabel=r"$\tau$", ylabel="largest angle so far (turns)")
    axes.set_xlim(FIRST, float(data["tau"].max()))
    axes.yaxis.set_minor_locator(NullLocator())
    axes.set_title("(d) how far they turn; dashed: the top", loc="left")
