"""Runs of the pendula, and the amplitudes behind them.

By (3) the angle of a pendulum is 2 mu Re(A e^{i omega t}) to leading order, and its velocity
-2 mu omega Im(A e^{i omega t}). So the envelope |A| follows from angle and velocity at one time, up
to what (3) leaves out, of the order mu^2. The angle alone, over 2 mu, only swings below it, and one
would have to search a whole period for its maximum. A pendulum that has gone over the top has no
amplitude: its envelope then only shows how far it has turned, from a size of pi / (2 mu) on.
"""

import numpy as np
from latticode.integrators import DONE, FAULTS
from latticode.simulation.interrupts import interruptible
from latticode.simulation.lattice import Reduction, find_reduction
from latticode.simulation.simulate import IntegrationError, simulate
from latticode.simulation.systems import integration_of

from pendula.models.pendula import amplitudes_of, frequency
from pendula.problem import PENDULA, Problem

from .mathieu import strings_grow

LIMIT = 0.0
"""The mu that stands for the amplitude equations: they are the limit of the pendula."""
LOST = 16.0 * np.pi
"""An angle in rad, of eight turns: no expansion about the pendula at rest follows it."""
NOT_KNOWN = "NaN is not known: the drive makes pendula over the top ever faster"
PIECE = 168
"""Times between two looks at the angles."""


def at_mu(problem: Problem, mu: float) -> Problem:
    """Return a problem of (4) as one of pendula; for mu = 0 as it is."""
    return problem if mu == LIMIT else problem.changed(model=PENDULA, mu=float(mu))


def period_of(problem: Problem) -> float:
    """Return the period 2 pi / omega of the pendula in units of tau."""
    mu = problem.mu
    return np.pi * mu * mu / frequency(problem.constants.omega, mu)


def angles_at(
    problem: Problem, times: np.ndarray, reduction: Reduction, piece: int = PIECE
) -> np.ndarray:
    """Return the angles (time, component, site) of what `reduction` leaves, at the times t.

    `problem` is one of the pendula, and `times` begin with 0. Pendula that have gone over the top
    may be driven faster and faster, which takes ever more steps. So the run ends where an angle is
    beyond LOST at one of every `piece` times, and all angles are infinite from then on.
    """
    model = integration_of(problem)
    method, y = model.solvers[problem.solver["name"]], model.start(problem, reduction)
    system = model.system(problem, reduction)
    rtol, atol = (float(problem.solver[name]) for name in method.controls)
    controls, work = (rtol, atol * model.atol(problem)), method.room_for(system, y)
    angles = np.full((times.size, y.shape[0] // 2, y.shape[1] - 2), np.inf)

    def follow(stop: np.ndarray) -> None:
        for first in range(0, times.size - 1, piece):
            part = times[first : first + piece + 1]
            record = model.record(*angles.shape[1:], part.size, 1)
            outcome = method.run(system, y, part, controls, work, record, stop)
            if outcome.status != DONE:
                raise IntegrationError(f"the pendula stopped: {FAULTS[outcome.status]}")
            angles[first : first + part.size] = np.moveaxis(record.kept[0], -1, 0)
            if np.abs(y[::2]).max() > LOST:
                return

    interruptible(follow)
    return angles


def until_lost(problem: Problem) -> Problem:
    """Return a problem of the pendula, ended where one of them is LOST to a drive without bounds.

    Where the drive makes the strings grow, pendula over the top turn exponentially faster, and the
    number of steps grows alike: in ten units of tau it may become 1e10. The problem has several
    outputs in a period.
    """
    if not strings_grow(problem.constants, problem.mu):
        return problem
    times = integration_of(problem).times(problem)
    angles = angles_at(problem, times, find_reduction(problem.amplitudes), piece=1)
    known = np.isfinite(angles[:, 0, 0]).sum() - 1
    return problem.changed(end_time=float(problem.times[known]))


def states(problem: Problem) -> tuple[np.ndarray, np.ndarray]:
    """Return the output times and A_n, B_n, complex (component, site, time).

    Those of pendula turn with omega t, all alike: no modulus depends on it.
    """
    if problem.model.name == PENDULA:
        run = simulate(problem.changed(snapshot_every=1))
        return run.tau, amplitudes_of(*run.snapshots, problem.constants.omega, problem.mu)
    # a run of (4) keeps moduli alone, so it is made in pieces: each starts from the state before
    found, piece = [problem.amplitudes], problem.changed(end_time=problem.output_step)
    for _ in problem.times[1:]:
        found.append(simulate(piece.changed(initial=found[-1])).final)
    return problem.times, np.stack(found, axis=-1)
