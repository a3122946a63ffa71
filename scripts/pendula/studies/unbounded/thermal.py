"""The thermal states exp(-beta H) of the infinite chain, solved by its transfer operator.

Nothing is sampled: an eigenvector of the operator (see `transfer`) gives the means of a site. Their
error is that of the grid, which a coarser and wider grid measures.

The energy needs no bond. The mean of y dH/dy is f / beta a site with f coordinates, and y dH/dy is
2 H plus twice the quartic term: the energy a site is f / (2 beta) - <quartic>. Two fields have four
coordinates a site, and the chain with A = -B has two.

The states have the same bits on every machine. What is published is rounded to DIGITS: the grid
gives no more.
"""

from typing import NamedTuple

import numpy as np
from latticode.datasets.checks import rounded
from latticode.datasets.netcdf import Variable
from latticode.datasets.trajectories import Contents
from latticode.numerics.elementary import exp, log

from pendula.problem import Constants

from . import transfer
from .bulk import POWER
from .extremes import law_of_maxima

HOT, COLD = 1e-3, 1e5
"""Inverse temperatures between which a state is looked for."""

HALVINGS, SECANTS = 7, 12
"""Steps to a rough beta on a coarse grid, and the most steps from there on a finer one."""

DIGITS, PLACES = 7, 10
LAST_DIGIT = float(f"1e-{DIGITS}")
"""Significant digits of what is published, and decimals of the law of maxima."""


class NoStateError(ValueError):
    """No thermal state between HOT and COLD has the energy."""


class ThermalState(NamedTuple):
    """A thermal state: means of a site of the infinite chain."""

    beta: float
    energy: float  # a site
    power: float  # <|A|^2 + |B|^2>
    power_error: float  # change from a coarser and wider grid, and the rounding
    operator: transfer.Operator
    vector: np.ndarray  # psi, the sum of its squares is one


def state_of_energy(
    constants: Constants, energy: float, nodes: int, antisymmetric: bool = False
) -> ThermalState:
    """Return the thermal state with an energy per site, on `nodes` half-nodes a coordinate.

    It is that of both fields, or of the chain with A = -B.

    Three grids follow each other: one with half of the nodes finds beta roughly and how far the
    distribution reaches, one with three quarters gives the error, the last gives the state.
    Raises NoStateError where no state between HOT and COLD has this energy.
    """
    few, some = nodes // 2, 3 * nodes // 4

    def is_too_hot(beta: float) -> bool:
        grid = transfer.half_nodes(transfer.widest(constants, beta), few, antisymmetric)
        return _excess(constants, beta, grid, energy)[0] < 0.0

    if not is_too_hot(HOT) or is_too_hot(COLD):
        told = f"{energy:g} at Omega = {constants.omega:g}"
        raise NoStateError(f"no thermal state between the temperatures tried has the energy {told}")
    hot, cold = HOT, COLD
    for _ in range(HALVINGS):
        beta = float(np.sqrt(hot * cold))
        hot, cold = (beta, cold) if is_too_hot(beta) else (hot, beta)
    beta = float(np.sqrt(hot * cold))
    reach, powers = transfer.widest(constants, beta), []
    for count, wider in ((few, 1.0), (some, 1.1), (nodes, 1.0)):
        grid = transfer.half_nodes(wider * reach, count, antisymmetric)
        beta, operator, vector = _refined(constants, beta, grid, energy)
        reach = transfer.reach_of(operator, vector)
        powers.append(float(np.sum(vector * vector * operator.power)))
    error = abs(powers[-1] - powers[-2]) + 0.5 * LAST_DIGIT * powers[-1]
    return ThermalState(beta, energy, powers[-1], error, operator, vector)


def _excess(constants, beta, grid, energy, vector=None) -> tuple:
    """Return beta (energy - that of the state at beta), which rises with beta; operator, vector."""
    operator = transfer.make_operator(constants, beta, grid)
    vector = transfer.leading(operator, vector)
    quartic = float(np.sum(vector * vector * operator.quartic))
    return beta * (energy + quartic) - 0.5 * operator.freedom, operator, vector


def _refined(constants, beta, grid, energy) -> tuple:
    """Return beta, operator and vector where the excess vanishes, by secants in log beta."""
    old, (excess, operator, vector) = beta, _excess(constants, beta, grid, energy)
    beta *= 1.01
    for _ in range(SECANTS):
        before = excess
        excess, operator, vector = _excess(constants, beta, grid, energy, vector)
        if abs(excess) < 1e-8:
            return beta, operator, vector
        slope = (excess - before) / log(beta / old)
        old, beta = beta, beta * float(exp(np.clip(-excess / slope, -0.5, 0.5)))
    raise ArithmeticError("no temperature with this energy was found")


# --- The dataset ----------------------------------------------------------------------------------

BOUNDS = 60
"""Values of the bound whose law is solved."""


def solve_thermal(
    epsilon: float, gamma: float, omegas: list[float], bulk_omega: float, nodes: int
) -> Contents:
    """Return the states without energy at all `omegas`, of both fields and of A = -B.

    Where one has no such state it is left out. The law of the largest modulus is that of the state
    whose Omega is nearest to `bulk_omega`.
    """
    both, alone = [], []
    for omega in omegas:
        constants = Constants(epsilon=epsilon, gamma=gamma, omega=omega)
        try:
            states = [state_of_energy(constants, 0.0, nodes, alike) for alike in (False, True)]
        except NoStateError as error:
            print(f"left out: {error}")
            continue
        both.append(states[0])
        alone.append(states[1])
    nearest = min(both, key=lambda one: abs(one.operator.constants.omega - bulk_omega))
    title = "Thermal states of the infinite chain, by its transfer operator"
    attributes = {"title": title, "epsilon": epsilon, "gamma": gamma, "nodes": 2 * nodes}
    return thermal_variables(both, alone) | maximum_variables(nearest), attributes


def thermal_variables(both: list[ThermalState], alone: list[ThermalState]) -> dict[str, Variable]:
    """Return the states of zero energy, one for each Omega, of both fields and of A = -B."""
    return {
        "omega": Variable(("omega",), [one.operator.constants.omega for one in both]),
        **_means(both, "", "in the thermal state of no energy"),
        **_means(alone, "antisymmetric_", "in that of the chain with A = -B"),
    }


def _means(states: list[ThermalState], prefix: str, words: str) -> dict[str, Variable]:
    of_error = f"error of the discretisation and rounding of that {POWER}"
    named = {
        "power": (DIGITS, f"{POWER} {words}"),
        "power_error": (2, of_error),
    }
    return {
        f"{prefix}{name}": Variable(
            ("omega",),
            rounded(np.array([getattr(one, name) for one in states]), digits),
            long_name,
            attributes={"significant_digits": digits},
        )
        for name, (digits, long_name) in named.items()
    }


def maximum_variables(state: ThermalState) -> dict[str, Variable]:
    """Return the law of the largest modulus in a thermal state, at BOUNDS values of m.

    The last of them is a bound on one modulus: at a given power that of one amplitude alone has
    twice the quartic energy of `widest`, so that it ends at a 2^(1/4) of that reach.
    """
    constants = state.operator.constants
    reach = float(transfer.widest(constants, state.beta)[0]) / np.sqrt(np.sqrt(2.0))
    bounds = reach * np.arange(1, BOUNDS + 1) / BOUNDS
    rates, overlaps = law_of_maxima(constants, state.beta, bounds)
    chance = "the chance c exp(-r (N - 1)) that no modulus on N neighbouring sites is above it"
    found = {
        "bound": (bounds, "bound on the moduli |A_n| and |B_n|"),
        "bound_rate": (rates, f"r in {chance}"),
        "bound_overlap": (overlaps, f"c in {chance}"),
    }
    said = {"decimal_places": PLACES}
    variables = {
        name: Variable(("bound",), values.round(PLACES) + 0.0, long_name, attributes=said)
        for name, (values, long_name) in found.items()
    }
    at = Variable((), constants.omega, "detuning Omega of this thermal state")
    return {**variables, "bound_omega": at}
