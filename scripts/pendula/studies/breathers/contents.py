"""The datasets of steady and periodic breathers, rounded: LAPACK's bits differ between machines."""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from latticode.datasets.checks import rounded
from latticode.datasets.netcdf import Variable
from latticode.datasets.trajectories import Contents
from latticode.localised.breathers import TOLERANCE, exponents
from replication.variables import FEW_CHOICES, REGULAR, missing

from pendula.many_cases import COMPONENTS
from pendula.models.pairs import FAMILIES, pair
from pendula.models.steady import localised
from pendula.problem import Constants

from . import multipliers, periodic

RE_IM = Variable(("part",), ["re", "im"])
DIGITS, GROWTH_DIGITS = 10, 7
"""Significant digits of states, and of growth rates, which are roots of eigenvalues."""
RATE = "largest rate of growth of a perturbation"


def rounded_variable(
    dimensions: tuple[str, ...], values: np.ndarray, words: str, digits: int = DIGITS
) -> Variable:
    """Return a variable rounded to `digits` significant digits, NaN where there is no state."""
    attributes = {"significant_digits": digits, **missing("there is no such state")}
    return Variable(dimensions, rounded(values, digits), words, attributes=attributes)


def solve_steady_states(
    epsilon: float, gamma: float, omegas: Sequence[float], half_width: int
) -> Contents:
    """Return the dataset of steady states (family, omega), NaN where a pair has no such state."""
    shape = (len(FAMILIES), len(omegas))
    amplitude, (power, rates) = np.full((2, 2, *shape), np.nan), np.full((2, *shape), np.nan)
    for at in np.ndindex(shape):
        family, omega = FAMILIES[at[0]], omegas[at[1]]
        if pair(family, gamma, omega) is None:
            continue
        constants = Constants(epsilon=epsilon, gamma=gamma, omega=omega)
        problem, state = localised(family, constants, half_width)
        amplitudes = state.components(problem)
        amplitude[(..., *at)], power[at] = amplitudes[:, :, half_width].T, np.sum(amplitudes**2)
        rates[at] = max(0.0, float(exponents(problem, state).real.max()))
    over = ("family", "omega")
    variables = {
        "part": RE_IM,
        "component": COMPONENTS,
        "family": Variable(
            ("family",),
            [family_of_pairs.name for family_of_pairs in FAMILIES],
            "family of steady states",
        ),
        "omega": Variable(("omega",), np.array(omegas, dtype=float), attributes=FEW_CHOICES),
        "amplitude": rounded_variable(
            ("part", "component", *over), amplitude, "amplitude on a site, site 0"
        ),
        "power": rounded_variable(over, power, "power P, the sum of |A|^2 + |B|^2"),
        "growth": rounded_variable(over, rates, RATE, GROWTH_DIGITS),
    }
    attributes = {"epsilon": epsilon, "gamma": gamma, "residual": TOLERANCE, **REGULAR}
    return variables, {"title": "Steady states localised at one pair", **attributes}


def solve_periodic_breathers(
    epsilon: float,
    gamma: float,
    omegas: Sequence[float],
    frequencies: Sequence[float],
    half_width: int,
    solitons: Mapping[str, Any],
) -> Contents:
    """Return the dataset of periodic breathers (family, omega, frequency), NaN where none exists.

    `solitons` has Omega, the frequencies and the two half-widths for the solitons A = B.
    """
    shape = (len(periodic.FAMILIES), len(omegas), len(frequencies))
    amplitude, power = (np.full((2, *shape), np.nan) for _ in range(2))
    least, rates = (np.full(shape, np.nan) for _ in range(2))
    constants_by_omega = [Constants(epsilon=epsilon, gamma=gamma, omega=omega) for omega in omegas]
    for at in np.ndindex(shape):
        family, constants, frequency = (
            periodic.FAMILIES[at[0]],
            constants_by_omega[at[1]],
            frequencies[at[2]],
        )
        if (breather := periodic.find_breather(family, constants, frequency, half_width)) is None:
            continue
        amplitude[(slice(None), *at)], power[(slice(None), *at)] = (
            breather.data[:, 0],
            periodic.power(breather.data),
        )
        least[at], rates[at] = periodic.least_power(breather), multipliers.growth_rate(breather)
    over = ("family", "omega", "frequency")
    largest = "power P of each component, the largest of a period"
    variables = {
        "component": COMPONENTS,
        "family": Variable(("family",), list(periodic.FAMILIES), "family of periodic breathers"),
        "omega": Variable(("omega",), np.array(omegas, dtype=float), attributes=FEW_CHOICES),
        "frequency": Variable(
            ("frequency",), np.array(frequencies, dtype=float), "frequency lambda of the breather"
        ),
        "highest_wave": Variable(
            ("omega",),
            list(map(periodic.highest_wave, constants_by_omega)),
            "highest frequency of linear waves",
        ),
        "amplitude": rounded_variable(
            ("component", *over), amplitude, "amplitude on a site, site 0, when both are real"
        ),
        "power": rounded_variable(("component", *over), power, largest),
        "least_power": rounded_variable(
            over, least, "power P of both components, the least of a period"
        ),
        "growth": rounded_variable(over, rates, RATE, GROWTH_DIGITS),
        **solve_solitons(epsilon, gamma, **solitons),
    }
    attributes = {"epsilon": epsilon, "gamma": gamma, "residual": periodic.TOLERANCE}
    attributes |= REGULAR
    return variables, {"title": "Periodic breathers localised at one pair", **attributes}


def solve_solitons(
    epsilon: float,
    gamma: float,
    omega: float,
    frequencies: Sequence[float],
    half_widths: Sequence[int],
) -> dict[str, Variable]:
    """Return P of the solitons A = B, and growth rates of perturbations on each chain.

    A growth rate that depends on the length is due to waves reflected by the ends.
    """
    constants = Constants(epsilon=epsilon, gamma=gamma, omega=omega)
    powers, rates = np.empty((2, len(half_widths), len(frequencies)))
    for at in np.ndindex(rates.shape):
        soliton = periodic.find_soliton(constants, frequencies[at[1]], half_widths[at[0]])
        powers[at], rates[at] = periodic.power(soliton.data).sum(), multipliers.growth_rate(soliton)
    over = ("soliton_half_width", "soliton_frequency")
    return {
        "soliton_half_width": Variable(
            over[:1], list(half_widths), "half-width of the chain", attributes=FEW_CHOICES
        ),
        "soliton_frequency": Variable(
            over[1:], np.array(frequencies, float), f"frequency of the soliton at Omega = {omega:g}"
        ),
        "soliton_power": rounded_variable(over[1:], powers[-1], "power P of the soliton A = B"),
        "soliton_growth": rounded_variable(over, rates, RATE, GROWTH_DIGITS),
    }
