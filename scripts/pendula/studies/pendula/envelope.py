"""Amplitudes got back from pendula, so that their norms can be compared with those of (4).

By (3) the angle of a pendulum is 2 mu Re(A e^{i omega t}) to leading order, and its velocity
-2 mu omega Im(A e^{i omega t}). So the envelope |A| follows from angle and velocity at one time, up
to what (3) leaves out, of the order mu^2. The angle alone, over 2 mu, only swings below it, and one
would have to search a whole period for its maximum. A pendulum that has gone over the top has no
amplitude: its envelope then only says how far it has turned, from a size of pi / (2 mu) on.
"""

import numpy as np

from pendula.models.pendula import amplitudes_of
from pendula.numerics.elementary import modulus
from pendula.problem import AMPLITUDES, PENDULA, Problem
from pendula.simulation.simulate import Trajectory, simulate

from .followed import until_lost

LIMIT = 0.0
"""The mu that stands for the amplitude equations: they are the limit of the pendula."""


def at_mu(problem: Problem, mu: float) -> Problem:
    """Return a problem of (4) as one of pendula; for mu = 0 as it is."""
    return problem if mu == LIMIT else problem.changed(model=PENDULA, mu=float(mu))


def envelopes(problem: Problem) -> tuple[Trajectory, np.ndarray]:
    """Return the run of a problem of (4) or of pendula, and |A_n|, |B_n|.

    The moduli are (component, site, time), NaN after the time at which a pendulum is lost.
    """
    if problem.model == AMPLITUDES:
        run = simulate(problem.changed(snapshot_every=1))
        return run, run.modulus
    run = simulate(until_lost(problem.changed(snapshot_every=1)))
    moduli = modulus(amplitudes_of(*run.snapshots, problem.constants.omega, problem.mu))
    found = np.full((*moduli.shape[:2], problem.times.size), np.nan)
    known = np.searchsorted(problem.times, run.tau[-1], side="right")
    found[..., :known] = moduli[..., :known]
    return run, found


def states(problem: Problem) -> tuple[np.ndarray, np.ndarray]:
    """Return the output times and A_n, B_n, complex (component, site, time).

    Those of pendula turn with omega t, all alike: no modulus depends on it.
    """
    if problem.model == PENDULA:
        run = simulate(problem.changed(snapshot_every=1))
        return run.tau, amplitudes_of(*run.snapshots, problem.constants.omega, problem.mu)
    # a run of (4) keeps moduli alone, so it is made in pieces: each starts from the state before
    found, piece = [problem.amplitudes], problem.changed(end_time=problem.output_step)
    for _ in problem.times[1:]:
        found.append(simulate(piece.changed(initial=found[-1])).final)
    return problem.times, np.stack(found, axis=-1)


def norms_of(moduli: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return l2 and l-infinity over the sites of moduli (component, site, time)."""
    return np.sqrt((moduli * moduli).sum(axis=1)), moduli.max(axis=1)
