"""The datasets of the study: what each variable holds, rounded where LAPACK decides last bits."""

from collections.abc import Mapping, Sequence

import numpy as np

from pendula.datasets.checks import rounded
from pendula.datasets.netcdf import Variable
from pendula.datasets.registry import NAMES
from pendula.datasets.trajectories import COMPONENTS, Contents, describe_run
from pendula.ends import DIRICHLET
from pendula.models.amplitudes import Chain, energy
from pendula.models.chain import MIRROR
from pendula.models.pairs import FAMILIES, pair
from pendula.problem import Constants, Problem, output_times

from . import branches, driven_growth, sensitivity, steady

PARTS = Variable(("part",), ["re", "im"])
DIGITS, GROWTH_DIGITS = 10, 7
"""Significant digits of states and of rates: rates come from roots of eigenvalues."""


def energy_of(constants: Constants, state: np.ndarray) -> float:
    """Return H of equation (8) of an even complex state, (component, site 0..M)."""
    y = np.zeros((4, state.shape[1] + 2))
    y[::2, 1:-1], y[1::2, 1:-1] = state.real, state.imag
    chain = Chain(constants.epsilon, constants.gamma, constants.omega, MIRROR, DIRICHLET)
    return float(energy(chain, y))


def kept(dimensions: tuple[str, ...], values, words: str, digits: int = DIGITS) -> Variable:
    about = {"significant_digits": digits}
    return Variable(dimensions, rounded(values, digits), words, attributes=about)


# --- Steady states --------------------------------------------------------------------------------


def steady_contents(
    epsilon: float, gamma: float, omegas: Sequence[float], half_width: int, stability: Mapping
) -> Contents:  # fmt: skip
    """Return all families at each Omega, where they are born, and where they are stable.

    Rates of growth are also found on half of `half_width`. `stability` has for a family the
    interval of Omega `between` which its stability changes, and the distance `to` which this is
    found.
    """
    half_width //= 2
    shape = (len(FAMILIES), len(omegas))
    amplitude = np.full((2, 2, *shape), np.nan)
    power, energies, rates, doubled = (np.full(shape, np.nan) for _ in range(4))
    for i, family in enumerate(FAMILIES):
        for j, omega in enumerate(omegas):
            if pair(family, gamma, omega) is None:
                continue
            state = None
            for half, found in ((half_width, rates), (2 * half_width, doubled)):
                chain = steady.Chain(epsilon, gamma, omega, half)
                state = steady.near_to(state, chain, family)
                found[i, j] = steady.fastest_growth(chain, family, state)
            turned = state * (1j if family.imaginary else 1.0)
            amplitude[:, :, i, j] = turned[:, 0].real, turned[:, 0].imag
            power[i, j] = steady.power(state).sum()
            energies[i, j] = energy_of(Constants(epsilon=epsilon, gamma=gamma, omega=omega), turned)
    over = ("family", "omega")
    variables = {
        "part": PARTS,
        "component": COMPONENTS,
        "family": Variable(("family",), [one.name for one in FAMILIES], "family of steady states"),
        "omega": Variable(("omega",), np.array(omegas, dtype=float)),
        "amplitude": kept(("part", "component", *over), amplitude, "amplitude on a site, site 0"),
        "power": kept(over, power, "power P, the sum of |A|^2 + |B|^2"),
        "energy": kept(over, energies, "conserved energy H of equation (8)"),
        "growth": kept(over, doubled, "largest rate of growth of a perturbation", GROWTH_DIGITS),
        "growth_half": kept(
            over,
            rates,
            "largest rate of growth of a perturbation on half of the half-width",
            GROWTH_DIGITS,
        ),
        **_births(epsilon, gamma, half_width),
        **_thresholds(epsilon, gamma, half_width, stability),
    }
    about = {"epsilon": epsilon, "gamma": gamma, "half_width": 2 * half_width}
    about["residual"] = steady.TOLERANCE
    return variables, {"title": "Steady states localised at one pair", **about}


BESIDE = 0.05
"""How far from the turning point of the daughter the pitchfork is looked for, in units of gamma."""


def _births(epsilon: float, gamma: float, half_width: int) -> dict[str, Variable]:
    """Return the Omega of the two pitchforks, by the eigenvalue, and by the arc of the daughter."""
    found, arcs, names = [], [], []
    for daughter, parent in ((FAMILIES[2], FAMILIES[1]), (FAMILIES[4], FAMILIES[3])):
        highest = -gamma if parent.kind == "equal" else -3.0 * gamma
        chain = steady.Chain(epsilon, gamma, highest - gamma, half_width)
        s, state = daughter.drive(gamma), steady.continued(chain, daughter)
        points = branches.follow(chain, s, state, 1.0, stop=highest - gamma)
        arcs.append(branches.turning_point(points))
        near = arcs[-1] - BESIDE * gamma, arcs[-1] + BESIDE * gamma
        found.append(branches.pitchfork(chain, parent, *near))
        names.append(daughter.name)
    return {
        "born_family": Variable(("born_family",), names, "family born in a pitchfork"),
        "pitchfork": kept(("born_family",), found, "Omega of the pitchfork", 8),
        "turning_point": kept(
            ("born_family",), arcs, "Omega where the family turns, from its arc", 6
        ),
    }


def _thresholds(epsilon, gamma, half_width, stability) -> dict[str, Variable]:
    """Return the Omega below which families are stable, on the chain and on twice as long a one."""
    named = {family.name: family for family in FAMILIES}
    chains = [steady.Chain(epsilon, gamma, 0.0, half) for half in (half_width, 2 * half_width)]
    found = [
        branches.thresholds(chains, named[name], *ends, stability["to"])
        for name, ends in stability["between"].items()
    ]
    return {
        "stable_family": Variable(
            ("stable_family",), list(stability["between"]), "family that can be stable"
        ),
        "chain_half_width": Variable(
            ("chain_half_width",), [half_width, 2 * half_width], "half-width"
        ),
        "stable_below": kept(
            ("stable_family", "chain_half_width"),
            found,
            "Omega below which a family is stable",
            6,
        ),
    }


# --- Sensitivity and growth -----------------------------------------------------------------------


def sensitivity_contents(
    name: str, problem: Problem, sizes: Sequence[float], members: int, seed: int,
    scan: Sequence[float],
) -> Contents:  # fmt: skip
    """Return the share that spreads by the size of a change, and what each amplitude leads to."""
    amplitudes = np.array(scan)
    share = sensitivity.shares(problem, sizes, members, seed)
    largest, spread = sensitivity.scan(problem, amplitudes)
    said = "share of runs that spread"
    variables = {
        "size": Variable(
            ("size",), np.array(sizes), "size of a random change of the data, relative"
        ),
        "share": Variable(("size",), share.value, said),
        "share_low": Variable(("size",), share.low, f"{said}, lower confidence limit"),
        "share_high": Variable(("size",), share.high, f"{said}, upper confidence limit"),
        "initial": Variable(("initial",), amplitudes, f"{NAMES['initial']}, given by A_0 alone"),
        "largest_l2": Variable(("initial",), largest, "largest l2 norm of A and B together"),
        "spread": Variable(
            ("initial",), spread.astype(np.int8), "1 if the run has spread at its end"
        ),
    }
    described = describe_run(name, problem, problem.solver)
    about = {"members": members, "seed": seed}
    a, b = problem.initial[:, problem.initial.shape[1] // 2].real
    if a:
        about["ratio"] = float(b / a)
    return variables, {"title": f"Which data close to those of {name} spread", **described, **about}


def growth_contents(
    epsilon: float, omega: float, end_times: Mapping[float, float], frequencies: Sequence[float],
    start: float, half_widths: Mapping[str, int], outputs: int, tolerance: float,
) -> Contents:  # fmt: skip
    """Return what a free breather gains from each drive, by runs and by the law of weak drives.

    The law is summed over breathers at `frequencies` up to the edge of the band of waves.
    `end_times` is by gamma; `half_widths` those of the `profile` and the `chain`.
    """
    free = Constants(epsilon=epsilon, gamma=1.0, omega=omega)
    edge = driven_growth.edge(free)
    inside = [frequency for frequency in frequencies if frequency < edge]
    family = driven_growth.free_breathers(free, [*inside, edge], half_widths["profile"])
    first = int(np.argmin([abs(one.frequency - start) for one in family]))
    times, found, predicted = [], [], []
    for gamma, end in end_times.items():
        constants = Constants(epsilon=epsilon, gamma=gamma, omega=omega)
        tau = output_times(end, end / outputs)
        times.append(tau)
        found.append(
            driven_growth.gained(constants, family[first], half_widths["chain"], tau, tolerance)
        )
        law = driven_growth.predicted(constants, family, first, tau)
        predicted.append(law - law[0])
    grid, over = ("gamma", "output"), ("frequency",)
    variables = {
        "gamma": Variable(("gamma",), np.array(list(end_times))),
        "time": Variable(grid, np.array(times), "slow time of the run with this gamma"),
        "gained": Variable(grid, np.array(found), "sum of |B|^2, which the breather gains as well"),
        "predicted_gain": kept(grid, predicted, "the same by the law of weak drives", 9),
        "frequency": Variable(
            over, [one.frequency for one in family], "frequency lambda of the breather"
        ),
        "free_power": kept(over, [one.power for one in family], "P of the breather without drive"),
        "predicted_rate": kept(
            over,
            [driven_growth.rate(free, one) for one in family],
            "rate of growth of P by the law, over gamma^2",
            9,
        ),
        "own_rate": kept(
            over,
            [driven_growth.own_radiation(free, one) for one in family],
            "rate at which A radiates its own image, over gamma^2",
            9,
        ),
    }
    about = {"epsilon": epsilon, "omega": omega, "start_frequency": start, "tolerance": tolerance}
    return variables, {"title": "How the drive feeds a localised motion", **about}
