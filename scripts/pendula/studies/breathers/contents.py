"""The dataset of steady states, and how the study rounds values whose last bits LAPACK decides."""

from collections.abc import Mapping, Sequence

import numpy as np

from pendula.datasets.checks import rounded
from pendula.datasets.netcdf import Variable
from pendula.datasets.trajectories import COMPONENTS, Contents
from pendula.ends import DIRICHLET
from pendula.models.amplitudes import Chain, energy
from pendula.models.chain import MIRROR
from pendula.models.pairs import FAMILIES, pair
from pendula.problem import Constants

from . import branches, steady

PARTS = Variable(("part",), ["re", "im"])
DIGITS, GROWTH_DIGITS = 10, 7
"""Significant digits of states and of rates: rates come from roots of eigenvalues."""
BESIDE = 0.05
"""How far from the turning point of the daughter the pitchfork is looked for, in units of gamma."""


def kept(dimensions, values, words: str, digits: int | None = DIGITS) -> Variable:
    """Return a variable rounded to so many significant digits, or as it is if they are None.

    NaN stands where a family has no state, or no state that the words speak of.
    """
    words += "; NaN: there is none" if np.isnan(values).any() else ""
    if digits is None:
        return Variable(dimensions, values, words)
    about = {"significant_digits": digits}
    return Variable(dimensions, rounded(values, digits), words, attributes=about)


def energy_of(constants: Constants, state: np.ndarray) -> float:
    """Return H of equation (8) of an even complex state, (component, site 0..M)."""
    y = np.zeros((4, state.shape[1] + 2))
    y[::2, 1:-1], y[1::2, 1:-1] = state.real, state.imag
    chain = Chain(constants.epsilon, constants.gamma, constants.omega, MIRROR, DIRICHLET)
    return float(energy(chain, y))


def steady_contents(
    epsilon: float, gamma: float, omegas: Sequence[float], half_width: int, stability: Mapping
) -> Contents:  # fmt: skip
    """Return all families at each Omega, where they are born, and where they are stable.

    Rates of growth are also found on half of `half_width`. `stability` has for a family the
    interval of Omega `between` which its stability changes, and the distance `to` which this is
    found.
    """
    halves = half_width // 2, 2 * (half_width // 2)
    shape = (len(FAMILIES), len(omegas))
    amplitude = np.full((2, 2, *shape), np.nan)
    power, energies = np.full((2, *shape), np.nan)
    rates = np.full((2, *shape), np.nan)  # on each of the two chains
    for i, family in enumerate(FAMILIES):
        for j, omega in enumerate(omegas):
            if pair(family, gamma, omega) is None:
                continue
            for k, half in enumerate(halves):
                chain = steady.Chain(epsilon, gamma, omega, half)
                state = steady.continued(chain, family)
                rates[k, i, j] = steady.fastest_growth(chain, family, state)
            turned = state * (1j if family.imaginary else 1.0)
            amplitude[:, :, i, j] = turned[:, 0].real, turned[:, 0].imag
            power[i, j] = steady.power(state).sum()
            energies[i, j] = energy_of(Constants(epsilon=epsilon, gamma=gamma, omega=omega), turned)
    over, rate = ("family", "omega"), "largest rate of growth of a perturbation"
    variables = {
        "part": PARTS,
        "component": COMPONENTS,
        "family": Variable(("family",), [one.name for one in FAMILIES], "family of steady states"),
        "omega": Variable(("omega",), np.array(omegas, dtype=float)),
        "amplitude": kept(("part", "component", *over), amplitude, "amplitude on a site, site 0"),
        "power": kept(over, power, "power P, the sum of |A|^2 + |B|^2"),
        "energy": kept(over, energies, "conserved energy H of equation (8)"),
        "growth": kept(over, rates[1], rate, GROWTH_DIGITS),
        "growth_half": kept(over, rates[0], f"{rate} on half of the half-width", GROWTH_DIGITS),
        **_births(epsilon, gamma, halves[0]),
        **_thresholds(epsilon, gamma, halves, stability),
    }
    about = {"epsilon": epsilon, "gamma": gamma, "half_width": halves[1]}
    about["residual"] = steady.TOLERANCE
    return variables, {"title": "Steady states localised at one pair", **about}


def _births(epsilon: float, gamma: float, half_width: int) -> dict[str, Variable]:
    """Return the Omega of the two pitchforks, by the eigenvalue, and by the arc of the daughter."""
    names, pitchforks, turning_points = [], [], []
    for daughter, parent in ((FAMILIES[2], FAMILIES[1]), (FAMILIES[4], FAMILIES[3])):
        highest = -gamma if parent.kind == "equal" else -3.0 * gamma  # where epsilon = 0
        chain = steady.Chain(epsilon, gamma, highest - gamma, half_width)
        state = steady.continued(chain, daughter)
        points = branches.follow(chain, daughter, state, stop=highest - gamma)
        top = branches.turning_point(points)
        near = top - BESIDE * gamma, top + BESIDE * gamma
        names.append(daughter.name)
        pitchforks.append(branches.pitchfork(chain, parent, *near))
        turning_points.append(top)
    over = ("born_family",)
    return {
        "born_family": Variable(over, names, "family born in a pitchfork"),
        "pitchfork": kept(over, pitchforks, "Omega of the pitchfork", 8),
        "turning_point": kept(
            over, turning_points, "Omega where the family turns, from its arc", 6
        ),
    }  # fmt: skip


def _thresholds(
    epsilon: float, gamma: float, halves: tuple[int, int], stability: Mapping
) -> dict[str, Variable]:  # fmt: skip
    """Return the Omega below which families are stable, on chains of both half-widths."""
    named = {family.name: family for family in FAMILIES}
    found = [
        [
            branches.threshold(
                steady.Chain(epsilon, gamma, 0.0, half), named[name], *ends, stability["to"]
            )
            for half in halves
        ]
        for name, ends in stability["between"].items()
    ]
    over = ("stable_family", "chain_half_width")
    return {
        over[0]: Variable(over[:1], list(stability["between"]), "family that can be stable"),
        over[1]: Variable(over[1:], list(halves), "half-width"),
        "stable_below": kept(over, found, "Omega below which a family is stable", 6),
    }
