"""Runs on an infinite chain that integrate only the active sites: -W..W, or 0..W for even data.

W grows by a block when a site near an end exceeds `rest_threshold` times the largest amplitude. For
short runs 1e-20 is small enough. A pulled front is driven by its leading edge and slows down if the
edge is cut off (Brunet and Derrida, Phys. Rev. E 56 (1997) 2597). Long runs therefore use 1e-150,
about the smallest number whose square is a normal double.

A run is divided into time intervals. Sites are added only between them.
"""

from collections.abc import Iterator
from typing import Any, NamedTuple

import numpy as np

from latticode.equations.initial_values import place
from latticode.integrators import DONE, FAULTS

from .equations import CompiledMethod, IntegrationError
from .interrupts import interruptible
from .lattice import Reduction, pack
from .observables import ObservableRecord
from .problem import Problem
from .traced import TracedEquations

BLOCK, GUARD = 64, 32
"""Number of sites by which W grows, and number of sites at each end that must be at rest when an
interval starts. No front may cross GUARD sites within an interval."""
INTERVAL = 2.0
"""Default length of an interval, in units of time."""


class Interval(NamedTuple):
    """Outputs and final state of one interval of a run."""

    times: np.ndarray  # (time,), output times, both ends included
    record: ObservableRecord  # its snapshots hold the state at every output
    state: np.ndarray  # (row, 1 + site + 1) with ghosts; changing it changes the run from here on
    right_half: np.ndarray  # (row, site), the sites 0..W of the state


def integrate_intervals(
    problem: Problem, rest_threshold: float, length: float = INTERVAL
) -> Iterator[Interval]:
    """Integrate a problem on an infinite chain; yield the intervals one after another.

    `rest_threshold` is relative to the largest amplitude. The kernels are those of the traced
    model. Raises IntegrationError if the solver cannot finish an interval.
    """
    even = _is_even(problem.initial)
    chain = _GrowingChain(problem, even)
    width = problem.initial.shape[1] // 2 + BLOCK
    state = pack(place(problem.initial, width), Reduction(even, synchronised=False))
    steps = round(problem.span / problem.output_step)
    steps_of_interval = int(length / problem.output_step)
    for first in range(0, steps, steps_of_interval):
        state = widen(state, rest_threshold, even)
        last = min(first + steps_of_interval, steps)
        times = problem.start_time + problem.output_step * np.arange(first, last + 1)
        record = chain.advance(state, times)
        right_half = state[:, 1 if even else 1 + width_of(state, even) : -1]
        yield Interval(times, record, state, right_half)


def widen(state: np.ndarray, rest_threshold: float, even: bool = True) -> np.ndarray:
    """Return the state; if an end is no longer at rest, a block of sites is added at each end."""
    power = (state[:, 1:-1] * state[:, 1:-1]).sum(axis=0)
    at_ends = power[-GUARD:].max() if even else max(power[:GUARD].max(), power[-GUARD:].max())
    if not at_ends > rest_threshold * rest_threshold * power.max():
        return state
    return np.pad(state[:, 1:-1], ((0, 0), (1 if even else 1 + BLOCK, 1 + BLOCK)))


def width_of(state: np.ndarray, even: bool) -> int:
    """Return W, the last site of a state (row, 1 + site + 1) with two ghosts."""
    return state.shape[1] - 3 if even else (state.shape[1] - 3) // 2


def _is_even(initial: np.ndarray) -> bool:
    return np.array_equal(initial, initial[:, ::-1])


class _GrowingChain:
    """The kernels of one problem for a growing number of sites.

    Work arrays are allocated only when the number of sites changes, because allocating them for
    every interval would take 10 % of the run time.
    """

    def __init__(self, problem: Problem, even: bool) -> None:
        self.problem, self.even = problem, even
        self.columns = 0
        self.prepared: tuple[CompiledMethod, Any, np.ndarray]

    def advance(self, state: np.ndarray, times: np.ndarray) -> ObservableRecord:
        """Integrate `state` in place over `times` and return its observables."""
        if state.shape[1] != self.columns:
            self._prepare(state)
        compiled, system, work = self.prepared
        components, sites = state.shape[0] // 2, state.shape[1] - 2
        equations = TracedEquations(self.problem)
        record = equations.record(components, sites, len(times), every=1, conserved=False)
        controls = compiled.controls_of(self.problem.solver)
        run = compiled.run_for(system, state)
        outcome = interruptible(run, system, state, times, controls, work, record)
        if outcome.status != DONE:
            reason = f"at t = {outcome.time:.6g}: {FAULTS[outcome.status]}"
            raise IntegrationError(f"{compiled.method.name} stopped {reason}")
        return record

    def _prepare(self, state: np.ndarray) -> None:
        chain = self.problem.changed(half_width=width_of(state, self.even))
        equations = TracedEquations(chain)
        compiled = equations.compiled(self.problem.solver["name"])
        system = equations.system(Reduction(self.even, synchronised=False))
        self.columns = state.shape[1]
        self.prepared = compiled, system, compiled.work_for(system, state)
