"""The state behind the front: what is drawn of it, as panels of the figure of the front."""

import numpy as np
import xarray as xr
from matplotlib.axes import Axes

from pendula.drawing import style
from pendula.problem import Constants

from .fronts import FRONT
from .sea import (
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

BINS, HIGHEST, MODULI = 24, 1.2, 40
"""Cells of a profile, how far it reaches beyond the front, and cells of a distribution."""

GREEN = "#16876b"
SEA_LOOK = {"color": style.RED, "lw": 1.1, "label": "behind the front"}
THERMAL_LOOK = {"color": "black", "lw": 0.9, "ls": "--", "label": "thermal"}
TERM_LOOKS = {
    "cubic": (style.RED, "-", "cubic"),
    "detuning": ("#b07800", "-.", "detuning"),
    "drive": (GREEN, "--", "drive"),
    "bonds": (style.BLUE, ":", "bonds"),
}


def named(dims, values, title: str, units: str = "1"):
    """Return a variable with its name for people and its units."""
    return dims, np.asarray(values), {"long_name": title, "units": units}


def gather(omegas: xr.Dataset, sea: xr.Dataset, thermal: xr.Dataset, constants: Constants) -> dict:
    """Return the variables of the panels; `constants` are those of `sea`."""
    return {**_behind(sea, constants), **_powers(omegas), **_thermal(thermal, constants.omega)}


def _powers(omegas: xr.Dataset) -> dict:
    found = mean_powers(omegas)
    error = found.std(axis=1) / np.sqrt(max(1, found.shape[1] - 1))
    return {
        "power": named("omega", found.mean(axis=1), "mean power |A_n|^2 + |B_n|^2 of the sea"),
        "power_error": named("omega", error, "its standard error over the ensemble"),
    }


def _thermal(thermal: xr.Dataset, omega: float) -> dict:
    one = thermal.sel(omega=omega, method="nearest")
    return {
        "thermal_omega": named("state", thermal["omega"].values, "detuning of the thermal states"),
        "thermal_power": named("state", thermal["power"].values, "mean power, thermal state"),
        "thermal_modulus": named("cell", one["modulus"].values, "modulus |A_n| or |B_n|"),
        "thermal_density": named("cell", one["density"].values, "its density, thermal state"),
        "thermal_spectrum": named("wave", one["spectrum"].values, "|A(k)|^2, thermal state"),
    }


def _behind(sea: xr.Dataset, constants: Constants) -> dict:
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
        "terms": named(("term", "bin"), np.mean(terms, axis=0), "terms of H per site"),
        "term": named("term", list(TERMS), "term of the energy (8)"),
        "scaled_site": named("bin", 0.5 * (edges[1:] + edges[:-1]), "site over that of the front"),
        "spectrum": named("wave", np.mean(spectra, axis=0), "mean |A(k)|^2 behind the front"),
        "wave_number": named(
            "wave", 2.0 * np.pi * np.arange(LENGTH) / LENGTH, "wave number", "rad"
        ),
        "density": named("modulus", distribution(moduli, cells), "density of |A_n| and |B_n|"),
        "modulus": named("modulus", 0.5 * (cells[1:] + cells[:-1]), "modulus |A_n| or |B_n|"),
    }


def draw_terms(axes: Axes, data: xr.Dataset) -> None:
    """Draw the terms of the energy per site against the distance to the front."""
    for term, (colour, dashes, label) in TERM_LOOKS.items():
        values = data["terms"].values[list(data["term"].values).index(term)]
        if np.any(values):
            axes.plot(data["scaled_site"], values, color=colour, ls=dashes, lw=1.1, label=label)
    axes.plot(data["scaled_site"], data["terms"].sum("term"), color="black", lw=1.1, label="sum")
    axes.set_ylim(top=1.75 * float(data["terms"].max()))
    axes.set_xlabel("site over that of the front")
    axes.set_ylabel("energy per site")
    axes.legend(loc="upper right", ncols=2, columnspacing=1.0, handlelength=1.6)


def draw_spectrum(axes: Axes, data: xr.Dataset) -> None:
    """Draw the spectrum behind the front beside that of the thermal state."""
    for name, look in (("spectrum", SEA_LOOK), ("thermal_spectrum", THERMAL_LOOK)):
        values = data[name].values
        both = 0.5 * (values + np.roll(values[::-1], 1))  # k and -k alike
        half = slice(0, len(values) // 2 + 1)
        axes.plot(data["wave_number"][half] / np.pi, both[half], **look)
    axes.set_ylim(0, 1.45 * float(data["spectrum"].max()))
    axes.set_xlabel(r"wave number $k / \pi$")
    axes.set_ylabel(rf"mean $|A(k)|^2$, $\Omega = {data.attrs['omega']:g}$")
    axes.legend(loc="upper left")


def draw_moduli(axes: Axes, data: xr.Dataset) -> None:
    """Draw the distribution of the moduli beside that of the thermal state."""
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


def draw_powers(axes: Axes, data: xr.Dataset) -> None:
    """Draw the mean power of the sea over Omega beside that of the thermal state."""
    look = {"color": style.RED, "marker": "o", "ms": 3.5, "lw": 0, "elinewidth": 0.9}
    axes.plot(data["thermal_omega"], data["thermal_power"], **THERMAL_LOOK)
    axes.errorbar(data["omega"], data["power"], data["power_error"], label="sea", **look)
    axes.set_ylim(bottom=0)
    axes.set_xlabel(r"$\Omega$")
    axes.set_ylabel("mean power per site")
    axes.legend(loc="upper right")
