"""The dataset of periodic breathers: families, their stability, and where multipliers collide."""

from collections.abc import Mapping, Sequence
from typing import NamedTuple

import numpy as np

from pendula.datasets.netcdf import Variable
from pendula.datasets.trajectories import COMPONENTS, Contents
from pendula.problem import Constants

from . import multipliers, periodic, perturbed, steady, waves
from .contents import GROWTH_DIGITS, PARTS, energy_of, kept

MODES = 3
"""Localised modes of one parity that are kept; no breather of the study has more."""
COLLISION_DIGITS, MEASURED_DIGITS = 6, 5


class Member(NamedTuple):
    """A breather and (traces, signs) by parity."""

    breather: periodic.Breather
    spectra: dict[str, tuple[np.ndarray, np.ndarray]]

    def growth(self, parity: str) -> float:
        """Return the largest rate of growth of a perturbation of one parity."""
        return multipliers.growth(self.breather.frequency, self.spectra[parity][0])

    @property
    def growing(self) -> int:
        """How many pairs of multipliers grow, of both parities."""
        spectra = self.spectra.values()
        return sum(
            multipliers.unstable_count(self.breather.frequency, traces) for traces, _ in spectra
        )


def member_of(breather: periodic.Breather) -> Member:
    """Return a breather with its spectra."""
    return Member(breather, {
        parity: multipliers.spectrum(multipliers.half_map(breather, parity), parity)
        for parity in multipliers.PARITIES
    })  # fmt: skip


def on_half(breather: periodic.Breather) -> Member:
    """Return the breather on a chain of half the half-width."""
    constants, frequency, data = breather
    sites = data.shape[1] // 2 + 1
    return member_of(periodic.shoot(constants, frequency, periodic.widened(data, sites)))


class _Table:
    """The numbers of all members, NaN (0 for signatures) where there is none."""

    def __init__(self, *over: int):
        parities, parts = len(multipliers.PARITIES), 2
        self.amplitude = np.full((parts, 2, *over), np.nan)
        self.power = np.full((len(periodic.INSTANTS), 2, *over), np.nan)
        self.least = np.full((2, len(periodic.INSTANTS), *over[:-1]), np.nan)
        self.energy = np.full(over, np.nan)
        self.growth_half, self.growing = np.full(over, np.nan), np.full((2, *over), np.nan)
        self.growth, self.measured_growth = np.full((2, parities, *over), np.nan)
        self.trace = np.full((parts, MODES, parities, *over), np.nan)
        self.signature = np.zeros((MODES, parities, *over), np.int8)
        self.collision = np.full((parities, *over), np.nan)
        self.collision_power = np.full((parities, *over), np.nan)
        self.collision_multiplier = np.full((parts, parities, *over), np.nan)
        self.collision_signature = np.zeros((2, parities, *over), np.int8)

    def add(self, at: tuple[int, ...], one: Member) -> None:
        """Write a member at its family, Omega and frequency."""
        breather = one.breather
        self.amplitude[(slice(None), slice(None), *at)] = breather.data[:, 0], (0.0, 0.0)
        for i, instant in enumerate(periodic.INSTANTS):
            self.power[(i, slice(None), *at)] = periodic.power_at(breather, instant)
        self.energy[at] = energy_of(breather.constants, breather.data.astype(complex))
        half = on_half(breather)
        self.growth_half[at] = max(half.growth(parity) for parity in multipliers.PARITIES)
        self.growing[(slice(None), *at)] = one.growing, half.growing
        for p, parity in enumerate(multipliers.PARITIES):
            self.growth[(p, *at)] = one.growth(parity)
            modes = multipliers.localised_modes(breather, *one.spectra[parity])
            for m, mode in enumerate(modes[:MODES]):
                self.trace[(slice(None), m, p, *at)] = mode.trace.real, mode.trace.imag
                self.signature[(m, p, *at)] = mode.signature

    def measure(self, at: tuple[int, ...], one: Member) -> None:
        """Write how fast the fastest perturbations grow in the nonlinear flow, if some do."""
        for p, parity in enumerate(multipliers.PARITIES):
            traces = one.spectra[parity][0]
            rates = multipliers.growths(one.breather.frequency, traces)
            if rates.max() > 0.0:
                trace = complex(traces[rates.argmax()])
                found = perturbed.measured_growth(one.breather, trace, parity)
                self.measured_growth[(p, *at)] = found

    def add_least(self, at: tuple[int, ...], family: list[periodic.Breather]) -> None:
        """Write the least P of a family at an Omega, and where it has that."""
        for i, instant in enumerate(periodic.INSTANTS):
            self.least[(slice(None), i, *at)] = periodic.least_power(family, instant)

    def add_collisions(self, at: tuple[int, ...], one: Member, above: Member) -> None:
        """Write what collides between a member and the one at the next higher frequency."""
        for p, parity in enumerate(multipliers.PARITIES):
            found = multipliers.collision(
                (one.breather, *one.spectra[parity]), (above.breather, *above.spectra[parity]),
                parity,
            )  # fmt: skip
            if found is None:
                continue
            self.collision[(p, *at)] = found.breather.frequency
            self.collision_power[(p, *at)] = steady.power(found.breather.data).sum()
            self.collision_multiplier[(slice(None), p, *at)] = (
                found.trace, np.sqrt(max(0.0, 1.0 - found.trace * found.trace)),
            )  # fmt: skip
            self.collision_signature[(slice(None), p, *at)] = found.signatures


def periodic_contents(
    epsilon: float, gamma: float, omegas: Sequence[float], frequencies: Sequence[float],
    half_widths: Mapping[str, int],
) -> Contents:  # fmt: skip
    """Return the three families at each Omega and frequency; NaN where a family does not exist.

    `half_widths` has the least and the most that a chain may have.
    """
    frequencies = sorted(frequencies)
    table = _Table(len(periodic.FAMILIES), len(omegas), len(frequencies))
    for j, omega in enumerate(omegas):
        constants = Constants(epsilon=epsilon, gamma=gamma, omega=omega)
        edge = waves.highest(constants)  # within the waves, those of a finite chain collide
        for i, family in enumerate(periodic.FAMILIES):
            above, found = None, []
            for breather in periodic.family_of(constants, family, frequencies, half_widths):
                found.append(breather)
                at = (i, j, frequencies.index(breather.frequency))
                one = member_of(breather)
                table.add(at, one)
                if breather.frequency > edge:
                    table.measure(at, one)
                if above is not None and breather.frequency > edge:
                    table.add_collisions(at, one, above)
                above = one
            if found:
                table.add_least((i, j), found)
    about = {"epsilon": epsilon, "gamma": gamma, "residual": periodic.TOLERANCE}
    variables = {
        **_coordinates(omegas, frequencies),
        **_waves(epsilon, gamma, omegas, frequencies),
        **_families(table),
        **_stability(table),
        **_collisions(table),
    }
    return variables, {"title": "Periodic breathers localised at one pair", **about}


def perturbed_contents(
    epsilon: float, gamma: float, omegas: Sequence[float], frequencies: Sequence[float],
    half_widths: Mapping[str, int], change: float, end_time: float, tolerance: float,
) -> Contents:  # fmt: skip
    """Return how P on the central pair swings early and late in long runs from changed breathers.

    NaN where a breather does not exist or is unstable.
    """
    frequencies = sorted(frequencies)
    shape = (2, len(periodic.FAMILIES), len(omegas), len(frequencies))
    lowest, highest = np.full(shape, np.nan), np.full(shape, np.nan)
    for j, omega in enumerate(omegas):
        constants = Constants(epsilon=epsilon, gamma=gamma, omega=omega)
        for i, family in enumerate(periodic.FAMILIES):
            for breather in periodic.family_of(constants, family, frequencies, half_widths):
                if not member_of(breather).growing:
                    at = (slice(None), i, j, frequencies.index(breather.frequency))
                    found = perturbed.swing(breather, change, end_time, tolerance)
                    lowest[at], highest[at] = found
    said = "value of P on the central pair, in a tenth of the run"
    coordinates = _coordinates(omegas, frequencies)
    variables = {
        **{name: coordinates[name] for name in OVER},
        "span": Variable(("span",), ["first tenth", "last tenth"], "part of the run"),
        "lowest_power": kept(("span", *OVER), lowest, f"least {said}", MEASURED_DIGITS),
        "highest_power": kept(("span", *OVER), highest, f"largest {said}", MEASURED_DIGITS),
    }
    about = {"epsilon": epsilon, "gamma": gamma, "change": change, "end_time": end_time}
    title = "How stable periodic breathers move after a change"
    return variables, {"title": title, **about, "tolerance": tolerance}


OVER = ("family", "omega", "frequency")


def _coordinates(omegas, frequencies) -> dict[str, Variable]:
    return {
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
    }


def _waves(epsilon, gamma, omegas, frequencies) -> dict[str, Variable]:
    """Return where the bands of (15) lie, and which frequencies none of whose multiples meets."""
    given = [Constants(epsilon=epsilon, gamma=gamma, omega=omega) for omega in omegas]
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
            ("omega",), [waves.highest(one) for one in given], "highest frequency of linear waves",
        ),
        "free_low": Variable(over, ends[0], says.format("lower")),
        "free_high": Variable(over, ends[1], says.format("upper")),
    }  # fmt: skip


def _families(table: _Table) -> dict[str, Variable]:
    said = "power P of each component"
    least = ("instant", "family", "omega")
    return {
        "instant": Variable(
            ("instant",), list(periodic.INSTANTS), "instant of the period, seen from A and B"
        ),
        "amplitude": kept(
            ("part", "component", *OVER), table.amplitude,
            "amplitude on a site, site 0, when both are real",
        ),
        "power": kept(("component", *OVER), table.power[0], f"{said}, the largest of a period"),
        "quarter_power": kept(
            ("component", *OVER), table.power[1],
            f"{said} a quarter of a period later, when both are imaginary: the least of a period",
        ),
        "least_power": kept(
            least, table.least[1], "least P of a family, at and between its frequencies", 7
        ),
        "least_power_frequency": kept(
            least, table.least[0], "frequency lambda of the breather with this P", 4
        ),
        "energy": kept(OVER, table.energy, "conserved energy H of equation (8)"),
    }  # fmt: skip


def _stability(table: _Table) -> dict[str, Variable]:
    rate = "largest rate of growth of a perturbation"
    signature = "Krein signature of a localised mode, 0 where there is none or it grows"
    trace = "half the sum of a localised mode's multiplier over half a period and of its inverse"
    rates = (table.growth.max(axis=0), table.growth_half, table.growth)
    return {
        "growth": kept(OVER, rates[0], rate, GROWTH_DIGITS),
        "growth_half": kept(OVER, rates[1], f"{rate} on half of the half-width", GROWTH_DIGITS),
        "parity_growth": kept(
            ("parity", *OVER), rates[2], "largest rate of growth by parity", GROWTH_DIGITS
        ),
        "measured_growth": kept(
            ("parity", *OVER), table.measured_growth,
            "largest rate of growth in the nonlinear flow by parity", MEASURED_DIGITS,
        ),
        "growing": Variable(OVER, table.growing[0], "number of multipliers that grow"),
        "growing_half": Variable(
            OVER, table.growing[1], "number of multipliers that grow, on half of the half-width"
        ),
        "mode_trace": kept(
            ("part", "mode", "parity", *OVER), table.trace, trace, GROWTH_DIGITS
        ),
        "mode_signature": Variable(("mode", "parity", *OVER), table.signature, signature),
    }  # fmt: skip


def _collisions(table: _Table) -> dict[str, Variable]:
    says = "between this frequency and the next higher one multipliers collide: "
    over = ("parity", *OVER)
    return {
        "collision_frequency": kept(
            over, table.collision, f"{says}frequency lambda", COLLISION_DIGITS
        ),
        "collision_power": kept(
            over, table.collision_power, f"{says}P of the breather", MEASURED_DIGITS
        ),
        "collision_multiplier": kept(
            ("part", *over), table.collision_multiplier,
            f"{says}their value over half a period, with the change of sign there",
            COLLISION_DIGITS,
        ),
        "collision_signature": Variable(
            ("colliding", *over), table.collision_signature,
            f"{says}their Krein signatures, 0 where none do",
        ),
    }  # fmt: skip
