"""When a run parts from the truth: predicted from the growth of small changes, and measured."""

from typing import NamedTuple

import numpy as np

from pendula.problem import Problem
from pendula.simulation.simulate import Trajectory, simulate

PARTED = 0.01
"""Relative difference at which two runs count as parted."""
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
    """Return the first tau at which `error` a unit of tau has grown to PARTED; NaN if at none."""
    return first_above(tau, log_amplification, np.log(PARTED / error))


def first_above(tau: np.ndarray, values: np.ndarray, limit: float) -> float:
    """Return the first tau at which `values` reach `limit`, NaN where they never do."""
    above = np.flatnonzero(values >= limit)
    return float(tau[above[0]]) if above.size else np.nan


class Parting(NamedTuple):
    """How runs at several tolerances part from a finer one; all are (tolerance,)."""

    time: np.ndarray  # tau at which they part, NaN where they never do
    steps: np.ndarray  # of the solver per unit of tau
    early: np.ndarray  # relative difference at tau = EARLY


def measure(problem: Problem, tolerances: list[float]) -> Parting:
    """Follow a case by dop853 at each tolerance and at FINEST.

    Compared are the moduli on all sites, in l2.
    """
    finest = _run(problem, FINEST)
    first = early_index(finest.tau)
    rows = []
    for tolerance in tolerances:
        run = _run(problem, tolerance)
        difference = _l2(run.modulus - finest.modulus) / _l2(finest.modulus)
        steps = (run.outcome.steps + run.outcome.rejected) / run.tau[-1]
        rows.append((first_above(run.tau, difference, PARTED), steps, difference[first]))
    return Parting(*np.array(rows).T)


def early_index(tau: np.ndarray) -> int:
    """Return where EARLY is among increasing times."""
    return int(np.argmin(np.abs(tau - EARLY)))


def _run(problem: Problem, tolerance: float) -> Trajectory:
    solver = {"name": "dop853", "rtol": tolerance, "atol": tolerance}
    return simulate(problem.changed(solver=solver, snapshot_every=1))


def _l2(modulus: np.ndarray) -> np.ndarray:
    return np.sqrt(np.sum(modulus**2, axis=(0, 1)))
