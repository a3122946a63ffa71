"""Integration on an infinite chain: only the sites in motion, 0..W of even data, otherwise -W..W.

W grows by a block when a site near the end exceeds `rest_threshold` times the largest amplitude.
For a short run 1e-20 is small enough. But a front that is pulled by the growth of its leading edge
is slower if the edge is cut off (Brunet and Derrida, Phys. Rev. E 56 (1997) 2597), so long runs use
1e-150, about the smallest number whose square is a normal double.

A run is divided into intervals, between which sites are added. Each interval starts from the state
at the end of the one before. A state holds S and D (see `sums`).
"""

from collections.abc import Iterator, Sequence

import numpy as np
from latticode.equations.initial_values import place
from latticode.integrators import DONE, FAULTS
from latticode.simulation.interrupts import interruptible
from latticode.simulation.lattice import Reduction, pack
from latticode.simulation.observables import Record, blank_record
from latticode.simulation.simulate import IntegrationError
from latticode.simulation.traced import TracedEquations

from pendula.problem import Problem

from .bulk import EDGE, LEVEL, SLICE_LENGTH, find_front, region_means, site_powers
from .sums import halves, in_sums, turned

BLOCK, GUARD = 64, 32
"""W grows by the first number of sites, and the last sites, as many as the second, must be at rest:
no front crosses GUARD sites within an interval."""


def is_even(initial: np.ndarray) -> bool:
    """Return whether data (2, 2r + 1) are the same on the sites n and -n."""
    return np.array_equal(initial, initial[:, ::-1])


def width_of(state: np.ndarray, even: bool) -> int:
    """Return W, the last site of a state with two ghost sites, (row, 1 + site + 1)."""
    return state.shape[1] - 3 if even else (state.shape[1] - 3) // 2


def right_half(state: np.ndarray, even: bool) -> np.ndarray:
    """Return the sites 0..W of a state, (row, site)."""
    return state[:, 1 if even else 1 + width_of(state, even) : -1]


def widen(state: np.ndarray, rest_threshold: float, even: bool = True) -> np.ndarray:
    """Return the state with a block of sites added at an end that is no longer at rest."""
    power = site_powers(state[:, 1:-1])
    at_ends = power[-GUARD:].max() if even else max(power[:GUARD].max(), power[-GUARD:].max())
    if not at_ends > rest_threshold * rest_threshold * power.max():
        return state
    return np.pad(state[:, 1:-1], ((0, 0), (1 if even else 1 + BLOCK, 1 + BLOCK)))


def advance(
    problem: Problem, state: np.ndarray, times: np.ndarray, rooms: dict, even: bool
) -> Record:
    """Integrate `state` in place over `times` (outputs, both ends included) on its sites.

    `rooms` keeps the work arrays for the next interval: allocating them again takes a tenth of its
    time. Raises IntegrationError if the solver gives up.
    """
    solver = problem.solver
    if state.shape not in rooms:
        chain = problem.changed(half_width=width_of(state, even))
        equations = TracedEquations(chain)
        compiled = equations.compiled(solver["name"])
        system = equations.system(Reduction(even, synchronised=False))
        rooms.clear()
        rooms[state.shape] = compiled, system, compiled.work_for(system, state)
    compiled, system, room = rooms[state.shape]
    record = blank_record(2, state.shape[1] - 2, len(times), 1, parts=2)
    controls = compiled.controls_of(solver)
    outcome = interruptible(compiled.run, system, state, times, controls, room, record)
    if outcome.status != DONE:
        reason = FAULTS[outcome.status]
        raise IntegrationError(f"stopped at tau = {outcome.time:.6g}: {reason}")
    return record


def integrate_intervals(
    problem: Problem, rest_threshold: float
) -> Iterator[tuple[np.ndarray, Record, np.ndarray, np.ndarray]]:
    """Integrate a problem in S and D; yield the outputs and the last state of each interval.

    They are the times, both ends included, the record, the state, which may be changed in place,
    and its sites 0..W. `rest_threshold` is relative to the largest amplitude.
    """
    even, rooms = is_even(problem.initial), {}
    width = problem.initial.shape[1] // 2 + BLOCK
    state = pack(place(problem.initial, width), Reduction(even, synchronised=False))
    steps = round(problem.end_time / problem.output_step)
    steps_of_piece = int(SLICE_LENGTH / problem.output_step)
    for first in range(0, steps, steps_of_piece):
        state = widen(state, rest_threshold, even)
        last = min(first + steps_of_piece, steps)
        times = problem.output_step * np.arange(first, last + 1)
        record = advance(problem, state, times, rooms, even)
        yield times, record, state, right_half(state, even)


# --- What is kept of a run ------------------------------------------------------------------------


def run_long(
    problem: Problem,
    rest_threshold: float,
    levels: Sequence[float] = (LEVEL,),
    edges: Sequence[int] = (EDGE,),
) -> dict[str, np.ndarray]:
    """Return the series of a run of `problem` on an infinite chain.

    By `tau` these are l2 and linf of the pair (A, B). By `piece_tau` they are the site of the
    front, those of the second front at all `levels`, -1 if there is none, and `means`, see
    `region_means`, at all `edges`, whose regions end at the second front of the first level. A
    single level or edge has no axis. If the data are not even in n, all but the norms are those of
    the sites 0..W.
    """
    outputs, looks = [], []
    for times, record, _, sites in integrate_intervals(in_sums(problem), rest_threshold):
        first = 1 if outputs else 0  # the first output is the last one of the interval before
        outputs.append(np.array([times, *_norms(record)])[:, first:])
        power = site_powers(sites[:2])
        front, second = (
            find_front(site_powers(sites)),
            [find_front(power, level) for level in levels],
        )
        means = [region_means(sites, front, second[0], edge) for edge in edges]
        looks.append((times[-1], front, _one_or_all(second), _one_or_all(means)))
    series = dict(zip(("tau", "l2", "linf"), np.concatenate(outputs, axis=1), strict=True))
    names = ("piece_tau", "front", "second_front", "means")
    return series | dict(zip(names, map(np.array, zip(*looks, strict=True)), strict=True))


def _one_or_all(values: list) -> np.ndarray:
    """Return the only value, or an array of all if there are several."""
    return np.array(values if len(values) > 1 else values[0])


def _norms(record: Record) -> tuple[np.ndarray, np.ndarray]:
    """Return l2 and l-infinity of the pair (A, B) at every output, each (time,)."""
    s, d = np.swapaxes(record.kept, 0, 1)  # (Re or Im, site, time)
    squares = np.maximum(*(site_powers(re_im) for re_im in halves(turned(np.concatenate([s, d])))))
    return np.sqrt((record.l2**2).sum(axis=0)), np.sqrt(squares.max(axis=0))
