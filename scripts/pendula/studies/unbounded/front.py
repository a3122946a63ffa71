"""The front of the chain without ends: the speed of linear spreading, and measured ones.

The dispersion relation (15) at complex wave numbers gives the speed at which small data spread.
D = A - B moves as exp(s t + i k n) with s^2 = 4 gamma^2 - kappa(k)^2 and
kappa = 2 epsilon (1 - cos k) - Omega. The solution is an integral over k of entire functions, so
its path may be moved to Im k = decay: |D_n| <= C exp(t max Re s - decay n). The least of
max Re s / decay is the speed of linear spreading; there k is a saddle point, s'(k) = -i v, where
Re s = v decay (van Saarloos, Physics Reports 386 (2003) 29). Where the chain at rest is stable, no
front is pulled, and the fastest group velocity takes its place.
"""

from dataclasses import asdict, replace
from typing import NamedTuple

import numpy as np
import xarray as xr

from pendula.problem import Constants

from .bulk import (
    LENGTH,
    TERMS,
    bulk_of,
    complex_pair,
    distribution,
    energy_terms,
    mean_powers,
    profile,
    spectrum,
    with_ghosts,
)


class LinearFront(NamedTuple):
    """Speed v in sites per unit of tau, and the wave exp(-decay n + i q n) at the leading edge."""

    speed: float
    decay: float  # zero where the chain at rest is stable
    wave_number: float

    @property
    def delay(self) -> float:
        """Sites lost per unit of log tau on the way to v: the speed is v - 3 / (2 decay tau)."""
        return 1.5 / self.decay if self.decay else 0.0


def is_unstable(constants: Constants) -> bool:
    """Return whether the infinite chain at rest is unstable (Lemma 1, gamma > 0)."""
    gamma = constants.gamma
    return -2.0 * gamma < constants.omega < 2.0 * gamma + 4.0 * constants.epsilon


def linear_front(constants: Constants) -> LinearFront:
    """Return the front of data of finite extent in the linearised infinite chain."""
    waves, decays = np.linspace(0.0, np.pi, 801), np.geomspace(1e-3, 6.0, 400)
    if not is_unstable(constants):
        speeds = group_velocity(waves[1:-1], constants)
        best = int(np.argmax(speeds))
        return LinearFront(float(speeds[best]), 0.0, float(waves[1 + best]))
    speed, wave, decay = _least(waves, decays, constants)
    q_span, d_span = waves[1], 0.03 * decay
    for _ in range(10):  # the neighbourhood of the saddle, ever smaller
        box = np.linspace(-1.0, 1.0, 21)
        speed, wave, decay = _least(wave + q_span * box, decay + d_span * box, constants)
        q_span, d_span = 0.3 * q_span, 0.3 * d_span
    return LinearFront(speed, decay, wave)


def growth_rate(k, constants: Constants):
    """Return Re s of the growing branch at complex wave numbers k."""
    kappa = 2.0 * constants.epsilon * (1.0 - np.cos(k)) - constants.omega
    return np.abs(np.sqrt(4.0 * constants.gamma**2 - kappa**2 + 0j).real)


def group_velocity(k, constants: Constants):
    """Return |d omega_2 / dk| of real wave numbers where omega_2 is real and not zero."""
    epsilon, gamma = constants.epsilon, constants.gamma
    kappa = 2.0 * epsilon * (1.0 - np.cos(k)) - constants.omega
    return np.abs(2.0 * epsilon * np.sin(k) * kappa) / np.sqrt(kappa**2 - 4.0 * gamma**2)


def _least(
    waves: np.ndarray, decays: np.ndarray, constants: Constants
) -> tuple[float, float, float]:
    """Return (speed, wave number, decay) of the least over decays of the largest over waves."""
    speeds = growth_rate(waves[:, None] + 1j * decays, constants) / decays
    j = int(np.argmin(speeds.max(axis=0)))
    i = int(np.argmax(speeds[:, j]))
    return float(speeds[i, j]), float(waves[i]), float(decays[j])


# --- Measured -------------------------------------------------------------------------------------

FRONT, BULK = 1e-2, 4.0
"""Powers at which a front is found: of a pulled one, and of a bulk amid waves that it radiates."""

SETTLED = 1 / 3
"""The part of a run that is left out: at first the speed is below the one it tends to."""

SPANS = 36
"""Spans of log tau in which the front's way is averaged."""

BINS, HIGHEST, MODULI = 24, 1.2, 40
"""Cells of a profile, how far it reaches beyond the front, and cells of a distribution."""


def speed_of(tau: np.ndarray, front: np.ndarray) -> float:
    """Return the slope of the front's site over time, of the late part of a run."""
    late = tau >= SETTLED * tau[-1]
    return float(np.polyfit(tau[late], front[late], 1)[0])


def speeds(run, level: float = FRONT, corrected: bool = False) -> tuple[np.ndarray, np.ndarray]:
    """Return the speeds of each variant of a dataset of runs, mean over members, and their errors.

    `corrected` adds back what a pulled front loses on its way, `predicted_delay` log tau. The
    error is one site over the time of the fit at least: a front stands on sites.
    """
    tau = run["piece_tau"].values
    way = run["front"].sel(level=level).transpose("variant", "member", "piece_tau").values
    if corrected:
        way = way + run["predicted_delay"].values[:, None, None] * np.log(tau)
    found = np.array([[speed_of(tau, series) for series in members] for members in way])
    least = 1.0 / ((1.0 - SETTLED) * tau[-1])
    if found.shape[1] == 1:
        return found[:, 0], np.full(len(found), least)
    error = found.std(axis=1, ddof=1) / np.sqrt(found.shape[1])
    return found.mean(axis=1), np.maximum(error, least)


def measure_front(
    omegas: xr.Dataset, bulk: xr.Dataset, large: xr.Dataset, thermal: xr.Dataset
) -> xr.Dataset:
    """Return fronts over Omega, the way of one of them, and the state behind it.

    `omegas` are runs over Omega, `bulk` the run whose bulk is looked at, `large` one whose bulk
    spreads where the chain at rest is stable. `thermal` are the states without energy that the
    bulk is compared with. Speeds are in sites per unit of tau, everything else is dimensionless.
    """
    constants = Constants.of(bulk.attrs)
    data = xr.Dataset(
        {
            **_speeds(omegas, thermal),
            **_line(constants),
            **_positions(omegas, large),
            **_way(bulk),
            **_behind(bulk, constants),
            **_powers(omegas),
            **_thermal(thermal, constants.omega),
        },
        {"omega": _named("omega", omegas["omega"].values, "detuning Omega")},
    )
    title = "The front on chains without ends, and the bulk behind it"
    data.attrs = {"title": title}
    return data.assign_attrs(**asdict(constants), large_omega=large.attrs["omega"])


def _named(dims, values, title: str, units: str = "1"):
    return dims, np.asarray(values), {"long_name": title, "units": units}


def _speeds(omegas: xr.Dataset, thermal: xr.Dataset) -> dict:
    """Return measured and predicted speeds, and the thermal power at the same Omega."""
    title = "front speed (sites per unit of tau)"
    plain, plain_error = speeds(omegas)
    corrected, corrected_error = speeds(omegas, corrected=True)
    known = thermal["power"].reindex(omega=omegas["omega"].values, method="nearest", tolerance=1e-9)
    return {
        "speed": _named("omega", plain, f"measured {title}"),
        "speed_error": _named("omega", plain_error, f"standard error of the {title}"),
        "corrected_speed": _named("omega", corrected, f"{title}, its delay added back"),
        "corrected_speed_error": _named("omega", corrected_error, "standard error of that speed"),
        "predicted_speed": _named(
            "omega", omegas["predicted_speed"].values, f"linear spreading, {title}"
        ),
        "expected_power": _named("omega", known.values, "mean power of the thermal state, P"),
    }


def _line(constants: Constants) -> dict:
    """Return the speed of linear spreading over Omega, on a fine grid."""
    grid = np.linspace(-4.0, 8.0, 97)
    lines = [linear_front(replace(constants, omega=omega)).speed for omega in grid]
    title = "linear spreading, front speed (sites per unit of tau)"
    return {
        "line_omega": _named("line_omega", grid, "detuning Omega"),
        "predicted": _named("line_omega", lines, title),
    }


def _positions(omegas: xr.Dataset, large: xr.Dataset) -> dict:
    """Return the fronts of the ensembles' first members against time."""
    first = omegas["front"].sel(level=FRONT).isel(member=0)
    of_bulk = large["front"].sel(level=BULK).isel(variant=0, member=0)
    return {
        "tau": _named("piece", omegas["piece_tau"].values, "slow time"),
        "front": _named(("omega", "piece"), first.values, "site of the front"),
        "large_tau": _named("large_piece", large["piece_tau"].values, "slow time, stable chain"),
        "large_front": _named(
            "large_piece", of_bulk.values, "site where the bulk ends, stable chain, large data"
        ),
    }


def _way(bulk: xr.Dataset) -> dict:
    front = bulk["front"].isel(variant=0).sel(level=FRONT)
    tau = bulk["piece_tau"].values
    v, delay = (
        float(bulk[name].isel(variant=0)) for name in ("predicted_speed", "predicted_delay")
    )
    behind = (front.transpose("member", "piece_tau").values - v * tau).mean(axis=0)
    # a front stands on whole sites: means over short spans of log time show where it is
    spans = np.digitize(np.log(tau), np.linspace(np.log(tau[0]), np.log(tau[-1]), SPANS))
    found = [spans == span for span in np.unique(spans)]
    return {
        "way_tau": _named("time", [tau[span].mean() for span in found], "slow time"),
        "behind": _named("time", [behind[span].mean() for span in found], "front minus v tau"),
        "delay": _named((), delay, "sites lost per unit of log tau, predicted"),
    }


def _behind(bulk: xr.Dataset, constants: Constants) -> dict:
    """Return profiles, spectrum and distribution of the final states of all members."""
    states = [with_ghosts(state) for state in bulk["state"].isel(variant=0).values]
    fronts = bulk["front"].isel(variant=0, piece_tau=-1).sel(level=FRONT).values.astype(int)
    edges = np.linspace(0.0, HIGHEST, BINS + 1)
    terms, spectra, moduli = [], [], []
    for state, front in zip(states, fronts, strict=True):
        sites = (edges * front).astype(int)
        terms.append(profile(energy_terms(state, constants), sites))
        inside = bulk_of(state, front)
        for amplitude in complex_pair(state):
            spectra.append(spectrum(amplitude[inside], LENGTH))
            moduli.append(np.abs(amplitude[inside]))
    moduli = np.concatenate(moduli)
    cells = np.linspace(0.0, 1.05 * moduli.max(), MODULI + 1)
    waves = 2.0 * np.pi * np.arange(LENGTH) / LENGTH
    return {
        "terms": _named(("term", "bin"), np.mean(terms, axis=0), "terms of H per site"),
        "term": _named("term", list(TERMS), "term of the energy (8)"),
        "scaled_site": _named("bin", 0.5 * (edges[1:] + edges[:-1]), "site over that of the front"),
        "spectrum": _named("wave", np.mean(spectra, axis=0), "mean |A(k)|^2 behind the front"),
        "wave_number": _named("wave", waves, "wave number", "rad"),
        "density": _named(
            "modulus", distribution(moduli, cells), "probability density of |A_n| and |B_n|"
        ),
        "modulus": _named("modulus", 0.5 * (cells[1:] + cells[:-1]), "modulus |A_n| or |B_n|"),
    }


def _powers(omegas: xr.Dataset) -> dict:
    found = mean_powers(omegas)
    error = found.std(axis=1) / np.sqrt(max(1, found.shape[1] - 1))
    return {
        "power": _named("omega", found.mean(axis=1), "mean power |A_n|^2 + |B_n|^2 of the bulk"),
        "power_error": _named("omega", error, "its standard error over the ensemble"),
    }


def _thermal(thermal: xr.Dataset, omega: float) -> dict:
    one = thermal.sel(omega=omega, method="nearest")
    density = "probability density of the modulus, thermal state"
    return {
        "thermal_omega": _named("state", thermal["omega"].values, "detuning of the thermal states"),
        "thermal_power": _named("state", thermal["power"].values, "mean power, thermal state"),
        "thermal_modulus": _named("cell", one["modulus"].values, "modulus |A_n| or |B_n|"),
        "thermal_density": _named("cell", one["density"].values, density),
        "thermal_spectrum": _named("wave", one["spectrum"].values, "|A(k)|^2, thermal state"),
    }
