"""The datasets of steady and of periodic breathers, rounded where LAPACK decides the last bits."""

from collections.abc import Mapping, Sequence

import numpy as np
from latticode.datasets.checks import rounded
from latticode.datasets.netcdf import Variable
from latticode.datasets.trajectories import Contents
from latticode.localised.breathers import TOLERANCE

from pendula.many_cases import COMPONENTS
from pendula.models.pairs import FAMILIES
from pendula.problem import Constants

from . import multipliers, periodic, steady, waves

PARTS = Variable(("part",), ["re", "im"])
DIGITS, GROWTH_DIGITS, LEAST_DIGITS = 10, 7, 7
"""Significant digits of states, of rates, which come from roots of eigenvalues, and of minima."""
RATE = "largest rate of growth of a perturbation"


def kept(dimensions, values, words: str, digits: int = DIGITS) -> Variable:
    """Return a variable rounded to so many significant digits. NaN stands where there is none."""
    words += "; NaN: there is none" if np.isnan(values).any() else ""
    about = {"significant_digits": digits}
    return Variable(dimensions, rounded(values, digits), words, attributes=about)


def _rates(over: tuple[str, ...], values: np.ndarray) -> dict[str, Variable]:
    """Return rates of growth, (2, ...), on half of the half-width and on all of it."""
    return {
        "growth": kept(over, values[1], RATE, GROWTH_DIGITS),
        "growth_half": kept(over, values[0], f"{RATE} on half of the half-width", GROWTH_DIGITS),
    }


def steady_contents(
    epsilon: float, gamma: float, omegas: Sequence[float], half_width: int
) -> Contents:
    """Return all families at each Omega; NaN where a family does not exist.

    Rates of growth are also found on half of `half_width`.
    """
    halves = half_width // 2, 2 * (half_width // 2)
    shape = (len(FAMILIES), len(omegas))
    amplitude, power = np.full((2, 2, *shape), np.nan), np.full(shape, np.nan)
    rates = np.full((2, *shape), np.nan)  # on each of the two chains
    for i, family in enumerate(FAMILIES):
        for j, omega in enumerate(omegas):
            constants = Constants(epsilon=epsilon, gamma=gamma, omega=omega)
            for k, (problem, state) in enumerate(steady.continued(family, constants, halves)):
                rates[k, i, j] = steady.growth(problem, state)
                parts = state.parts(problem)
                amplitude[:, :, i, j] = parts[:, :, halves[k]].T
                power[i, j] = np.sum(parts**2)
    over = ("family", "omega")
    variables = {
        "part": PARTS,
        "component": COMPONENTS,
        "family": Variable(("family",), [one.name for one in FAMILIES], "family of steady states"),
        "omega": Variable(("omega",), np.array(omegas, dtype=float)),
        "amplitude": kept(("part", "component", *over), amplitude, "amplitude on a site, site 0"),
        "power": kept(over, power, "power P, the sum of |A|^2 + |B|^2"),
        **_rates(over, rates),
    }
    about = {"epsilon": epsilon, "gamma": gamma, "residual": TOLERANCE}
    return variables, {"title": "Steady states localised at one pair", **about}


def periodic_contents(
    epsilon: float, gamma: float, omegas: Sequence[float], frequencies: Sequence[float],
    half_widths: Mapping[str, int],
) -> Contents:  # fmt: skip
    """Return the three families at each Omega and frequency; NaN where a family does not exist.

    `half_widths` has the least and the most that a chain may have. Rates of growth are also found
    on half of the half-width that a breather needs.
    """
    frequencies = sorted(frequencies)
    shape = (len(periodic.FAMILIES), len(omegas), len(frequencies))
    amplitude, power, rates = (np.full((2, *shape), np.nan) for _ in range(3))
    least = np.full((len(periodic.INSTANTS), *shape[:2]), np.nan)
    given = [Constants(epsilon=epsilon, gamma=gamma, omega=omega) for omega in omegas]
    for j, constants in enumerate(given):
        for i, family in enumerate(periodic.FAMILIES):
            found = [*periodic.family_of(constants, family, frequencies, half_widths)]
            for one in found:
                at = (slice(None), i, j, frequencies.index(one.frequency))
                amplitude[at], power[at] = one.data[:, 0], periodic.power(one.data)
                rates[at] = multipliers.growth(periodic.on_half(one)), multipliers.growth(one)
            if found:
                least[:, i, j] = [periodic.least_power(found, one) for one in periodic.INSTANTS]
    over = ("family", "omega", "frequency")
    variables = {
        "component": COMPONENTS,
        "family": Variable(("family",), list(periodic.FAMILIES), "family of periodic breathers"),
        "omega": Variable(("omega",), np.array(omegas, dtype=float)),
        "frequency": Variable(
            ("frequency",), np.array(frequencies, dtype=float), "frequency lambda of the breather"
        ),
        "highest_wave": Variable(
            ("omega",), [waves.highest(one) for one in given], "highest frequency of linear waves"
        ),
        "instant": Variable(
            ("instant",), list(periodic.INSTANTS), "instant of the period, seen from A and B"
        ),
        "amplitude": kept(
            ("component", *over), amplitude, "amplitude on a site, site 0, when both are real"
        ),
        "power": kept(
            ("component", *over), power, "power P of each component, the largest of a period"
        ),
        "least_power": kept(
            ("instant", *over[:2]), least, "least P of a family, at and between its frequencies",
            LEAST_DIGITS,
        ),
        **_rates(over, rates),
    }  # fmt: skip
    about = {"epsilon": epsilon, "gamma": gamma, "residual": periodic.TOLERANCE}
    return variables, {"title": "Periodic breathers localised at one pair", **about}
