"""When a run leaves the solution: predicted from the growth of small changes, and measured."""

from typing import NamedTuple

import numpy as np

from pendula.measures.difference import VISIBLE, first_above, norm_difference
from pendula.problem import Problem
from pendula.simulation.simulate import Trajectory, simulate

ROUNDING = 2.0**-53
"""Relative error of one rounded operation in double precision."""
FINEST = 1e-15
EARLY = 2.0
"""Time at which the errors that a run makes are read off, before chaos has grown them far."""


def amplification(tau: np.ndarray, stretch: np.ndarray, size: np.ndarray) -> np.ndarray:
    """Return log of the relative error at each tau, per relative error made in a unit of tau.

    Errors are made all along, each in proportion to the `size` of the solution at its time s, and
    grown by exp(stretch(tau) - stretch(s)). All arguments are (time,), as is the result.
    """
    made = np.log(size[1:] * np.diff(tau)) - stretch[1:]
    total = np.logaddexp.accumulate(made) + stretch[1:] - np.log(size[1:])
    return np.concatenate([[-np.inf], total])


def predict(tau: np.ndarray, log_amplification: np.ndarray, error: float) -> float:
    """Return the first tau at which `error` a unit of tau has grown to VISIBLE; inf if at none."""
    return first_above(tau, log_amplification, np.log(VISIBLE / error))


class Parting(NamedTuple):
    """How runs at several tolerances differ from a finer one; all are (tolerance,)."""

    time: np.ndarray  # divergence time, inf where there is none
    steps: np.ndarray  # of the solver per unit of tau
    early: np.ndarray  # difference at tau = EARLY


def measure(problem: Problem, tolerances: list[float]) -> Parting:
    """Follow a case by dop853 at each tolerance and at FINEST."""
    finest = _run(problem, FINEST)
    first = early_index(finest.tau)
    rows = []
    for tolerance in tolerances:
        run = _run(problem, tolerance)
        difference = norm_difference(run.linf, run.l2, finest.linf, finest.l2)
        steps = (run.outcome.steps + run.outcome.rejected) / run.tau[-1]
        rows.append((first_above(run.tau, difference, VISIBLE), steps, difference[first]))
    return Parting(*np.array(rows).T)


def early_index(tau: np.ndarray) -> int:
    """Return where EARLY is among increasing times."""
    return int(np.argmin(np.abs(tau - EARLY)))


def _run(problem: Problem, tolerance: float) -> Trajectory:
    solver = {"name": "dop853", "rtol": tolerance, "atol": tolerance}
    return simulate(problem.changed(solver=solver, snapshot_every=0))
