"""The thermal states exp(-beta H) of the infinite chain, solved by its transfer operator.

Nothing is sampled: an eigenvector of the operator (see `transfer`) gives the means of a site. Their
error is that of the grid, which a coarser and wider grid measures.

The energy needs no bond. The mean of y dH/dy is f / beta for a site with f coordinates, and y dH/dy
is 2 H plus twice the quartic term: the energy per site is f / (2 beta) - <quartic>. Two fields have
four coordinates a site, and the chain with A = -B has two.
"""

from typing import NamedTuple

import numpy as np
from latticode.datasets.netcdf import Variable
from latticode.datasets.trajectories import Contents
from latticode.numerics.elementary import exp, log
from replication.variables import FEW_CHOICES, REGULAR, SCATTERED

from pendula.problem import Constants

from . import transfer
from .bulk import POWER

HOT, COLD = 1e-3, 1e5
"""Largest and smallest temperature 1 / beta: states are searched between these beta."""

HALVINGS, SECANTS = 7, 12
"""Steps to a rough beta on a coarse grid, and the most steps from there on a finer one."""


class NoThermalStateError(ValueError):
    """No thermal state between HOT and COLD has the energy."""


class ThermalState(NamedTuple):
    """A thermal state: means of a site of the infinite chain."""

    beta: float
    power: float  # <|A|^2 + |B|^2>
    power_error: float  # change from a coarser and wider grid
    operator: transfer.Operator


def state_of_energy(
    constants: Constants, energy: float, nodes: int, antisymmetric: bool = False
) -> ThermalState:
    """Return the thermal state with this energy per site, on `nodes` half-nodes a coordinate.

    It is that of both fields, or that of the chain with A = -B. Three grids are used: one with half
    of the nodes gives a rough beta and the extent of the distribution, one with three quarters the
    error, the last one the state. Raises NoThermalStateError if no state between HOT and COLD has
    this energy.
    """
    few, some = nodes // 2, 3 * nodes // 4

    def is_too_hot(beta: float) -> bool:
        grid = transfer.half_nodes(transfer.widest(constants, beta), few, antisymmetric)
        return _excess(constants, beta, grid, energy)[0] < 0.0

    if not is_too_hot(HOT) or is_too_hot(COLD):
        state_text = f"{energy:g} at Omega = {constants.omega:g}"
        raise NoThermalStateError(
            f"no thermal state between the temperatures tried has the energy {state_text}"
        )
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
    return ThermalState(beta, powers[-1], abs(powers[-1] - powers[-2]), operator)


def _excess(constants, beta, grid, energy, vector=None) -> tuple:
    """Return beta (energy - that of the state at beta), which rises with beta; operator, vector."""
    operator = transfer.make_operator(constants, beta, grid)
    vector = transfer.leading(operator, vector)
    quartic = float(np.sum(vector * vector * operator.quartic))
    return beta * (energy + quartic) - 0.5 * operator.freedom, operator, vector


def _refined(constants, beta, grid, energy) -> tuple:
    """Return beta, operator and vector at which the excess vanishes, by secants in log beta."""
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


def solve_thermal(epsilon: float, gamma: float, omegas: list[float], nodes: int) -> Contents:
    """Return the dataset of the states of zero energy at `omegas`, both fields and A = -B.

    An Omega at which one has no such state is left out.
    """
    states = []
    for omega in omegas:
        constants = Constants(epsilon=epsilon, gamma=gamma, omega=omega)
        try:
            states.append(
                [
                    state_of_energy(constants, 0.0, nodes, antisymmetric)
                    for antisymmetric in (False, True)
                ]
            )
        except NoThermalStateError as error:
            print(f"left out: {error}")
    known = [both.operator.constants.omega for both, _ in states]
    variables, along = {"omega": Variable(("omega",), known, attributes=FEW_CHOICES)}, ("omega",)
    for number, prefix, words in (
        (0, "", f"{POWER} in the thermal state of no energy"),
        (1, "antisymmetric_", f"{POWER} in that of the chain with A = -B"),
    ):
        powers, errors = np.reshape([pair[number][1:3] for pair in states], (-1, 2)).T
        variables[f"{prefix}power"] = Variable(along, powers, words)
        long_name = f"change of the {words} from a coarser and wider grid"
        variables[f"{prefix}power_error"] = Variable(along, errors, long_name, attributes=SCATTERED)
    title = "Thermal states of the infinite chain, by its transfer operator"
    return variables, {
        "title": title,
        "epsilon": epsilon,
        "gamma": gamma,
        "nodes": 2 * nodes,
        **REGULAR,
    }
