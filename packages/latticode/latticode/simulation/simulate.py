"""The trajectory of a problem, by one method or by two of different families that agree."""

from collections.abc import Callable, Mapping, Sequence
from types import MappingProxyType
from typing import Any, NamedTuple

import numpy as np

from latticode.equations.graph import switches
from latticode.integrators import DONE, FAULTS, NOT_FINITE, STEP_TOO_SMALL, Outcome
from latticode.integrators.families import (
    FINEST,
    Agreement,
    compare,
    first_tolerance,
    instead_of_taylor,
    next_tolerance,
    pair_of,
    third_of,
)
from latticode.integrators.methods import NAMED

from .equations import Equations, GaveUpError, IntegrationError
from .feasibility import find_fault
from .interrupts import interruptible
from .lattice import Reduction, unfold
from .problem import Problem
from .progress import follow

SINGULAR = (
    ": a divisor, or the argument of a logarithm, a root or a power, is zero or negative at some"
    " site"
)
"""Likely reason why the rates are not finite at the start."""
JUMPS = "; a rate is discontinuous (sign or where): use larger tolerances, such as 1e-8"
"""Advice if a step across a discontinuity would become too short."""
NEEDS_NO_SERIES = "; try dop853, which needs no power series"
"""Advice if the solution may have no power series at some time, such as |u| at a zero of u."""


class Trajectory(NamedTuple):
    """The solution of a problem on the whole chain.

    Components are the fields of the model. Norms of real fields are norms of their values.
    """

    tau: np.ndarray  # (time,)
    linf: np.ndarray  # (component, time)
    l2: np.ndarray  # (component, time)
    modulus: np.ndarray  # (component, site, snapshot), empty without snapshots
    final: np.ndarray  # complex (component, site), or of real fields (part, component, site)
    outcome: Outcome
    solver: dict[str, Any]  # {"name": ..., **controls} of the run
    snapshot_tau: np.ndarray = np.empty(0)
    """The times of the snapshots, (snapshot,)."""
    state: np.ndarray | None = None
    """The parts of each field at the snapshots, (part, component, site, snapshot)."""
    conserved: Mapping[str, np.ndarray] = MappingProxyType({})
    """Conserved quantities of the model by name, each (time,)."""


def simulate(
    problem: Problem, reduction: Reduction | None = None, conserved: bool = True
) -> Trajectory:
    """Return the trajectory of a problem, with observables at its output times.

    `reduction` is the part of the chain that is integrated, by default the smallest that the exact
    symmetries allow. With `conserved` the conserved quantities are computed. The problem's solver
    is a method that integrates the model, or {"name": "auto", "error": ...}. If the default solver
    `taylor` stops early, `dop853` repeats the run. Raises IntegrationError if the run would take
    too long, the solver stops early, or the result is not finite.
    """
    if problem.snapshots_at:
        run = simulate(problem.changed(snapshots_at=()), reduction, conserved)
        return chosen_snapshots(run, problem)
    if problem.solver["name"] == "auto":
        return _simulate_to_error(problem, lambda run: _simulate_once(run, reduction, conserved))
    try:
        return _simulate_once(problem, reduction, conserved)
    except GaveUpError as error:
        if not problem.solver.get("by_default"):
            raise
        controls = {**instead_of_taylor(problem.solver), "instead_of_taylor": str(error)}
        try:
            return _simulate_once(problem.changed(solver=controls), reduction, conserved)
        except IntegrationError:
            raise error from None  # dop853 fails too: the series are not the cause


def _simulate_once(problem: Problem, reduction: Reduction | None, conserved: bool) -> Trajectory:
    equations = problem.equations
    cut = equations.find_reduction() if reduction is None else reduction
    record, y, outcome = integrate(equations, cut, conserved)
    both = Reduction(even=False, synchronised=cut.synchronised)
    return Trajectory(
        tau=problem.times,
        linf=unfold(record.linf, both),
        l2=unfold(record.l2, both),
        outcome=outcome,
        solver={key: value for key, value in problem.solver.items() if key != "by_default"},
        snapshot_tau=problem.times[problem.snapshot_outputs],
        **equations.collect(record, y, cut),
    )


def remark_on_start(problem: Problem) -> str:
    """Return a remark if a continued run is not bit-identical to one run from time 0, else ""."""
    exact = [name for name in problem.equations.methods if NAMED[name].continues_exactly]
    if not problem.start_time or problem.solver["name"] in exact:
        return ""
    alternative = f"; {exact[0]} would be bit-identical" if exact else ""
    return (
        f"the run starts at {problem.start_time:g}: it agrees with one run from 0 within the error"
        f" of {problem.solver['name']}, but is not bit-identical{alternative}"
    )


def integrate(
    equations: Equations, cut: Reduction, conserved: bool = True
) -> tuple[Any, np.ndarray, Outcome]:
    """Return observables, final state and outcome of a run of the part `cut` of the chain.

    Raises IntegrationError for the reasons given in `simulate`.
    """
    problem = equations.problem
    obstacle = find_obstacle(equations)
    if obstacle:
        raise _stopped(problem, 0.0, obstacle)
    name, methods = problem.solver["name"], equations.methods
    if name not in methods:
        known = ", ".join(methods)
        raise IntegrationError(f"{name} cannot integrate {problem.model.name}; use {known}")
    compiled = equations.compiled(name)
    y, times, system = equations.start(cut), equations.times, equations.system(cut)
    size = y.shape[0] // 2, y.shape[1] - 2, len(times)
    record = equations.record(*size, problem.snapshot_every, conserved)
    if problem.keep == "state" and record.snapshots.ndim == 3:
        record = record._replace(snapshots=np.empty((2, *record.snapshots.shape)))
    follow(record.linf[0], name)
    controls = compiled.controls_of(problem.solver, equations.atol_scale)
    work = compiled.work_for(system, y)
    outcome = interruptible(compiled.run_for(system, y), system, y, times, controls, work, record)
    if outcome.status != DONE:
        raise _gave_up(problem, equations.time_of_problem(outcome.time), outcome)
    must_be_finite = [record.linf, record.l2, y[:, 1:-1]]
    must_be_finite += [record.conserved] if equations.names.quantities else []
    for values in must_be_finite:
        if not np.isfinite(values).all():
            why = "the state, its norms or its conserved quantities overflow"
            raise _stopped(problem, problem.end_time, why)
    return record, y, outcome


def _gave_up(problem: Problem, time: float, outcome: Outcome) -> IntegrationError:
    """Return the error of a run that its solver stopped before the end."""
    at_start = outcome.status == NOT_FINITE and time == problem.start_time
    why = f"{FAULTS[outcome.status]}{SINGULAR * at_start}"
    if outcome.status == STEP_TOO_SMALL and switches(problem.model.rates):
        why += JUMPS
    stopped = _stopped(problem, time, why)
    if outcome.status not in (NOT_FINITE, STEP_TOO_SMALL):
        return stopped
    by_name = problem.solver["name"] == "taylor" and not problem.solver.get("by_default")
    return GaveUpError(f"{stopped}{NEEDS_NO_SERIES * by_name}")


def find_obstacle(equations: Equations) -> str | None:
    """Return why a problem cannot be integrated, or None if it can."""
    problem = equations.problem
    re_im = np.ascontiguousarray(problem.initial).view(float)  # real and imaginary parts
    peak = float(np.abs(re_im).max(initial=0.0))  # NaN if one is NaN
    numbers = {k: v for k, v in problem.parameters.items() if isinstance(v, int | float)}
    rates, span = equations.rates(peak), float(problem.span)
    obstacle = find_fault(numbers, rates, peak, span, problem.solver, equations.clock)
    return obstacle and obstacle[1]


def _stopped(problem: Problem, time: float, reason: str) -> IntegrationError:
    name, symbol = problem.solver["name"], problem.equations.names.time
    return IntegrationError(f"{name} stopped at {symbol} = {time:.6g}: {reason}")


# --- A run to a requested error -------------------------------------------------------------------

SNAPSHOTS = 20
"""Number of times, at least, at which fields are compared if the problem has no snapshots."""
MARGIN = 2.0
"""Assumed bound on the larger error of two methods, divided by their difference. Errors of methods
of different families hardly cancel."""
SELF_AGREEMENT = 0.1
"""A method has converged if a finer tolerance changes its result by less than this fraction of the
difference of two methods."""


def _simulate_to_error(problem: Problem, make: Callable[[Problem], Trajectory]) -> Trajectory:
    """Return the trajectory of a problem whose solver is {"name": "auto", "error": ...}.

    A tolerance does not bound the error at the end, least of all in chaotic motion. Two methods of
    different families therefore run the problem at finer and finer tolerances until their
    difference is within the error. If both converge, but to different results, one is wrong, and
    a third method decides which.

    `make` runs a problem by a named solver. The controls of the trajectory include its method, the
    requested and the estimated error, and the method that confirmed it. Raises IntegrationError if
    the methods do not agree within the error.
    """
    every = problem.snapshot_every or max(1, (len(problem.times) - 1) // SNAPSHOTS)
    runs = _ComparedRuns(problem.changed(snapshot_every=every), problem.solver["error"], make)
    methods = problem.equations.methods
    try:
        trajectory = runs.agreeing(methods)
    except GaveUpError:  # taylor stops if the solution has no power series at some time
        if "taylor" not in methods:
            raise
        trajectory = runs.agreeing([name for name in methods if name != "taylor"])
    return trajectory if problem.snapshot_every else without_snapshots(trajectory)


class _ComparedRuns(NamedTuple):
    """Runs of one problem by several methods, with snapshots at the same times."""

    problem: Problem
    error: float
    make: Callable[[Problem], Trajectory]

    @property
    def symbol(self) -> str:
        """The symbol of the time in messages."""
        return self.problem.equations.names.time

    def by(self, name: str, tolerance: float) -> Trajectory:
        """Return the trajectory by a method at a tolerance."""
        solver = {"name": name, "rtol": tolerance, "atol": tolerance}
        return self.make(self.problem.changed(solver=solver))

    def compared(self, first: Trajectory, second: Trajectory) -> Agreement:
        """Return the differences of two trajectories."""
        return compare(first, second)

    def agreeing(self, methods: Sequence[str]) -> Trajectory:
        """Return a run that agrees within the error with a run by a method of another family."""
        names = pair_of(methods)
        tolerance, before = first_tolerance(self.error, angle_of(self.problem)), None
        while True:
            pair = tuple(self.by(name, tolerance) for name in names)
            between = self.compared(*pair)
            if MARGIN * between.largest <= self.error:
                return self.accepted(*pair)
            if before:
                moved = max(self.compared(*same).largest for same in zip(before, pair, strict=True))
                if moved < SELF_AGREEMENT * between.largest:
                    return self.supported(pair, between, third_of(names, methods))
            if tolerance <= FINEST:
                break
            before, tolerance = pair, next_tolerance(tolerance, self.error / between.largest)
        lost = between.first_above(self.error / MARGIN)
        raise IntegrationError(
            f"auto: runs in double precision agree to {self.error:g} only before"
            f" {self.symbol} = {lost:g}; reduce the end time or allow a larger error"
        )

    def accepted(self, first: Trajectory, second: Trajectory, **more: str) -> Trajectory:
        """Return the first of two trajectories, with the estimated error among its controls."""
        estimate = MARGIN * self.compared(first, second).largest
        errors = {"requested_error": self.error, "estimated_error": estimate}
        solver = {**first.solver, **errors, "agrees_with": second.solver["name"], **more}
        return first._replace(solver=solver)

    def supported(
        self, pair: tuple[Trajectory, ...], between: Agreement, third: str | None
    ) -> Trajectory:
        """Return whichever trajectory of a pair agrees with a run by a third method.

        Raises IntegrationError if neither does.
        """
        names = [trajectory.solver["name"] for trajectory in pair]
        differ = f"{names[0]} and {names[1]} differ by {between.largest:.1e} at any tolerance"
        if third:
            tolerance = first_tolerance(0.1 * self.error, angle_of(self.problem))
            judge = self.by(third, tolerance)
            for trajectory in reversed(pair):
                if MARGIN * self.compared(trajectory, judge).largest <= self.error:
                    decision = f"{differ}; {third} agrees with {trajectory.solver['name']}"
                    return self.accepted(trajectory, judge, disagreement=decision)
        undecided = f"{third} agrees with neither" if third else "there is no third method"
        since = between.first_above(self.error / MARGIN)
        raise IntegrationError(
            f"auto: {differ}, from {self.symbol} = {since:g} on, and {undecided};"
            " allow a larger error, or run both methods and compare"
        )


def angle_of(problem: Problem) -> float:
    """Return a bound of the phase advance of the fields during a run, in radians."""
    peak = float(np.abs(np.ascontiguousarray(problem.initial).view(float)).max(initial=0.0))
    return sum(problem.equations.rates(peak).values()) * problem.span


def without_snapshots(run: Trajectory) -> Trajectory:
    """Return a run without its snapshots."""
    return _at_snapshots(run, np.arange(0))


def chosen_snapshots(run: Trajectory, problem: Problem) -> Trajectory:
    """Return a run with only the snapshots that the problem requests."""
    numbers = problem.snapshot_outputs
    return _at_snapshots(run, numbers // problem.snapshot_every)


def _at_snapshots(run: Trajectory, numbers: np.ndarray) -> Trajectory:
    """Return a run with only the snapshots of these numbers, counted from 0."""
    return run._replace(
        modulus=run.modulus[..., numbers],
        state=None if run.state is None else run.state[..., numbers],
        snapshot_tau=run.snapshot_tau[numbers],
    )
