"""The chaotic state of the pendula, and first passages over the top, in a picture."""

import numpy as np
import xarray as xr
from matplotlib import colormaps
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import NullLocator

from pendula.drawing import style

from .claims_state import thermal_beside

SEA = ("o", "s", "^", "D", "v")
MARKED = {"markersize": 3.2, "markerfacecolor": "none", "linestyle": "none", "mew": 0.8}
THERMAL = {"color": "0.6", "lw": 2.2, "zorder": 1}
COLOURS = colormaps["viridis"]
BESIDE = 0.025
"""Confidence limits at the end stand so far beside each other, as a part of the time."""
TOP_CAPTION = (
    "(a), (b): the chaotic state at Ω = {omega}, of pendula at each μ and of the amplitude "
    "equations (4), beside the thermal state of the infinite chain: spectrum, and distribution of "
    "the moduli. (c): share of the runs in which a pendulum has gone over the top by τ, with "
    "confidence intervals at the end. (d): the largest angle of any pendulum so far, as a mean "
    "over the runs; the top is at half a turn (dashed)."
)


def gather_over_the_top(sea: xr.Dataset, over_the_top: xr.Dataset, thermal: xr.Dataset):
    """Return spectra and distributions beside the thermal ones, and passages by mu."""
    cell = float(sea["modulus"][1] - sea["modulus"][0])
    means = sea[["wave_power", "modulus_share"]].mean("member", keep_attrs=True)
    density = (means["modulus_share"] / cell).assign_attrs(
        long_name="probability density of the modulus", units="1"
    )
    turns = (over_the_top["angle_so_far"] / (2.0 * np.pi)).mean("member", skipna=False)
    shown = {
        "wave_power": means["wave_power"].rename(mu="sea_mu"),
        "sea_density": density.rename(mu="sea_mu", modulus="sea_modulus"),
    }
    for name, one in thermal_beside(sea, thermal, "spectrum", "density").data_vars.items():
        about = f"{one.attrs['long_name']}, thermal state"
        shown[f"thermal_{name}"] = one.assign_attrs(long_name=about)
    shown["wave_number"] = thermal["wave_number"]
    shown["turns"] = turns.assign_attrs(
        long_name="largest angle of any pendulum so far in turns, mean over the members", units="1"
    )
    shown |= {name: over_the_top[name] for name in ("passed", "passed_low", "passed_high")}
    omega = sea.attrs["omega"]
    caption = TOP_CAPTION.format(omega=f"{float(omega):g}")
    return xr.Dataset(shown, attrs={"omega": omega, "caption": caption})


@style.styled
def draw_over_the_top(data: xr.Dataset) -> Figure:
    """Draw spectrum and distribution above; below, the share that has passed, and the angles."""
    figure = style.new_figure(style.DOUBLE, 4.9)
    (spectrum, density), (passed, turns) = figure.subplots(2, 2)
    colours = _colours(data)
    _draw_sea(spectrum, density, data, colours)
    named = _draw_passed(passed, data, colours)
    for mu in data["mu"].values:
        turns.plot(data["tau"], data["turns"].sel(mu=mu), color=colours[mu], lw=1.3)
    turns.axhline(0.5, color="0.6", dashes=(4, 2), zorder=1)
    turns.set(xscale="log", yscale="log", xlabel=r"$\tau$", ylabel="largest angle so far (turns)")
    turns.set_xlim(1.0, float(data["tau"].max()))
    turns.yaxis.set_minor_locator(NullLocator())
    turns.set_title("(d) how far they turn; dashed: the top", loc="left")
    figure.legend(handles=named, loc="outside lower center", ncols=len(named), fontsize=7.5,
                  handlelength=1.2, columnspacing=1.2)  # fmt: skip
    return figure


def _colours(data: xr.Dataset) -> dict:
    """Return one colour for each mu of all panels; the amplitudes, at mu = 0, are black."""
    mus = np.union1d(data["sea_mu"], data["mu"])
    mus = mus[mus > 0.0]
    return {0.0: "black"} | {
        mu: COLOURS(0.95 * i / max(1, len(mus) - 1)) for i, mu in enumerate(mus.tolist())
    }


def _name(mu: float) -> str:
    return rf"$\mu = {mu:g}$" if mu else "equations (4)"


def _draw_sea(spectrum: Axes, density: Axes, data: xr.Dataset, colours: dict) -> None:
    half = data["wave_number"] <= np.pi
    waves, thermal = data["wave_number"].values[half], data["thermal_spectrum"].values[half]
    if np.isfinite(thermal).any():
        spectrum.plot(waves, thermal, label="thermal, no ends", **THERMAL)
    density.plot(data["modulus"], data["thermal_density"], **THERMAL)
    for i, mu in enumerate(data["sea_mu"].values):
        one, mark = data.sel(sea_mu=mu), SEA[i % len(SEA)]
        look = {"color": colours[mu], **MARKED}
        spectrum.plot(one["even_wave"], one["wave_power"], mark, label=_name(mu), **look)
        density.plot(one["sea_modulus"], one["sea_density"], mark, **look)
    spectrum.set(xlabel="wave number $k$ (rad)", ylabel="mean $|A(k)|^2$", xlim=(0, np.pi))
    spectrum.set_ylim(0, None)
    spectrum.legend(fontsize=7, handletextpad=0.4)
    title = rf"(a) spectrum of the chaotic state at $\Omega = {data.attrs['omega']:g}$"
    spectrum.set_title(title, loc="left")
    density.set(xlabel="modulus $|A_n|$", ylabel="probability density")
    density.set_xlim(0, float(data["sea_modulus"].max()))
    density.set_ylim(0, None)
    density.set_title("(b) distribution of moduli", loc="left")


def _draw_passed(axes: Axes, data: xr.Dataset, colours: dict) -> list:
    """Draw the share that has gone over the top, with limits at the end; return the curves."""
    tau, lines = data["tau"].values, []
    for i, mu in enumerate(data["mu"].values):
        one, colour = data.sel(mu=mu), colours[mu]
        look = {"where": "post", "label": _name(mu), "color": colour, "lw": 1.3}
        lines += axes.step(tau, one["passed"], **look)
        last, low, high = (float(one[name][-1]) for name in ("passed", "passed_low", "passed_high"))
        axes.errorbar(tau[-1] * (1.03 + BESIDE * i), last, [[last - low], [high - last]], fmt="o",
                      markersize=2, capsize=1.5, elinewidth=0.9, color=colour)  # fmt: skip
    axes.set(xlabel=r"$\tau$", ylabel="share of members")
    axes.set_xlim(0, tau[-1] * (1.03 + BESIDE * data.sizes["mu"]))
    axes.set_ylim(-0.03, 1.05)
    axes.set_title("(c) gone over the top by then", loc="left")
    return lines
