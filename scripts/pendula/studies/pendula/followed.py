"""Runs of the pendula, and of the amplitudes behind an expansion, at times of the study's own."""

import numpy as np

from pendula.compiled import kernel
from pendula.integrators import DONE, FAULTS, dop853
from pendula.models import expansion
from pendula.numerics.elementary import complex_of
from pendula.problem import Problem
from pendula.simulation.interrupts import interruptible
from pendula.simulation.lattice import Reduction, aligned, pack
from pendula.simulation.models import MODELS, make_chain
from pendula.simulation.simulate import IntegrationError

TOLERANCE = 1e-12
"""Of the amplitudes, relative and absolute: far below what the expansion leaves at any mu."""
LOST = 16.0 * np.pi
"""An angle in rad, of eight turns: no expansion about the pendula at rest follows it."""
PIECE = 48
"""Times between two looks at the angles."""


@kernel
def keep_state(system, y, i, states):
    """Write the state `y` without its ghosts into states[i]."""
    for row in range(y.shape[0]):
        for j in range(1, y.shape[1] - 1):
            states[i, row, j - 1] = y[row, j]


solve = dop853.build(expansion.rates, keep_state)


@kernel
def run(system, y, times, controls, work, states, stop):
    return solve(system, y, times, controls, work, states, stop)


def amplitudes_at(
    problem: Problem, squared_mu: float, taus: np.ndarray, reduction: Reduction
) -> np.ndarray:
    """Return the amplitudes (time, component, site) of what `reduction` leaves of the chain.

    They move by F + `squared_mu` G (see pendula.models.expansion), from the data that have the
    angles and velocities of the problem's data to that order. `taus` begin with 0.
    """
    chain = make_chain(problem.constants, problem.boundary, reduction)
    y = expansion.corrected_start(chain, squared_mu, pack(problem.amplitudes, reduction))
    system = expansion.Expansion(chain, squared_mu, np.zeros_like(y), np.zeros_like(y))
    states = np.empty((taus.size, y.shape[0], y.shape[1] - 2))
    controls, work = (TOLERANCE, TOLERANCE), aligned((dop853.WORK, *y.shape))
    outcome = interruptible(run, system, y, taus, controls, work, states)
    if outcome.status != DONE:
        fault = FAULTS[outcome.status]
        raise IntegrationError(f"the amplitudes stopped at tau = {outcome.time:.6g}: {fault}")
    return complex_of(states[:, 0::2], states[:, 1::2])


def angles_at(problem: Problem, times: np.ndarray, reduction: Reduction) -> np.ndarray:
    """Return the angles (time, component, site) of what `reduction` leaves, at the times t.

    `problem` is one of the pendula, and `times` begin with 0. Pendula that have gone over the top
    may be driven faster and faster, which takes ever more steps. So the run ends where an angle is
    beyond LOST, and all angles are infinite from then on.
    """
    model = MODELS[problem.model]
    method, y = model.solvers[problem.solver["name"]], model.start(problem, reduction)
    system = model.system(problem, reduction)
    rtol, atol = (float(problem.solver[name]) for name in method.controls)
    controls, work = (rtol, atol * model.atol(problem)), method.room_for(system, y)
    angles = np.full((times.size, y.shape[0] // 2, y.shape[1] - 2), np.inf)

    def follow(stop: np.ndarray) -> None:
        for first in range(0, times.size - 1, PIECE):
            part = times[first : first + PIECE + 1]
            record = model.record(*angles.shape[1:], part.size, 1)
            outcome = method.run(system, y, part, controls, work, record, stop)
            if outcome.status != DONE:
                raise IntegrationError(f"the pendula stopped: {FAULTS[outcome.status]}")
            angles[first : first + part.size] = np.moveaxis(record.snapshots[0], -1, 0)
            if np.abs(y[::2]).max() > LOST:
                return

    interruptible(follow)
    return angles
