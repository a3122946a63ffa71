"""The front of the chain without ends: the speed of linear spreading, and measured ones.

The dispersion relation (15) at complex wave numbers gives the speed at which small data spread.
D = A - B moves as exp(s t + i k n) with s^2 = 4 gamma^2 - kappa(k)^2 and
kappa = 2 epsilon (1 - cos k) - Omega. The solution is an integral over k of entire functions, so
its path may be moved to Im k = decay: |D_n| <= C exp(t max Re s - decay n). The least of
max Re s / decay is the speed of linear spreading; there k is a saddle point, s'(k) = -i v, where
Re s = v decay (van Saarloos, Physics Reports 386 (2003) 29). Where the chain at rest is stable, no
front is pulled, and the fastest group velocity takes its place.

A pulled front comes to v from below, in a way that the saddle point tells as well (Ebert and van
Saarloos, Physica D 146 (2000) 1): its place is v tau - delay log tau - rest tau^(-1/2) and an
offset, with delay = 3 / (2 decay), rest = 3 pi^(1/2) Re(D^(-1/2)) / decay^2 and D = -s''(k) / 2.
"""

from dataclasses import asdict, replace
from typing import NamedTuple

import numpy as np
import xarray as xr

from pendula.datasets.netcdf import Variable, as_xarray
from pendula.datasets.trajectories import shared_by
from pendula.measures.confidence import mean_limits
from pendula.measures.spreading import lay_line
from pendula.numerics.elementary import (
    complex_of,
    cos,
    cosh,
    exp,
    log,
    modulus,
    product,
    quotient,
    sin,
    sine_and_cosine,
    sinh,
    square_root,
)
from pendula.problem import Constants

from .bulk import (
    LENGTH,
    POWER,
    TERMS,
    bulk_of,
    complex_pair,
    distribution,
    energy_terms,
    mean_powers,
    profile,
    slope_powers,
    spectrum,
    statistics_of,
    thermal_powers,
    with_ghosts,
)

PREDICTED_SPEED = "speed of linear spreading, in sites per unit of tau"
DELAY = "sites lost per unit of log tau on the way to that speed"
REST = "sites yet to be lost on that way, times tau^(1/2)"
PULLED = "one: a front is pulled at that speed; zero: no wave packet is faster"
PIECE_TAU, SITE_OF_FRONT = "slow time at the end of a piece of the run", "site of the front"
WAVES, DECAYS = np.linspace(0.0, np.pi, 801), exp(np.linspace(log(1e-3), log(6.0), 60))
"""The grid on which the speed of linear spreading is looked for."""

NEWTON = 12
"""Steps of Newton's method to the saddle point."""
RESOLVES = "limits, to each side: what the places of a front between two sites resolve"
"""What these quantities are called in every dataset of this study."""


class LinearFront(NamedTuple):
    """Speed v in sites per unit of tau, and the wave exp(-decay n + i q n) at the leading edge."""

    speed: float
    decay: float  # zero where the chain at rest is stable
    wave_number: float
    diffusion: complex = 0.0
    """-s''(k) / 2 at the saddle point, in sites^2 per unit of tau."""

    @property
    def delay(self) -> float:
        """Sites lost per unit of log tau on the way to v: the speed is v - 3 / (2 decay tau)."""
        return 1.5 / self.decay if self.decay else 0.0

    @property
    def rest(self) -> float:
        """Sites times tau^(1/2): at tau the front has yet to lose `rest` tau^(-1/2) sites."""
        if not self.decay:
            return 0.0
        across = quotient(1.0, square_root(self.diffusion)).real
        return float(3.0 * np.sqrt(np.pi) * across / (self.decay * self.decay))


def is_unstable(constants: Constants) -> bool:
    """Return whether the infinite chain at rest is unstable (Lemma 1, gamma > 0)."""
    gamma = constants.gamma
    return -2.0 * gamma < constants.omega < 2.0 * gamma + 4.0 * constants.epsilon


def linear_front(constants: Constants) -> LinearFront:
    """Return the front of data of finite extent in the linearised infinite chain."""
    if not is_unstable(constants):
        speeds = group_velocity(WAVES[1:-1], constants)
        best = int(np.argmax(speeds))
        return LinearFront(float(speeds[best]), 0.0, float(WAVES[1 + best]))
    wave, decay = _least(WAVES[::8], DECAYS, constants)
    wave, decay = _saddle(wave, decay, constants) or _corner(decay, constants)
    s, _, curvature = _growing_branch(wave, decay, constants)
    return LinearFront(float(s.real / decay), decay, wave, complex(-0.5 * curvature))


def _saddle(wave: float, decay: float, constants: Constants) -> tuple[float, float] | None:
    """Return the saddle point near a point of the grid, by Newton's method; None if none is near.

    The speed Re s / decay does not change to first order there, so that s'' is all of the Jacobian.
    """
    nearest = decay
    for _ in range(NEWTON):
        s, slope, curvature = _growing_branch(wave, decay, constants)
        step = quotient(slope + 1j * (s.real / decay), curvature)
        wave, decay = wave - float(step.real), decay - float(step.imag)
        if not 0.7 * nearest < decay < 1.4 * nearest:
            return None
    s = _growing_branch(wave, decay, constants)[0]
    fastest = growth_rate(WAVES, decay, constants).max()
    return (wave, decay) if modulus(step) < 1e-8 and fastest <= s.real * (1.0 + 1e-9) else None


def _corner(decay: float, constants: Constants) -> tuple[float, float]:
    """Return where the least speed near `decay` is that of two waves at once, which is no saddle.

    Weakly unstable chains are so. Ever finer grids in the decay come close to the corner.
    """
    waves, span = np.linspace(0.0, np.pi, 6401), 0.2 * decay
    for _ in range(6):
        wave, decay = _least(waves, decay + span * np.linspace(-1.0, 1.0, 9), constants)
        span *= 0.3
    return wave, decay


def _growing_branch(wave: float, decay: float, constants: Constants) -> tuple[complex, ...]:
    """Return s, s'(k) and s''(k) of the growing branch, from s^2 = 4 gamma^2 - kappa^2."""
    epsilon, gamma, omega = constants
    (s, c), (along, across) = sine_and_cosine(wave), (cosh(decay), sinh(decay))
    cosine, sine = complex_of(c * along, -s * across), complex_of(s * along, c * across)
    kappa = 2.0 * epsilon * (1.0 - cosine) - omega
    of_kappa, curvature = 2.0 * epsilon * sine, 2.0 * epsilon * cosine
    s = square_root(4.0 * gamma * gamma - product(kappa, kappa))
    slope = -quotient(product(kappa, of_kappa), s)
    twice = product(of_kappa, of_kappa) + product(kappa, curvature) + product(slope, slope)
    return s, slope, -quotient(twice, s)


def growth_rate(wave, decay, constants: Constants):
    """Return Re s of the growing branch at the complex wave numbers wave + i decay."""
    epsilon, gamma, omega = constants
    s, c = sine_and_cosine(wave)
    kappa = 2.0 * epsilon * (1.0 - c * cosh(decay)) - omega
    across = 2.0 * epsilon * s * sinh(decay)  # Im kappa
    along = 4.0 * gamma * gamma - kappa * kappa + across * across
    return square_root(complex_of(along, -2.0 * kappa * across)).real


def group_velocity(k, constants: Constants):
    """Return |d omega_2 / dk| of real wave numbers where omega_2 is real and not zero."""
    epsilon, gamma = constants.epsilon, constants.gamma
    kappa = 2.0 * epsilon * (1.0 - cos(k)) - constants.omega
    square = (kappa - 2.0 * gamma) * (kappa + 2.0 * gamma)
    return np.abs(2.0 * epsilon * sin(k) * kappa) / np.sqrt(square)


def _least(waves: np.ndarray, decays: np.ndarray, constants: Constants) -> tuple[float, float]:
    """Return (wave number, decay) of the least over decays of the largest speed over waves."""
    speeds = growth_rate(waves[:, None], decays, constants) / decays
    j = int(np.argmin(speeds.max(axis=0)))
    return float(waves[np.argmax(speeds[:, j])]), float(decays[j])


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
    return lay_line(tau[late], front[late]).slope


def resolution(tau: np.ndarray) -> float:
    """Return how well the speed of a front can be known from its places at `tau`.

    A front lies between two sites, and waves at its edge move it to and fro between them. Places
    that are off by half a site either way change the slope of least squares by at most 3/2 sites
    over the time of the fit. All members of an ensemble have one front, so they make it no better.
    """
    return 1.5 / ((1.0 - SETTLED) * float(tau[-1]))


def speeds(run, level: float = FRONT, corrected: bool = False) -> tuple[np.ndarray, np.ndarray]:
    """Return the speeds of each variant of a dataset of runs, mean over members, and their limits.

    `corrected` adds back what a pulled front loses on its way. The limits are those of the mean by
    Student's t, and no less than the `resolution`.
    """
    tau = run["piece_tau"].values
    way = run["front"].sel(front_power=level).transpose("variant", "member", "piece_tau").values
    if corrected:
        delay, rest = (run[f"predicted_{name}"].values[:, None, None] for name in ("delay", "rest"))
        way = way + delay * log(tau) + rest / np.sqrt(tau)
    found = np.array([[speed_of(tau, series) for series in members] for members in way])
    limits = mean_limits(found.T)
    half = np.where(np.isfinite(limits.half), limits.half, 0.0)
    return limits.value, np.maximum(half, resolution(tau))


def measure_front(
    omegas: xr.Dataset, bulk: xr.Dataset, large: xr.Dataset, thermal: xr.Dataset
) -> xr.Dataset:
    """Return fronts over Omega, the way of one of them, and the state behind it.

    `omegas` are runs over Omega, `bulk` the run whose bulk is looked at, `large` one whose bulk
    spreads where the chain at rest is stable. `thermal` are the states without energy that the
    bulk is compared with.
    """
    constants = Constants.of(bulk.attrs)
    omega, line = omegas["omega"].values, np.linspace(-4.0, 8.0, 97)
    plain, plain_error = speeds(omegas)
    corrected, corrected_error = speeds(omegas, corrected=True)
    line_speeds = [linear_front(replace(constants, omega=value)).speed for value in line]
    power, power_error = _powers(omegas)
    known = thermal_powers(thermal, omega)
    slopes = slope_powers(omegas)

    def over_omega(values, long_name: str = "") -> Variable:
        return Variable(("omega",), values, long_name)

    variables = {
        "omega": over_omega(omega),
        "speed": over_omega(plain, "measured speed of the front, in sites per unit of tau"),
        "speed_error": over_omega(plain_error, f"{RESOLVES} of that speed"),
        "corrected_speed": over_omega(corrected, "speed of the front, its delay added back"),
        "corrected_speed_error": over_omega(corrected_error, f"{RESOLVES} of that speed"),
        "predicted_speed": over_omega(omegas["predicted_speed"].values, PREDICTED_SPEED),
        "mean_power": over_omega(power, POWER),
        "mean_power_error": over_omega(power_error, f"half of the 95 % limits of the {POWER}"),
        "expected_power": over_omega(known, f"{POWER} in the thermal state at the same Omega"),
        "slope_power": over_omega(
            [slope.value for slope in slopes], f"{POWER}, from the slope of l2^2"
        ),
        "slope_power_error": over_omega(
            [slope.half for slope in slopes], "half of the 95 % limits of that from the slope"
        ),
        "line_omega": Variable(("line_omega",), line, "detuning Omega, on a finer grid"),
        "line_speed": Variable(("line_omega",), line_speeds, PREDICTED_SPEED),
        **_ways(omegas, large),
        **_delay(bulk),
        **_behind(bulk, constants),
        **_thermal(thermal, constants.omega),
    }
    title = "The front on chains without ends, and the bulk behind it"
    about = {**shared_by([omegas.attrs, bulk.attrs]), **asdict(constants)}
    return as_xarray(variables, {**about, "title": title, "large_omega": large.attrs["omega"]})


def _powers(omegas: xr.Dataset) -> tuple[np.ndarray, np.ndarray]:
    """Return the mean powers over the members, and their limits; NaN for one member."""
    limits = mean_limits(mean_powers(omegas).T)
    return limits.value, np.where(np.isfinite(limits.half), limits.half, np.nan)


def _ways(omegas: xr.Dataset, large: xr.Dataset) -> dict[str, Variable]:
    """Return the fronts of the ensembles' first members against time."""
    first = omegas["front"].sel(front_power=FRONT).isel(member=0).values
    of_bulk = large["front"].sel(front_power=BULK).squeeze("variant").isel(member=0).values
    stable = ("large_piece",)
    return {
        "piece_tau": Variable(("piece_tau",), omegas["piece_tau"].values, PIECE_TAU),
        "front": Variable(("omega", "piece_tau"), first, SITE_OF_FRONT),
        "large_tau": Variable(stable, large["piece_tau"].values, "slow time, stable chain"),
        "large_front": Variable(stable, of_bulk, "site where the bulk ends, stable chain"),
    }


def _delay(bulk: xr.Dataset) -> dict[str, Variable]:
    """Return how far the front falls behind the speed of linear spreading, mean over members."""
    tau = bulk["piece_tau"].values
    one = bulk.squeeze("variant")
    v, delay = float(one["predicted_speed"]), float(one["predicted_delay"])
    way = one["front"].sel(front_power=FRONT).transpose("member", "piece_tau").values
    behind = (way - v * tau).mean(axis=0)
    # waves at its edge move a front to and fro: means over short spans of log time show its way
    spans = np.digitize(log(tau), np.linspace(log(tau[0]), log(tau[-1]), SPANS))
    found = [spans == span for span in np.unique(spans)]
    return {
        "way_tau": Variable(("span",), [tau[s].mean() for s in found], "slow time, mean of a span"),
        "behind": Variable(("span",), [behind[s].mean() for s in found], "site of front - v tau"),
        "delay": Variable((), delay, DELAY),
        "front_rest": Variable((), float(one["predicted_rest"]), REST),
    }


def _behind(bulk: xr.Dataset, constants: Constants) -> dict[str, Variable]:
    """Return profiles, spectrum and distribution of the final states of all members."""
    bulk = bulk.squeeze("variant")
    states = [with_ghosts(state) for state in bulk["state"].values]
    fronts = bulk["front"].isel(piece_tau=-1).sel(front_power=FRONT).values.astype(int)
    edges = np.linspace(0.0, HIGHEST, BINS + 1)
    terms, spectra, moduli = [], [], []
    for state, front in zip(states, fronts, strict=True):
        sites = (edges * front).astype(int)
        terms.append(profile(energy_terms(state, constants), sites))
        inside = bulk_of(state, front)
        for amplitude in complex_pair(state):
            spectra.append(spectrum(amplitude[inside], LENGTH))
            moduli.append(modulus(amplitude[inside]))
    moduli = np.concatenate(moduli)
    cells = np.linspace(0.0, 1.05 * moduli.max(), MODULI + 1)
    return {
        "term": Variable(("term",), list(TERMS), "term of the energy (8)"),
        "mean_terms": Variable(("term", "bin"), np.mean(terms, axis=0), "terms of H per site"),
        "scaled_site": Variable(
            ("bin",), 0.5 * (edges[1:] + edges[:-1]), "site over that of the front"
        ),
        **statistics_of(np.mean(spectra, axis=0), distribution(moduli, cells), cells),
    }


def _thermal(thermal: xr.Dataset, omega: float) -> dict[str, Variable]:
    """Return of the thermal states what the bulk is compared with, for some of it at one Omega."""
    one = thermal.reindex(omega=[omega], method="nearest", tolerance=1e-9).isel(omega=0)
    taken = {"omega": thermal["omega"], "power": thermal["power"], "modulus": one["modulus"],
             "density": one["density"], "spectrum": one["spectrum"]}  # fmt: skip
    dims = {"omega": "state", "modulus": "cell", "wave": "wave"}
    return {
        f"thermal_{name}": Variable(
            tuple(dims[dim] for dim in values.dims),
            values.values,
            f"{values.attrs['long_name']}, thermal state",
        )
        for name, values in taken.items()
    }
