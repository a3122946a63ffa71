"""The front on the chain without ends: its speed, and the state that it leaves behind."""

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from ..unbounded.fronts import FRONT, SEA, speeds
from ..unbounded.linear_front import linear_front
from ..unbounded.sea import (
    TERMS,
    complex_pair,
    distribution,
    energy_terms,
    profile,
    sea_of,
    spectrum,
    with_ghosts,
)
from . import style

BINS, LENGTH, HIGHEST, MODULI = 24, 64, 1.2, 40
GREEN = "#16876b"
TERM_LOOKS = {
    "cubic": (style.RED, "-", "cubic"),
    "detuning": ("#b07800", "-.", "detuning"),
    "drive": (GREEN, "--", "drive"),
    "bonds": (style.BLUE, ":", "bonds"),
}


def _named(dims, values, title: str, units: str = "1"):
    return dims, np.asarray(values), {"long_name": title, "units": units}


def gather(omegas: xr.Dataset, sea: xr.Dataset, large: xr.Dataset) -> xr.Dataset:
    """Return fronts over Omega, the way of one of them, and the means behind it.

    `large` is the run whose sea spreads where the chain at rest is stable.
    """
    constants = tuple(float(sea.attrs[name]) for name in ("epsilon", "gamma", "omega"))
    measured, errors = speeds(omegas)
    grid = np.linspace(-4.0, 8.0, 97)
    epsilon, gamma, _ = constants
    lines = [linear_front(epsilon, gamma, omega).speed for omega in grid]
    title = "front speed (sites per unit of tau)"
    data = xr.Dataset(
        {
            "speed": _named("omega", measured, f"measured {title}"),
            "speed_error": _named("omega", errors, f"standard error of the {title}"),
            "predicted": _named("line_omega", lines, f"linear spreading, {title}"),
            **_positions(omegas, large),
            **_way(sea),
            **_behind(sea, constants),
        },
        {
            "omega": _named("omega", omegas["omega"].values, "detuning Omega"),
            "line_omega": _named("line_omega", grid, "detuning Omega"),
        },
    )
    return data.assign_attrs(
        omega=constants[2], gamma=gamma, epsilon=epsilon, large_omega=large.attrs["omega"]
    )


def _positions(omegas: xr.Dataset, large: xr.Dataset) -> dict:
    """Return the fronts of the ensembles' first members against time."""
    first = omegas["front"].sel(level=FRONT).isel(member=0)
    of_sea = large["front"].sel(level=SEA).isel(variant=0, member=0)
    return {
        "tau": _named("piece", omegas["piece_tau"].values, "slow time"),
        "front": _named(("omega", "piece"), first.values, "site of the front"),
        "large_tau": _named("large_piece", large["piece_tau"].values, "slow time, stable chain"),
        "large_front": _named(
            "large_piece", of_sea.values, "site where the sea ends, stable chain, large data"
        ),
    }


def _way(sea: xr.Dataset) -> dict:
    front = sea["front"].isel(variant=0).sel(level=FRONT)
    tau = sea["piece_tau"].values
    v, delay = (float(sea[name].isel(variant=0)) for name in ("predicted_speed", "predicted_delay"))
    behind = front.transpose("member", "piece_tau").values - v * tau
    return {
        "way_tau": _named("time", tau, "slow time"),
        "behind": _named(("member", "time"), behind, "front's site minus v tau"),
        "delay": _named((), delay, "sites lost per unit of log tau, predicted"),
    }


def _behind(sea: xr.Dataset, constants: tuple) -> dict:
    """Return profiles, spectrum and distribution of the final states of all members."""
    states = [with_ghosts(state) for state in sea["state"].isel(variant=0).values]
    fronts = sea["front"].isel(variant=0, piece_tau=-1).sel(level=FRONT).values.astype(int)
    edges = np.linspace(0.0, HIGHEST, BINS + 1)
    terms, spectra, moduli = [], [], []
    for state, front in zip(states, fronts, strict=True):
        sites = (edges * front).astype(int)
        terms.append(profile(energy_terms(state, constants), sites))
        inside = sea_of(state, front)
        for amplitude in complex_pair(state):
            spectra.append(spectrum(amplitude[inside], LENGTH))
            moduli.append(np.abs(amplitude[inside]))
    moduli = np.concatenate(moduli)
    cells = np.linspace(0.0, 1.05 * moduli.max(), MODULI + 1)
    return {
        "terms": _named(("term", "bin"), np.mean(terms, axis=0), "terms of H per site"),
        "term": _named("term", list(TERMS), "term of the energy (8)"),
        "scaled_site": _named("bin", 0.5 * (edges[1:] + edges[:-1]), "site over that of the front"),
        "spectrum": _named("wave", np.mean(spectra, axis=0), "mean |A(k)|^2 behind the front"),
        "wave_number": _named(
            "wave", 2.0 * np.pi * np.arange(LENGTH) / LENGTH, "wave number", "rad"
        ),
        "density": _named("modulus", distribution(moduli, cells), "density of |A_n| and |B_n|"),
        "modulus": _named("modulus", 0.5 * (cells[1:] + cells[:-1]), "modulus |A_n| or |B_n|"),
        "mean_square": _named((), np.mean(moduli**2), "mean of |A_n|^2 and |B_n|^2"),
    }


@style.styled
def draw(data: xr.Dataset) -> Figure:
    """Draw the front above (its way, speed and delay), the state behind it below."""
    figure = style.new_figure(style.DOUBLE, 4.4)
    (positions, speed, way), (terms, spectrum_axes, moduli) = figure.subplots(2, 3)
    _draw_positions(positions, data)
    _draw_speeds(speed, data)
    _draw_way(way, data)
    _draw_terms(terms, data)
    _draw_spectrum(spectrum_axes, data)
    _draw_moduli(moduli, data)
    return figure


def _draw_positions(axes: Axes, data: xr.Dataset) -> None:
    middle = data["omega"].values[data.sizes["omega"] // 2]
    for omega, colour in ((middle, style.RED), (data["omega"].values[0], GREEN)):
        label = rf"$\Omega = {omega:g}$"
        axes.plot(data["tau"], data["front"].sel(omega=omega), color=colour, lw=1.4, label=label)
        speed = np.interp(omega, data["line_omega"], data["predicted"])
        ends = np.array([0.0, float(data["tau"][-1])])
        axes.plot(ends, speed * ends, color="black", lw=0.7, ls="--")
    axes.lines[-1].set_label("linear")
    shown = data["large_tau"].values <= float(data["tau"][-1])
    label = rf"$\Omega = {float(data.attrs['large_omega']):g}$, large"
    sea = data["large_front"].values
    axes.plot(data["large_tau"].values[shown], sea[shown], color=style.BLUE, lw=1.1, label=label)
    axes.set_xlabel(r"$\tau$")
    axes.set_ylabel("site of the front")
    axes.legend(loc="upper left")


def _draw_speeds(axes: Axes, data: xr.Dataset) -> None:
    axes.plot(data["line_omega"], data["predicted"], color="black", lw=0.9, label="linear")
    look = {"color": style.RED, "marker": "o", "ms": 3.5, "lw": 0, "elinewidth": 0.9}
    axes.errorbar(data["omega"], data["speed"], data["speed_error"], label="measured", **look)
    low, high = -2 * data.attrs["gamma"], 2 * data.attrs["gamma"] + 4 * data.attrs["epsilon"]
    axes.axvspan(low, high, color="0.92", zorder=0)
    axes.set_xlabel(r"$\Omega$")
    axes.set_ylabel(r"speed (sites per unit of $\tau$)")
    axes.legend(loc="lower center")


def _draw_way(axes: Axes, data: xr.Dataset) -> None:
    tau = data["way_tau"].values
    for series in data["behind"].values:
        axes.plot(tau, series, ".", color=style.RED, ms=1.5)
    line = -float(data["delay"]) * np.log(tau)
    middle = len(tau) // 2
    line += float(data["behind"][:, middle:].mean()) - line[middle:].mean()
    axes.plot(tau, line, color="black", lw=0.9)
    axes.text(0.05, 0.08, r"line: $-\frac{3}{2\lambda}\,\ln\tau$", transform=axes.transAxes)
    axes.set_xscale("log")
    axes.set_xlabel(r"$\tau$")
    axes.set_ylabel(rf"front $- v^*\tau$ (sites), $\Omega = {data.attrs['omega']:g}$")


def _draw_terms(axes: Axes, data: xr.Dataset) -> None:
    for term, (colour, dashes, label) in TERM_LOOKS.items():
        values = data["terms"].values[list(data["term"].values).index(term)]
        if np.any(values):
            axes.plot(data["scaled_site"], values, color=colour, ls=dashes, lw=1.1, label=label)
    axes.plot(data["scaled_site"], data["terms"].sum("term"), color="black", lw=1.1, label="sum")
    axes.set_ylim(top=1.75 * float(data["terms"].max()))
    axes.set_xlabel("site over that of the front")
    axes.set_ylabel("energy per site")
    axes.legend(loc="upper right", ncols=2, columnspacing=1.0, handlelength=1.6)


def _draw_spectrum(axes: Axes, data: xr.Dataset) -> None:
    half = data.isel(wave=slice(0, data.sizes["wave"] // 2 + 1))
    other = np.roll(data["spectrum"].values[::-1], 1)[: half.sizes["wave"]]
    axes.plot(
        half["wave_number"] / np.pi, 0.5 * (half["spectrum"] + other), color=style.RED, lw=1.1
    )
    axes.set_ylim(bottom=0)
    axes.set_xlabel(r"wave number $k / \pi$")
    axes.set_ylabel(r"mean $|A(k)|^2$ behind the front")


def _draw_moduli(axes: Axes, data: xr.Dataset) -> None:
    measured = data["density"].where(data["density"] > 0)
    axes.plot(data["modulus"], measured, color=style.RED, lw=1.1, label="behind the front")
    axes.plot(data["modulus"], _rayleigh(data), color="0.35", ls="--", label="Gaussian waves")
    axes.set_yscale("log")
    axes.set_ylim(0.5 * float(measured.min()), 20.0 * float(measured.max()))
    axes.set_xlabel("modulus $|A_n|$, $|B_n|$")
    axes.set_ylabel("density of the moduli")
    axes.legend(loc="upper right")


def _rayleigh(data: xr.Dataset) -> np.ndarray:
    mean, a = float(data["mean_square"]), data["modulus"].values
    return 2.0 * a / mean * np.exp(-(a**2) / mean)
