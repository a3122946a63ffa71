"""The thermal states exp(-beta H) of the infinite chain, solved by its transfer operator.

Nothing is sampled: an eigenvector of the operator (see `transfer`) gives the means of a site. The
error of these means is due to the grid. A coarser and wider grid measures this error.

The energy per site is f / (2 beta) - <quartic> for f coordinates y per site, because the mean of
y dH/dy is f / beta per site, and y dH/dy is 2 H plus twice the quartic term. Two fields have f = 4,
and the chain with A = -B has f = 2.
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
"""beta at the highest and at the lowest temperature of the search."""

Grid = tuple[np.ndarray, ...]
"""The nodes of each coordinate."""

HALVINGS, SECANTS = 7, 12
"""Bisections to a rough beta on the coarsest grid; maximum number of secant steps on each grid."""


class NoThermalStateError(ValueError):
    """No thermal state with beta between HOT and COLD has the required energy."""


class ThermalState(NamedTuple):
    """A thermal state: means of a site of the infinite chain."""

    beta: float
    power: float  # <|A|^2 + |B|^2>
    power_error: float  # change from a coarser and wider grid
    operator: transfer.Operator


def state_of_energy(
    constants: Constants, energy: float, nodes: int, antisymmetric: bool = False
) -> ThermalState:
    """Return the thermal state with this energy per site, on `nodes` half-nodes per coordinate.

    The state has both fields, or A = -B if `antisymmetric`. Half of the nodes give a rough beta and
    the extent of the distribution. Three quarters of the nodes give the error of P, and all nodes
    give the state. Raises NoThermalStateError if no state between HOT and COLD has this energy.
    """
    few, some = nodes // 2, 3 * nodes // 4

    def is_too_hot(beta: float) -> bool:
        grid = transfer.half_nodes(transfer.widest(constants, beta), few, antisymmetric)
        return _excess(constants, beta, grid, energy)[0] < 0.0

    if not is_too_hot(HOT) or is_too_hot(COLD):
        raise NoThermalStateError(
            f"no thermal state with beta from {HOT:g} to {COLD:g} has the energy {energy:g} at"
            f" Omega = {constants.omega:g}"
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


def _excess(
    constants: Constants, beta: float, grid: Grid, energy: float, vector: np.ndarray | None = None
) -> tuple[float, transfer.Operator, np.ndarray]:
    """Return beta (energy - energy at beta), which rises with beta, the operator and its vector."""
    operator = transfer.make_operator(constants, beta, grid)
    vector = transfer.leading(operator, vector)
    quartic = float(np.sum(vector * vector * operator.quartic))
    return beta * (energy + quartic) - 0.5 * operator.freedom, operator, vector


def _refined(
    constants: Constants, beta: float, grid: Grid, energy: float
) -> tuple[float, transfer.Operator, np.ndarray]:
    """Return the beta without an excess, by secants in log beta, the operator and its vector."""
    old, (excess, operator, vector) = beta, _excess(constants, beta, grid, energy)
    beta *= 1.01
    for _ in range(SECANTS):
        before = excess
        excess, operator, vector = _excess(constants, beta, grid, energy, vector)
        if abs(excess) < 1e-8:
            return beta, operator, vector
        slope = (excess - before) / log(beta / old)
        old, beta = beta, beta * float(exp(np.clip(-excess / slope, -0.5, 0.5)))
    raise ArithmeticError(f"no beta with the energy {energy:g} was found in {SECANTS} secant steps")


def solve_thermal(epsilon: float, gamma: float, omegas: list[float], nodes: int) -> Contents:
    """Return the dataset of thermal states of zero energy at `omegas`: both fields, and A = -B.

    An Omega without one of the two states is omitted.
    """
    states = []
    for omega in omegas:
        constants = Constants(epsilon=epsilon, gamma=gamma, omega=omega)
        try:
            pair = [state_of_energy(constants, 0.0, nodes, alone) for alone in (False, True)]
        except NoThermalStateError as error:
            print(f"left out: {error}")
        else:
            states.append(pair)
    known = [both.operator.constants.omega for both, _ in states]
    variables, along = {"omega": Variable(("omega",), known, attributes=FEW_CHOICES)}, ("omega",)
    for number, prefix, power in (
        (0, "", f"{POWER} in the thermal state of zero energy"),
        (1, "antisymmetric_", f"{POWER} in the thermal state of zero energy with A = -B"),
    ):
        powers, errors = np.reshape([pair[number][1:3] for pair in states], (-1, 2)).T
        variables[f"{prefix}power"] = Variable(along, powers, power)
        long_name = f"change from a coarser and wider grid of the {power}"
        variables[f"{prefix}power_error"] = Variable(along, errors, long_name, attributes=SCATTERED)
    title = "Thermal states of the infinite chain, by its transfer operator"
    return variables, {
        "title": title,
        "epsilon": epsilon,
        "gamma": gamma,
        "nodes": 2 * nodes,
        **REGULAR,
    }
