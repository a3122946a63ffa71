"""From a problem to its trajectory: by one run, or by runs at ever finer tolerance."""

from collections.abc import Mapping
from types import MappingProxyType
from typing import Any, NamedTuple

import numpy as np

from latticode.integrators import DONE, FAULTS, NOT_FINITE, Outcome
from latticode.measures.difference import norm_difference

from .feasibility import find_fault
from .integration import Integration
from .interrupts import interruptible
from .lattice import Reduction, unfold
from .problem import Problem
from .systems import integration_of

FINEST, REFINEMENT = 1e-15, 1e-2
"""The tightest tolerance that `auto` tries, and the factor from each tolerance to the next."""


SINGULAR = (
    ": a divisor, or the argument of a logarithm, a root or a power, is zero or negative at some"
    " site"
)
"""Why a state that was finite at the start is so no longer."""


class IntegrationError(RuntimeError):
    """A run that could not reach its end time with the digits that were asked for."""


class Trajectory(NamedTuple):
    """The solution of a problem, whatever part of it was integrated; the sites are -M..M.

    Components are the fields of the model. The norms of real fields are those of their values.
    """

    tau: np.ndarray  # (time,)
    linf: np.ndarray  # (component, time)
    l2: np.ndarray  # (component, time)
    energy: np.ndarray  # (time,), empty where the equations conserve none, or if not asked for
    modulus: np.ndarray  # (component, site, snapshot), empty unless asked for
    final: np.ndarray  # at the end time: complex (component, site); real fields as snapshots are
    outcome: Outcome
    solver: dict[str, Any]  # {"name": ..., **controls} of the run
    snapshots: np.ndarray | None = None
    """Both parts of each field, (part, component, site, snapshot)."""
    conserved: Mapping[str, np.ndarray] = MappingProxyType({})
    """What the model conserves, each (time,)."""


def simulate(
    problem: Problem, reduction: Reduction | None = None, energy: bool = True
) -> Trajectory:
    """Integrate a problem and reduce it to observables at its output times.

    `reduction` says how much of the chain is integrated; by default it is the least that the exact
    symmetries of the data allow. Without `energy` the trajectory has none. The solver is one of
    those that take the model, or {"name": "auto", "error": ...}. Raises IntegrationError where the
    run would not end, the solver gives up, or the result is not finite.
    """
    if problem.solver["name"] == "auto":
        return _simulate_to_error(problem, reduction)
    if reduction is None:
        reduction = integration_of(problem).find_reduction(problem)
    times, record, y, outcome = integrate(problem, reduction, energy)
    both = Reduction(even=False, synchronised=reduction.synchronised)
    return Trajectory(
        tau=times,
        linf=unfold(record.linf, both),
        l2=unfold(record.l2, both),
        outcome=outcome,
        solver=dict(problem.solver),
        **integration_of(problem).collect(problem, record, y, reduction),
    )


def integrate(
    problem: Problem, reduction: Reduction, energy: bool = True
) -> tuple[np.ndarray, Any, np.ndarray, Outcome]:
    """Return times, observables of the part that `reduction` leaves, its final state, the outcome.

    Raises IntegrationError as `simulate` does.
    """
    model = integration_of(problem)
    obstacle = find_obstacle(problem, model)
    if obstacle:
        raise _stopped(problem, 0.0, obstacle)
    name = problem.solver["name"]
    if name not in model.solvers:
        known = ", ".join(model.solvers)
        raise IntegrationError(f"{name} does not take {problem.model.name}: these do: {known}")
    method = model.solvers[name]
    y = model.start(problem, reduction)
    times = model.times(problem)
    size = y.shape[0] // 2, y.shape[1] - 2, len(times)
    record = model.record(*size, problem.snapshot_every, energy)
    scales = {"atol": model.atol(problem)}
    controls = tuple(
        float(problem.solver[name]) * scales.get(name, 1.0) for name in method.controls
    )
    system = model.system(problem, reduction)
    work = method.room_for(system, y)
    outcome = interruptible(method.run, system, y, times, controls, work, record)
    if outcome.status != DONE:
        at_start = outcome.status == NOT_FINITE and outcome.time == 0.0
        why = f"{FAULTS[outcome.status]}{SINGULAR * at_start}"
        raise _stopped(problem, model.slow(problem, outcome.time), why)
    for values in (record.linf, record.l2, record.energy, y[:, 1:-1]):
        if not np.isfinite(values).all():
            raise _stopped(problem, problem.end_time, "the state, its norms or its energy overflow")
    return problem.times, record, y, outcome


def find_obstacle(problem: Problem, model: Integration) -> str | None:
    """Return why a problem cannot be integrated, or None if it can."""
    parts = np.ascontiguousarray(problem.initial).view(float)  # real and imaginary ones
    peak = float(np.abs(parts).max(initial=0.0))  # NaN where there is one
    numbers = {k: one for k, one in problem.parameters.items() if isinstance(one, int | float)}
    rates, span = model.rates(problem, peak), float(problem.end_time)
    found = find_fault(numbers, rates, peak, span, problem.solver, model.clock(problem))
    return found and found[1]


def _stopped(problem: Problem, time: float, reason: str) -> IntegrationError:
    return IntegrationError(f"{problem.solver['name']} stopped at tau = {time:.6g}: {reason}")


def _simulate_to_error(problem: Problem, reduction: Reduction | None) -> Trajectory:
    """Return the first run that agrees with the one before it as closely as was asked for.

    No tolerance promises an error, least of all where the motion is chaotic. So the run is
    repeated at a hundredth of the tolerance until two in a row agree; the finer of them is
    returned, and its controls say which error was asked for and which was estimated. The solver is
    `taylor`, the fastest on the paper's chains at small errors (see docs/accuracy_and_speed.md).
    """
    error = problem.solver["error"]
    tolerance = min(error, 1e-4)
    coarse = simulate(problem.changed(solver=_taylor(tolerance)), reduction)
    while tolerance > FINEST:
        tolerance = max(REFINEMENT * tolerance, FINEST)
        fine = simulate(problem.changed(solver=_taylor(tolerance)), reduction)
        differences = norm_difference(coarse.linf, coarse.l2, fine.linf, fine.l2)
        if differences.max() <= error:
            estimate = float(differences.max())
            asked = {"requested_error": error, "estimated_error": estimate}
            return fine._replace(solver={**fine.solver, **asked})
        coarse = fine
    lost = fine.tau[np.argmax(differences > error)]
    raise IntegrationError(
        f"auto: runs in double precision agree to {error:g} only before tau = {lost:g}: "
        "end the run earlier, or ask for a larger error"
    )


def _taylor(tolerance: float) -> dict[str, Any]:
    return {"name": "taylor", "rtol": tolerance, "atol": tolerance}
