"""An infinite chain: only the sites in motion are integrated, 0..W of even data, else -W..W.

W grows by a block when anything above `rest` of the largest amplitude comes near the last site.
For the numbers of a short run 1e-20 is enough, four orders below rounding. But a front that is
pulled by the growth of its leading edge is slowed where the edge is cut off (Brunet and Derrida,
Phys. Rev. E 56 (1997) 2597): up to tau = 600 not by a site, by tau = 1800 it is 0.9 sites behind.
A long run takes 1e-150, about the least whose square is a normal double, and keeps the speed of
linear spreading.

Sites are added between two pieces of a run. Each piece starts the solver again from the state
alone; the new first step costs half a per cent.
"""

from collections.abc import Mapping
from typing import NamedTuple

import numpy as np

from pendula.integrators import DONE, FAULTS, Outcome
from pendula.numerics.elementary import log
from pendula.problem import Constants, Problem, place
from pendula.simulation.interrupts import interruptible
from pendula.simulation.lattice import Reduction, pack
from pendula.simulation.models import make_chain
from pendula.simulation.observables import Record, blank_record
from pendula.simulation.simulate import IntegrationError
from pendula.simulation.solvers import SOLVERS

from .bulk import bulk_maxima, bulk_means

BLOCK, GUARD = 64, 32
"""Sites by which W grows, and how many of the last ones must be at rest: no front crosses GUARD
sites within a piece of a few units of tau."""

LEVELS = np.array([1e-6, 1e-2, 1.0, 4.0])
"""Powers |A|^2 + |B|^2 at which the front is found: its leading edge, and where it breaks."""

DIGITS = 3
"""Digits that are kept of the place of the front between two sites."""

PIECE = 2.0
"""Units of tau between two looks at the last sites."""


def is_even(initial: np.ndarray) -> bool:
    """Return whether data (2, 2r + 1) are the same on sites n and -n."""
    return np.array_equal(initial, initial[:, ::-1])


def begin(initial: np.ndarray, half_width: int | None) -> np.ndarray:
    """Return the state of data on the sites in motion; without a `half_width` there are no ends.

    A state has two ghosts, (row, 1 + site + 1).
    """
    reach = initial.shape[1] // 2
    width = reach + BLOCK if half_width is None else min(reach + BLOCK, half_width)
    return pack(place(initial, width), Reduction(is_even(initial), synchronised=False))


def site_powers(sites: np.ndarray) -> np.ndarray:
    """Return |A_n|^2 + |B_n|^2 on (row, site)."""
    return (sites**2).sum(axis=0)


def width_of(state: np.ndarray, even: bool) -> int:
    """Return W, the last site of a state."""
    return state.shape[1] - 3 if even else (state.shape[1] - 3) // 2


def widen(state: np.ndarray, half_width: int | None, rest: float, even: bool = True) -> np.ndarray:
    """Return the state with a block of sites at rest added where an end is no longer at rest."""
    power, width = site_powers(state[:, 1:-1]), width_of(state, even)
    at_ends = power[-GUARD:].max() if even else max(power[:GUARD].max(), power[-GUARD:].max())
    if width == half_width or not at_ends > rest * rest * power.max():
        return state
    more = BLOCK if half_width is None else min(BLOCK, half_width - width)
    return np.pad(state[:, 1:-1], ((0, 0), (1 if even else 1 + more, 1 + more)))


class Piece(NamedTuple):
    """What a piece of a run gave: norms and energy at its outputs, and what the solver did."""

    record: Record
    outcome: Outcome


def advance(
    constants: Constants,
    state: np.ndarray,
    times: np.ndarray,
    solver: Mapping,
    rooms: dict | None = None,
    even: bool = True,
) -> Piece:
    """Integrate `state` in place over `times` (outputs, both ends included) on its sites.

    `rooms` keeps the solver's work arrays from one piece to the next: to allocate them anew takes
    a tenth of the time of a piece. Raises IntegrationError where the solver gives up.
    """
    rooms = {} if rooms is None else rooms
    method = SOLVERS[solver["name"]]
    record = blank_record(state.shape[0] // 2, state.shape[1] - 2, len(times), 0)
    controls = tuple(float(solver[name]) for name in method.controls)
    chain = make_chain(constants, "dirichlet", Reduction(even, synchronised=False))
    key = solver["name"], state.shape
    if key not in rooms:
        rooms.clear()
        rooms[key] = method.room_for(chain, state)
    outcome = interruptible(method.run, chain, state, times, controls, rooms[key], record)
    if outcome.status != DONE:
        reason = FAULTS[outcome.status]
        raise IntegrationError(f"stopped at tau = {outcome.time:.6g}: {reason}")
    return Piece(record, outcome)


def find_front(sites: np.ndarray) -> np.ndarray:
    """Return the site where the power falls below each of LEVELS for good, -1 if none is above.

    Between two sites the logarithm of the power is interpolated. The place is rounded to a
    thousandth of a site, since its last bits differ between machines.
    """
    power = np.append(site_powers(sites), 0.0)  # the last site has nothing behind it
    above = power > LEVELS[:, None]
    site = np.where(above.any(axis=1), power.size - 1 - above[:, ::-1].argmax(axis=1), -1)
    here, beyond = power[site], power[site + 1]
    between = (site >= 0) & (beyond > 0.0)
    sizes = np.where(between, [here, LEVELS, beyond], [[2.0], [2.0], [1.0]])
    start, level, end = log(sizes)
    parts = ((start - level) / (start - end)).tolist()
    return site + np.array([round(part, DIGITS) for part in parts])


# --- A run in pieces ------------------------------------------------------------------------------


class LongRun(NamedTuple):
    """Series of a run: of the pair (A, B), at every output, or at the end of every piece."""

    tau: np.ndarray  # (time,)
    l2: np.ndarray  # (time,)
    linf: np.ndarray  # (time,)
    energy: np.ndarray  # (time,)
    piece_tau: np.ndarray  # (piece,)
    front: np.ndarray  # (piece, level): where the power falls below each of LEVELS, -1 if none
    width: np.ndarray  # (piece,): W, the last site integrated
    # Of data that are not even in n, front, bulk and sites are those of 0..W
    bulk: np.ndarray  # (piece, level, 5): means of P and of the terms of H behind each front
    maxima: np.ndarray  # (piece, size): of the moduli of so many neighbours in the bulk
    sites: np.ndarray  # (row, site) at the end


OUTPUTS = LongRun._fields[:4]


def run_long(problem: Problem, rest: float) -> LongRun:
    """Return the run of `problem`, whose half-width is None where the chain has no ends.

    `rest` is what counts as at rest ahead of the front (see above).
    """
    even, rooms, state = is_even(problem.initial), {}, begin(problem.initial, problem.half_width)
    series = {name: [] for name in LongRun._fields[:-1]}
    for piece in range(round(problem.end_time / PIECE)):
        state = widen(state, problem.half_width, rest, even)
        times = _times(problem, piece, piece + 1)
        record = advance(problem.constants, state, times, problem.solver, rooms, even).record
        for name, values in zip(OUTPUTS, (*_norms(times, record), record.energy), strict=True):
            series[name].extend(values[1 if piece else 0 :])  # the first ends the piece before
        sites = _right_half(state, even)
        front = find_front(sites)
        at_end = {
            "piece_tau": times[-1],
            "front": front,
            "width": sites.shape[1] - 1,
            "bulk": bulk_means(sites, problem.constants, front),
            "maxima": bulk_maxima(sites, front[-1]),
        }
        for name, value in at_end.items():
            series[name].append(value)
    arrays = {name: np.array(values) for name, values in series.items()}
    return LongRun(**arrays, sites=_right_half(state, even))


def _times(problem: Problem, piece: int, last: int) -> np.ndarray:
    """Return the outputs from the start of a piece to that of another, both included."""
    outputs = round(PIECE / problem.output_step)
    return problem.output_step * np.arange(piece * outputs, last * outputs + 1)


def _norms(times: np.ndarray, record: Record) -> np.ndarray:
    """Return tau, l2 and l-infinity of the pair (A, B) at every output, (3, time)."""
    return np.array([times, np.sqrt((record.l2**2).sum(axis=0)), record.linf.max(axis=0)])


def _right_half(state: np.ndarray, even: bool) -> np.ndarray:
    """Return the sites 0..W of a state, (row, site)."""
    return state[:, 1 if even else 1 + width_of(state, even) : -1]


# --- One chain of many half-widths ----------------------------------------------------------------


def run_chains(problem: Problem, rest: float, half_widths: list[int]) -> list[np.ndarray]:
    """Return tau, l2 and l-infinity, (3, time), on the chain of each of rising `half_widths`.

    As long as nothing moves near its end, a chain does what all longer ones do. So the longest one
    is run from the start, and each shorter one goes its own way when its sites have become too few;
    a chain whose end the front never reached has the norms of the longest one.
    """
    count, even = round(problem.end_time / PIECE), is_even(problem.initial)

    def norms(state: np.ndarray, piece: int, last: int) -> np.ndarray:
        times = _times(problem, piece, last)
        done = advance(problem.constants, state, times, problem.solver, even=even)
        return _norms(times, done.record)[:, 1 if piece else 0 :]

    state, shared = begin(problem.initial, half_widths[-1]), []
    width = width_of(state, even)
    own = {m: (0, begin(problem.initial, m)) for m in half_widths if m < width}
    for piece in range(count):
        wider = widen(state, half_widths[-1], rest, even)
        for half_width in half_widths:
            if half_width not in own and half_width < width_of(wider, even):
                own[half_width] = piece, state.copy()
        state = wider
        shared.append(norms(state, piece, piece + 1))
    found = []
    for half_width in half_widths:
        piece, state = own.get(half_width, (count, state))
        parts = shared[:piece]
        while piece < count:
            state = widen(state, half_width, rest, even)
            # a chain that cannot grow any more needs no further look at its end
            last = count if width_of(state, even) == half_width else piece + 1
            parts.append(norms(state, piece, last))
            piece = last
        found.append(np.concatenate(parts, axis=1))
    return found
