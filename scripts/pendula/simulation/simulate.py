"""From the parameters of a case to its trajectory."""

from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from pendula.integrators.outcome import DONE, FAULTS, Outcome
from pendula.models.amplitudes import Chain

from .automatic import refine
from .feasibility import find_obstacle
from .lattice import (
    Reduction,
    choose_ends,
    find_reduction,
    pack,
    place,
    require_centre,
    spread,
    unpack,
)
from .observables import Record, blank_record
from .solvers import SOLVERS


class IntegrationError(RuntimeError):
    """A run that could not reach its end time with the digits that were asked for."""


class Trajectory(NamedTuple):
    """What a solver made of a case; components are A, B and sites -M..M throughout."""

    tau: np.ndarray  # (time,)
    linf: np.ndarray  # (component, time)
    l2: np.ndarray  # (component, time)
    energy: np.ndarray  # (time,)
    modulus: np.ndarray  # (component, site, snapshot), empty unless asked for
    final: np.ndarray  # (component, site), complex amplitudes at the end time
    outcome: Outcome
    solver: dict  # {"name": ..., **controls} of the run


def output_times(end_time: float, output_step: float) -> np.ndarray:
    """Return 0, ..., end_time in equal steps; integers among them are exact."""
    count = round(end_time / output_step)
    return end_time * np.arange(count + 1) / count


def simulate(
    *,
    epsilon: float,
    gamma: float,
    omega: float,
    half_width: int,
    boundary: str,
    initial: dict[int, tuple[complex, complex]],
    end_time: float,
    output_step: float,
    solver: dict,
    snapshot_every: int = 0,
) -> Trajectory:
    """Integrate the case and reduce it to observables at the output times.

    `solver` is {"name": ..., **controls}, or {"name": "auto", "error": ...}; `snapshot_every`
    keeps |A_n|, |B_n| at each so many outputs. Raises IntegrationError where the solver gives up.
    """
    amplitudes = place(initial, half_width)
    times = output_times(end_time, output_step)
    reduction, constants = find_reduction(amplitudes), (epsilon, gamma, omega)

    def run(controls: dict) -> Trajectory:
        return integrate(
            constants, boundary, amplitudes, reduction, times, controls, snapshot_every
        )

    return _run_to_error(run, solver["error"]) if solver["name"] == "auto" else run(solver)


def _run_to_error(run: Callable[[dict], Trajectory], error: float) -> Trajectory:
    """Return the run that keeps `error`; its controls say what was asked for and estimated."""
    try:
        trajectory, controls, estimate = refine(run, error)
    except ArithmeticError as fault:
        raise IntegrationError(f"auto: {fault}") from None
    asked = {"requested_error": error, "estimated_error": estimate}
    return trajectory._replace(solver={**controls, **asked})


def integrate(
    constants: tuple[float, float, float],
    boundary: str,
    amplitudes: np.ndarray,
    reduction: Reduction,
    times: np.ndarray,
    solver: dict,
    snapshot_every: int = 0,
) -> Trajectory:
    """Integrate amplitudes (2, N) under (epsilon, gamma, omega), reduced as `reduction` says.

    Raises ValueError where N is even (the kernels count sites in pairs around a centre), and
    IntegrationError where the run would not end, gives up, or its result is not finite.
    """
    require_centre(amplitudes.shape[1])
    obstacle = find_obstacle(constants, amplitudes, float(times[-1] - times[0]), solver)
    if obstacle:
        raise _stopped(solver, times[0], obstacle)
    method = SOLVERS[solver["name"]]
    chain = Chain(*map(float, constants), *choose_ends(boundary, reduction))
    y = pack(amplitudes, reduction)
    record = blank_record(y.shape[0] // 2, y.shape[1] - 2, len(times), snapshot_every)
    controls = tuple(float(solver[name]) for name in method.controls)
    work = aligned((method.work, *y.shape))
    outcome = method.run(chain, y, times, controls, work, record)
    if outcome.status != DONE:
        raise _stopped(solver, outcome.time, FAULTS[outcome.status])
    for values in (record.linf, record.l2, record.energy, y[:, 1:-1]):
        if not np.isfinite(values).all():
            raise _stopped(solver, outcome.time, "the state, its norms or its energy overflow")
    return _collect(times, record, y, reduction, outcome)._replace(solver=solver)


def _stopped(solver: dict, time: float, reason: str) -> IntegrationError:
    return IntegrationError(f"{solver['name']} stopped at tau = {time:.6g}: {reason}")


def aligned(shape: tuple[int, ...], bytes_: int = 64) -> np.ndarray:
    """Return zeros that start on a cache line: loads that cross lines cost a quarter more."""
    count = int(np.prod(shape))
    spare = bytes_ // 8
    memory = np.zeros(count + spare)
    first = -memory.ctypes.data % bytes_ // 8
    return memory[first : first + count].reshape(shape)


def _collect(
    times: np.ndarray, record: Record, y: np.ndarray, reduction: Reduction, outcome: Outcome
) -> Trajectory:
    both = Reduction(even=False, synchronised=reduction.synchronised)
    return Trajectory(
        times,
        spread(record.linf, both),
        spread(record.l2, both),
        record.energy,
        spread(record.modulus, reduction),
        unpack(y, reduction),
        outcome,
        {},
    )
