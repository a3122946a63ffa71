"""A case: every key with its default, and which values fit each other.

A default is the value of the paper's cases, save for `solver` and `snapshot_step`.
"""

from collections.abc import Iterator, Mapping
from math import inf, sqrt
from typing import Annotated, Any, Literal

from latticode.simulation.feasibility import MOST_STEPS, Obstacle
from pydantic import BeforeValidator, Field, model_validator

from pendula.feasibility import find_fault, rate
from pendula.problem import AMPLITUDES, PENDULA, Constants

from . import cost
from .solvers import OF_AMPLITUDES, OF_PENDULA, Solver, Taylor
from .values import Complex, Model, Natural, Number, Positive, Whole, as_whole, fault, faults, shown

FEWEST = 200
"""A smooth picture needs so many snapshots."""
MOST_NUMBERS = 20_000_000
"""At most so many moduli are kept in memory: very long chains have fewer snapshots."""
MOST_COUNTED = 1e15
"""Of more steps no digit tells whether they divide a time; such runs are refused by their cost."""


def choose_every(outputs: int, sites: int) -> int:
    """Return how many output steps lie between snapshots, for a run of `outputs` steps.

    They divide the run, so that its last state is among the snapshots.
    """
    most = max(1, MOST_NUMBERS // (2 * sites))
    whole = [every for every in range(1, outputs // FEWEST + 1) if outputs % every == 0]
    every = whole[-1] if whole else 1
    while outputs // every > most or outputs % every:
        every += 1
    return every


def is_multiple(time: float, step: float) -> bool:
    """Return whether a time is a whole number of steps, one at least."""
    if time / step >= MOST_COUNTED:
        return True
    count = round(time / step)
    return count >= 1 and abs(time - count * step) <= 1e-9 * time


def _nearest_multiples(time: float, step: float) -> str:
    count = int(time / step)
    near = [f"{max(count, 1) * step:.12g}", f"{(max(count, 1) + 1) * step:.12g}"]
    return f"the nearest are {near[0]} and {near[1]}" if count else f"the shortest is {near[0]}"


def _nearest_parts(whole: float, part: float) -> str:
    """Return in words the steps next to `part` that divide `whole`."""
    count = min(whole / part, MOST_COUNTED)
    near = [whole / max(1, int(count) + more) for more in (0, 1)]
    shortest = f"the longest that does is {whole:.12g}"
    return shortest if count < 1 else f"the nearest that do are {near[1]:.12g} and {near[0]:.12g}"


def _nearest_snapshots(outputs: int, every: int, step: float) -> str:
    """Return in words the snapshot steps next to `every` outputs that divide the run."""
    below = next(n for n in range(every, 0, -1) if outputs % n == 0)
    above = next(n for n in range(every, outputs + 1) if outputs % n == 0)
    return f"the nearest that do are {below * step:.12g} and {above * step:.12g}"


def sites_of(given: Any, most: int | None = 2) -> Any:
    """Return initial data by the number of their site; refuse a site that stands twice.

    A site has at most so many values.
    """
    if not isinstance(given, Mapping):
        raise fault(f"is {shown(given)}, not data by site such as {{0: [1, 0.1]}}")
    found: dict = {}
    for key, pair in given.items():
        site = as_whole(key)
        if site in found and len(found) < len(given):
            raise fault(f"the site {site} stands twice, as a number and as a word")
        if isinstance(pair, list | tuple) and most and len(pair) > most:
            raise fault(f"site {site} has {len(pair)} values; give two, A and B")
        if not isinstance(pair, list | tuple):
            raise fault(f"site {site} has {shown(pair)}; give two values, [A, B]")
        found[site] = pair
    return found


Initial = Annotated[
    dict[Whole, tuple[Complex, Complex]], BeforeValidator(sites_of), Field(min_length=1)
]


class Case(Model):
    """One initial-value problem, and the solver that integrates it.

    The equations are (4) of the amplitudes, or with `model: pendula` Newton's equations (1), which
    need `mu` and start from the angles and velocities that (3) makes of the amplitudes.
    """

    omega: Number
    epsilon: Number = 1.0
    gamma: Number = 1.0
    half_width: Natural = 30
    boundary: Literal["dirichlet", "free", "periodic"] = "dirichlet"
    initial: Initial = {0: (1, 0.1)}
    end_time: Positive = 50.0
    output_step: Positive = 0.025
    snapshot_step: Positive | None = None
    solver: Solver = Taylor()
    model: Literal["amplitudes", "pendula"] = AMPLITUDES
    mu: Positive | None = None

    @model_validator(mode="after")
    def _consistent(self) -> "Case":
        found = [*self._faults_of_model(), *self._faults_of_times()]
        found += [*self.faults_of_solver(self.solver)] or [*self.faults_of_step(self.solver)]
        outside = [site for site in self.initial if abs(site) > self.half_width]
        if outside:
            m = self.half_width
            text = f"site {outside[0]} lies outside the chain, whose sites run from -{m} to {m}"
            found.append(("initial", text))
        if not any(key.startswith(("mu", "solver.name", "parameters")) for key, _ in found):
            found += self.obstacles()
        if found:
            raise faults(found)
        return self

    def _faults_of_model(self) -> Iterator[tuple[str, str]]:
        mu = self.mu
        if self.model == AMPLITUDES and mu is not None:
            yield "mu", "has a meaning for the pendula only; add model: pendula, or leave it out"
        if self.model == PENDULA and mu is None:
            yield "mu", "is missing: Newton's equations need it, for example 0.1"
        if self.model == PENDULA and mu is not None and not 1.0 + mu * mu * self.omega > 0.0:
            largest = 1.0 / sqrt(-self.omega)
            text = "the square of the pendula's frequency, 1 + mu^2 Omega, is not positive"
            yield "mu", f"{text}; with omega {self.omega:g} it must be less than {largest:.4g}"

    def faults_of_solver(self, solver: Any) -> Iterator[tuple[str, str]]:
        """Yield the fault of a solver that does not take the equations of the case."""
        known, what = OF_AMPLITUDES, "does not take the amplitude equations"
        if self.model == PENDULA:
            known, what = OF_PENDULA, "does not take Newton's equations"
        if solver.name not in known:
            yield "solver.name", f"{solver.name} {what}; give one of {', '.join(known)}"

    def _faults_of_times(self) -> Iterator[tuple[str, str]]:
        step, off_grid = self.output_step, []
        for key in ("end_time", "snapshot_step"):
            time = getattr(self, key)
            if time is not None and not is_multiple(time, step):
                off_grid.append(key)
                near = _nearest_multiples(time, step)
                yield key, f"{time:g} is not a whole number of output steps of {step:g}; {near}"
        if self.snapshot_step is None or off_grid:
            return
        if self.snapshot_step > self.end_time:
            yield "snapshot_step", "is longer than the run"
        elif not is_multiple(self.end_time, self.snapshot_step):
            outputs, every = round(self.end_time / step), round(self.snapshot_step / step)
            text = f"{self.snapshot_step:g} does not divide the run of {self.end_time:g}"
            near = _nearest_snapshots(outputs, every, step) if outputs < 1e7 else ""
            yield "snapshot_step", f"{text}, whose last picture would be lost; {near}".strip("; ")

    def faults_of_step(self, solver: Any) -> Iterator[tuple[str, str]]:
        """Yield the fault of a step that does not divide the time between two outputs."""
        step = getattr(solver, "step", None)
        if solver.name == "kahan_li":  # its steps fit themselves between two outputs
            return
        if step is not None and not is_multiple(self.output_step, step):
            near = _nearest_parts(self.output_step, step)
            text = f"{step:g} does not divide the output step of {self.output_step:g}"
            yield "solver.step", f"{text}; {near}"

    def obstacles(self, solver: Model | None = None, span: float = 0.0) -> list[tuple[str, str]]:
        """Return the key that keeps a run from reaching its end with its digits, and why.

        `solver` and `span` take the place of the case's own solver and end time.
        """
        given, span = (solver or self.solver).model_dump(), span or self.end_time
        if given["name"] == "auto":  # its first run, which asks for least
            tolerance = cost.auto_tolerances(given["error"])[0]
            given = {"name": "taylor", "rtol": tolerance, "atol": tolerance}
        amplitudes = [z for pair in self.initial.values() for z in pair]
        peak = max(max(abs(z.real), abs(z.imag)) for z in amplitudes)
        found, speed = self._fault_and_rate(peak, span, given)
        angle = speed * span
        took = cost.estimate(self.problem(solver=given, end_time=span, snapshot_step=None))
        if found is not None and cost.HOUR < took.seconds < inf:
            found = found[0], f"{found[1]}, and would take {took}"
        if found is not None and MOST_STEPS < angle < inf:
            longest = 0.99 * MOST_STEPS / speed  # which three digits never round up beyond it
            found = found[0], f"{found[1]}; end_time may be at most {longest:.3g} here"
        if found is None and 0.0 < angle < SMALLEST_ANGLE:
            text = f"is so short that the data turn by {angle:.0e} radians: nothing would be seen"
            found = "end_time", f"{span:g} {text}"
        return [found] if found else []

    def _fault_and_rate(
        self, peak: float, span: float, solver: dict
    ) -> tuple[Obstacle | None, float]:
        """Return what keeps data of the size `peak` from being followed, and how fast they turn."""
        constants = Constants(epsilon=self.epsilon, gamma=self.gamma, omega=self.omega)
        found = find_fault(constants, peak, span, solver, self.mu)
        return found, rate(constants, peak, self.mu)

    def problem(self, **changes) -> dict:
        """Return the case as plain values of a Problem, some of them changed."""
        values = {**self.model_dump(), **changes}
        if values["model"] == AMPLITUDES:
            del values["model"], values["mu"]
        snapshots = values.pop("snapshot_step")
        every = round(snapshots / values["output_step"]) if snapshots else 0
        return {**values, "snapshot_every": every}

    def shown_problem(self, **changes) -> dict:
        """Return the problem, with snapshots enough for a picture if the case names no number."""
        problem = self.problem(**changes)
        every = problem["snapshot_every"] or choose_every(
            round(problem["end_time"] / problem["output_step"]), 2 * problem["half_width"] + 1
        )
        return {**problem, "snapshot_every": every}


SMALLEST_ANGLE = 1e-9
"""Radians by which a run must turn its data: of less, rounding is most of what is seen."""
