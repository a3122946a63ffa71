"""The dataset of periodic breathers: families, their stability, and where multipliers collide."""

from collections.abc import Mapping, Sequence

import numpy as np

from pendula.datasets.netcdf import Variable
from pendula.datasets.trajectories import COMPONENTS, Contents
from pendula.problem import Constants

from . import multipliers, periodic, perturbed, waves
from .contents import DIGITS, GROWTH_DIGITS, PARTS, energy_of, kept
from .steady import power

MODES = 3
"""Localised modes of one parity that are kept; no breather of the study has more."""
COLLISION_DIGITS, MEASURED_DIGITS = 6, 5

OVER = ("family", "omega", "frequency")
PARITY_OVER = ("parity", *OVER)
LEAST = ("instant", "family", "omega")
RATE, GROWING = "largest rate of growth", "number of multipliers that grow"
MET = "between this frequency and the next higher one multipliers collide: "
TABLE = {
    "amplitude": (("part", "component", *OVER), DIGITS,
                  "amplitude on a site, site 0, when both are real"),
    "power": (("component", *OVER), DIGITS, "power P of each component, the largest of a period"),
    "quarter_power": (("component", *OVER), DIGITS,
                      "power P of each component a quarter of a period later, when both are "
                      "imaginary: the least of a period"),
    "least_power": (LEAST, 7, "least P of a family, at and between its frequencies"),
    "least_power_frequency": (LEAST, 4, "frequency lambda of the breather with this P"),
    "energy": (OVER, DIGITS, "conserved energy H of equation (8)"),
    "growth": (OVER, GROWTH_DIGITS, f"{RATE} of a perturbation"),
    "growth_half": (OVER, GROWTH_DIGITS, f"{RATE} of a perturbation on half of the half-width"),
    "parity_growth": (PARITY_OVER, GROWTH_DIGITS, f"{RATE} by parity"),
    "measured_growth": (PARITY_OVER, MEASURED_DIGITS, f"{RATE} in the nonlinear flow by parity"),
    "growing": (OVER, None, GROWING),
    "growing_half": (OVER, None, f"{GROWING}, on half of the half-width"),
    "mode_trace": (("part", "mode", *PARITY_OVER), GROWTH_DIGITS,
                   "half the sum of a localised mode's multiplier over half a period and of its "
                   "inverse"),
    "mode_signature": (("mode", *PARITY_OVER), None,
                       "Krein signature of a localised mode, 0 where there is none or it grows"),
    "collision_frequency": (PARITY_OVER, COLLISION_DIGITS, f"{MET}frequency lambda"),
    "collision_power": (PARITY_OVER, MEASURED_DIGITS, f"{MET}P of the breather"),
    "collision_multiplier": (("part", *PARITY_OVER), COLLISION_DIGITS,
                             f"{MET}their value over half a period, with the change of sign there"),
    "collision_signature": (("colliding", *PARITY_OVER), None,
                            f"{MET}their Krein signatures, 0 where none do"),
}  # fmt: skip
"""Dimensions, significant digits (None of integers) and long name of each stored variable."""

Spectra = dict[str, tuple[np.ndarray, np.ndarray]]
"""Traces and signatures of the perturbations of a breather, by their parity."""


def periodic_contents(
    epsilon: float, gamma: float, omegas: Sequence[float], frequencies: Sequence[float],
    half_widths: Mapping[str, int],
) -> Contents:  # fmt: skip
    """Return the three families at each Omega and frequency; NaN where a family does not exist.

    `half_widths` has the least and the most that a chain may have.
    """
    frequencies = sorted(frequencies)
    given = [Constants(epsilon=epsilon, gamma=gamma, omega=omega) for omega in omegas]
    table = _blank_table(len(omegas), len(frequencies))
    for j, constants in enumerate(given):
        for i, family in enumerate(periodic.FAMILIES):
            found = [*periodic.family_of(constants, family, frequencies, half_widths)]
            _add_family(table, (i, j), found, frequencies)
    table["growth"] = table["parity_growth"].max(axis=0)
    variables = {
        "part": PARTS,
        "component": COMPONENTS,
        "parity": Variable(
            ("parity",), list(multipliers.PARITIES), "parity of the tangent vector in n"
        ),
        "family": Variable(("family",), list(periodic.FAMILIES), "family of periodic breathers"),
        "omega": Variable(("omega",), np.array(omegas, dtype=float)),
        "frequency": Variable(
            ("frequency",), np.array(frequencies, dtype=float), "frequency lambda of the breather"
        ),
        **_waves(given, frequencies),
        "instant": Variable(
            ("instant",), list(periodic.INSTANTS), "instant of the period, seen from A and B"
        ),
        **{
            name: kept(dimensions, table[name], words, digits)
            for name, (dimensions, digits, words) in TABLE.items()
        },
    }
    about = {"epsilon": epsilon, "gamma": gamma, "residual": periodic.TOLERANCE}
    return variables, {"title": "Periodic breathers localised at one pair", **about}


def _blank_table(omegas: int, frequencies: int) -> dict[str, np.ndarray]:
    """Return an array for each variable: NaN, or 0 for signatures."""
    sizes = {"mode": MODES, "family": len(periodic.FAMILIES)}
    sizes |= {"omega": omegas, "frequency": frequencies}
    table = {}
    for name, (dimensions, _, _) in TABLE.items():
        shape = [sizes.get(dimension, 2) for dimension in dimensions]
        is_sign = name.endswith("signature")
        table[name] = np.zeros(shape, np.int8) if is_sign else np.full(shape, np.nan)
    return table


def _add_family(table: dict, at: tuple, found: list[periodic.Breather], frequencies) -> None:
    """Write the breathers of a family at one Omega, found from the highest frequency down."""
    above = None
    for breather in found:
        here = (..., *at, frequencies.index(breather.frequency))
        spectra = spectra_of(breather)
        _add_breather(table, here, breather, spectra)
        # within the waves, those of a finite chain collide
        if breather.frequency > waves.highest(breather.constants):
            _add_instability(table, here, (breather, spectra), above)
        above = breather, spectra
    if found:
        least = [periodic.least_power(found, instant) for instant in periodic.INSTANTS]
        table["least_power_frequency"][:, *at], table["least_power"][:, *at] = np.transpose(least)


def spectra_of(breather: periodic.Breather) -> Spectra:
    """Return the spectra of even and of odd perturbations of a breather."""
    return {
        parity: multipliers.spectrum(multipliers.half_map(breather, parity), parity)
        for parity in multipliers.PARITIES
    }


def growth_of(breather: periodic.Breather, spectra: Spectra) -> tuple[list[float], int]:
    """Return the largest rate of growth by parity, and how many pairs of multipliers grow."""
    traces = [found for found, _ in spectra.values()]
    growing = sum(multipliers.unstable_count(breather.frequency, one) for one in traces)
    return [multipliers.growth(breather.frequency, one) for one in traces], growing


def _add_breather(table: dict, at: tuple, breather: periodic.Breather, spectra: Spectra) -> None:
    """Write a breather, its stability on its own and on half of the half-width, and its modes."""
    constants, frequency, data = breather
    table["amplitude"][at] = data[:, 0], (0.0, 0.0)
    for name, instant in zip(("power", "quarter_power"), periodic.INSTANTS, strict=True):
        table[name][at] = periodic.power_at(breather, instant)
    table["energy"][at] = energy_of(constants, data.astype(complex))
    half = periodic.shoot(constants, frequency, periodic.widened(data, data.shape[1] // 2 + 1))
    rates, table["growing_half"][at] = growth_of(half, spectra_of(half))
    table["growth_half"][at] = max(rates)
    table["parity_growth"][at], table["growing"][at] = growth_of(breather, spectra)
    for p, parity in enumerate(multipliers.PARITIES):
        modes = multipliers.localised_modes(breather, *spectra[parity])
        for m, mode in enumerate(modes[:MODES]):
            table["mode_trace"][:, m, p][at] = mode.trace.real, mode.trace.imag
            table["mode_signature"][m, p][at] = mode.signature


def _add_instability(table: dict, at: tuple, one: tuple, above: tuple | None) -> None:
    """Write how fast the fastest perturbations grow in the flow, and what collides below `above`.

    Both are a breather and its spectra; `above` is the one at the next higher frequency.
    """
    for p, parity in enumerate(multipliers.PARITIES):
        breather, (traces, _) = one[0], one[1][parity]
        rates = multipliers.growths(breather.frequency, traces)
        if rates.max() > 0.0:
            fastest = complex(traces[rates.argmax()])
            found = perturbed.measured_growth(breather, fastest, parity)
            table["measured_growth"][p][at] = found
        if above is None:
            continue
        ends = [(member, *spectra[parity]) for member, spectra in (one, above)]
        met = multipliers.collision(*ends, parity)
        if met is not None:
            table["collision_frequency"][p][at] = met.breather.frequency
            table["collision_power"][p][at] = power(met.breather.data).sum()
            sine = np.sqrt(max(0.0, 1.0 - met.trace * met.trace))
            table["collision_multiplier"][:, p][at] = met.trace, sine
            table["collision_signature"][:, p][at] = met.signatures


def _waves(given: list[Constants], frequencies) -> dict[str, Variable]:
    """Return where the bands of (15) lie, and which frequencies none of whose multiples meets."""
    away = [[waves.distance_from_bands(one, lam) for lam in frequencies] for one in given]
    free = [waves.free_intervals(one) for one in given]
    ends = np.full((2, len(free), max(map(len, free))), np.nan)
    for j, intervals in enumerate(free):
        ends[:, j, : len(intervals)] = np.transpose(intervals)
    says = "frequency at the {} end of an interval of lambda whose odd multiples meet no band"
    over = ("omega", "free_interval")
    return {
        "band_distance": Variable(
            ("omega", "frequency"), away, "distance of the odd multiples of lambda from the bands"
        ),
        "highest_wave": Variable(
            ("omega",), [waves.highest(one) for one in given], "highest frequency of linear waves"
        ),
        "free_low": Variable(over, ends[0], says.format("lower")),
        "free_high": Variable(over, ends[1], says.format("upper")),
    }
