"""The front on the chain without ends: its speed, and the state that it leaves behind."""

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from ..unbounded.fronts import FRONT, SEA, speeds
from ..unbounded.linear_front import linear_front
from ..unbounded.sea import (
    LENGTH,
    TERMS,
    complex_pair,
    distribution,
    energy_terms,
    mean_powers,
    profile,
    sea_of,
    spectrum,
    with_ghosts,
)
from . import style

BINS, HIGHEST, MODULI, SPANS, LATE = 24, 1.2, 40, 36, 10
GREEN = "#16876b"
SEA_LOOK = {"color": style.RED, "lw": 1.1, "label": "behind the front"}
THERMAL_LOOK = {"color": "black", "lw": 0.9, "ls": "--", "label": "thermal"}
TERM_LOOKS = {
    "cubic": (style.RED, "-", "cubic"),
    "detuning": ("#b07800", "-.", "detuning"),
    "drive": (GREEN, "--", "drive"),
    "bonds": (style.BLUE, ":", "bonds"),
}


def _named(dims, values, title: str, units: str = "1"):
    return dims, np.asarray(values), {"long_name": title, "units": units}


def gather(
    omegas: xr.Dataset, sea: xr.Dataset, large: xr.Dataset, thermal: xr.Dataset
) -> xr.Dataset:
    """Return fronts over Omega, the way of one of them, and the means behind it.

    `large` is the run whose sea spreads where the chain at rest is stable; `thermal` are the
    states without energy that the sea is compared with.
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
            **_powers(omegas),
            **_thermal(thermal, constants[2]),
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


def _powers(omegas: xr.Dataset) -> dict:
    found = mean_powers(omegas)
    error = found.std(axis=1) / np.sqrt(max(1, found.shape[1] - 1))
    return {
        "power": _named("omega", found.mean(axis=1), "mean power |A_n|^2 + |B_n|^2 of the sea"),
        "power_error": _named("omega", error, "its standard error over the ensemble"),
    }


def _thermal(thermal: xr.Dataset, omega: float) -> dict:
    one = thermal.sel(omega=omega, method="nearest")
    return {
        "thermal_omega": _named("state", thermal["omega"].values, "detuning of the thermal states"),
        "thermal_power": _named("state", thermal["power"].values, "mean power, thermal state"),
        "thermal_modulus": _named("cell", one["modulus"].values, "modulus |A_n| or |B_n|"),
        "thermal_density": _named("cell", one["density"].values, "its density, thermal state"),
        "thermal_spectrum": _named("wave", one["spectrum"].values, "|A(k)|^2, thermal state"),
    }


def _way(sea: xr.Dataset) -> dict:
    front = sea["front"].isel(variant=0).sel(level=FRONT)
    tau = sea["piece_tau"].values
    v, delay = (float(sea[name].isel(variant=0)) for name in ("predicted_speed", "predicted_delay"))
    behind = (front.transpose("member", "piece_tau").values - v * tau).mean(axis=0)
    # a front stands on whole sites: means over short spans of log time show where it is
    spans = np.digitize(np.log(tau), np.linspace(np.log(tau[0]), np.log(tau[-1]), SPANS))
    found = [spans == span for span in np.unique(spans)]
    return {
        "way_tau": _named("time", [tau[span].mean() for span in found], "slow time"),
        "behind": _named("time", [behind[span].mean() for span in found], "front minus v tau"),
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
    }


@style.styled
def draw(data: xr.Dataset) -> Figure:
    """Draw the front (its way, speed and delay), then the state behind it."""
    figure = style.new_figure(style.DOUBLE, 4.6)
    above = (_draw_positions, _draw_speeds, _draw_way, _draw_powers)
    below = (_draw_terms, _draw_spectrum, _draw_moduli)
    rows = figure.subfigures(2, 1)
    for row, parts in zip(rows, (above, below), strict=True):
        for axes, part in zip(row.subplots(1, len(parts)), parts, strict=True):
            part(axes, data)
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
    axes.set_ylim(top=1.9 * float(data["front"].max()))
    axes.legend(loc="upper left", handlelength=1.4)


def _draw_speeds(axes: Axes, data: xr.Dataset) -> None:
    axes.plot(data["line_omega"], data["predicted"], color="black", lw=0.9, label="linear")
    look = {"color": style.RED, "marker": "o", "ms": 3.5, "lw": 0, "elinewidth": 0.9}
    axes.errorbar(data["omega"], data["speed"], data["speed_error"], label="measured", **look)
    low, high = -2 * data.attrs["gamma"], 2 * data.attrs["gamma"] + 4 * data.attrs["epsilon"]
    axes.axvspan(low, high, color="0.92", zorder=0)
    axes.set_xlabel(r"$\Omega$")
    axes.set_ylabel(r"speed (sites per unit of $\tau$)")
    axes.legend(loc="lower center", handlelength=1.2)


def _draw_way(axes: Axes, data: xr.Dataset) -> None:
    tau = data["way_tau"].values
    axes.plot(tau, data["behind"], "o", color=style.RED, ms=2.5)
    line = -float(data["delay"]) * np.log(tau)
    line += float(data["behind"][-LATE:].mean()) - line[-LATE:].mean()
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
    for name, look in (("spectrum", SEA_LOOK), ("thermal_spectrum", THERMAL_LOOK)):
        values = data[name].values
        both = 0.5 * (values + np.roll(values[::-1], 1))  # k and -k alike
        half = slice(0, len(values) // 2 + 1)
        axes.plot(data["wave_number"][half] / np.pi, both[half], **look)
    axes.set_ylim(0, 1.45 * float(data["spectrum"].max()))
    axes.set_xlabel(r"wave number $k / \pi$")
    axes.set_ylabel(rf"mean $|A(k)|^2$, $\Omega = {data.attrs['omega']:g}$")
    axes.legend(loc="upper left")


def _draw_moduli(axes: Axes, data: xr.Dataset) -> None:
    measured = data["density"].where(data["density"] > 0)
    thermal = data["thermal_density"].where(data["thermal_density"] > 0)
    axes.plot(data["modulus"], measured, **SEA_LOOK)
    axes.plot(data["thermal_modulus"], thermal, **THERMAL_LOOK)
    axes.set_yscale("log")
    axes.set_xlim(0, 1.02 * float(data["modulus"].max()))
    axes.set_ylim(0.5 * float(measured.min()), 20.0 * float(measured.max()))
    axes.set_xlabel("modulus $|A_n|$, $|B_n|$")
    axes.set_ylabel(rf"density of the moduli, $\Omega = {data.attrs['omega']:g}$")
    axes.legend(loc="upper right")


def _draw_powers(axes: Axes, data: xr.Dataset) -> None:
    look = {"color": style.RED, "marker": "o", "ms": 3.5, "lw": 0, "elinewidth": 0.9}
    axes.plot(data["thermal_omega"], data["thermal_power"], **THERMAL_LOOK)
    axes.errorbar(data["omega"], data["power"], data["power_error"], label="sea", **look)
    axes.set_ylim(bottom=0)
    axes.set_xlabel(r"$\Omega$")
    axes.set_ylabel("mean power per site")
    axes.legend(loc="upper right")
