"""An infinite chain: only the sites in motion are integrated, 0..W of even data, else -W..W.

W grows by a block when anything above `rest` of the largest amplitude comes near the last site.
For the numbers of a short run 1e-20 is enough, four orders below rounding. But a front that is
pulled by the growth of its leading edge is slowed where the edge is cut off (Brunet and Derrida,
Phys. Rev. E 56 (1997) 2597): up to tau = 600 not by a site, by tau = 1800 it is 0.9 sites behind.
A long run takes 1e-150, about the least whose square is a normal double, and keeps the speed of
linear spreading.

Sites are added between two pieces of a run. Each piece starts the solver again from the state
alone; the new first step costs half a per cent. A state holds S and D (see `sums`).
"""

from typing import NamedTuple

import numpy as np
from latticode.integrators import DONE, FAULTS
from latticode.numerics.elementary import log
from latticode.simulation.interrupts import interruptible
from latticode.simulation.lattice import Reduction, pack
from latticode.simulation.observables import Record, blank_state_record
from latticode.simulation.problem import place
from latticode.simulation.simulate import IntegrationError
from latticode.simulation.systems import make_system, solvers_of

from pendula.problem import Problem

from .bulk import bulk_maxima, cell_means, region_means, site_powers
from .sums import in_sums, turned

BLOCK, GUARD = 64, 32
"""Sites by which W grows, and how many of the last ones must be at rest: no front crosses GUARD
sites within a piece of a few units of tau."""

LEVEL = 1e-2
"""Power of a pair at which the fronts are found: of P the first, of its part |S|^2 the second."""

DIGITS = 3
"""Digits that are kept of the place of a front between two sites."""

PIECE = 2.0
"""Units of tau between two looks at the last sites."""


def is_even(initial: np.ndarray) -> bool:
    """Return whether data (2, 2r + 1) are the same on sites n and -n."""
    return np.array_equal(initial, initial[:, ::-1])


def begin(initial: np.ndarray, half_width: int | None = None) -> np.ndarray:
    """Return the state of data on the sites in motion; without a `half_width` there are no ends.

    A state has two ghosts, (row, 1 + site + 1).
    """
    reach = initial.shape[1] // 2
    width = reach + BLOCK if half_width is None else min(reach + BLOCK, half_width)
    return pack(place(initial, width), Reduction(is_even(initial), synchronised=False))


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


def advance(
    problem: Problem, state: np.ndarray, times: np.ndarray, rooms: dict, even: bool = True
) -> Record:
    """Integrate `state` in place over `times` (outputs, both ends included) on its sites.

    `rooms` keeps the work arrays from one piece to the next: to allocate them anew takes a tenth of
    the time of a piece. Raises IntegrationError where the solver gives up.
    """
    solver = problem.solver
    if state.shape not in rooms:
        chain = problem.changed(half_width=width_of(state, even))
        method = solvers_of(chain)[solver["name"]]
        system = make_system(chain, Reduction(even, synchronised=False))
        rooms.clear()
        rooms[state.shape] = method, system, method.room_for(system, state)
    method, system, room = rooms[state.shape]
    record = blank_state_record(2, state.shape[1] - 2, len(times), 1)
    controls = tuple(float(solver[name]) for name in method.controls)
    outcome = interruptible(method.run, system, state, times, controls, room, record)
    if outcome.status != DONE:
        reason = FAULTS[outcome.status]
        raise IntegrationError(f"stopped at tau = {outcome.time:.6g}: {reason}")
    return record


def find_front(power: np.ndarray) -> float:
    """Return the site where the power (site,) falls below LEVEL for good, -1 if none is above.

    Between two sites the logarithm of the power is interpolated. The place is rounded to a
    thousandth of a site, since its last bits differ between machines.
    """
    above = np.flatnonzero(power > LEVEL)
    if not above.size:
        return -1.0
    site = int(above[-1])
    beyond = power[site + 1] if site + 1 < power.size else 0.0
    if not beyond > 0.0:
        return float(site)
    start, level, end = log(np.array([power[site], LEVEL, beyond])).tolist()
    return site + round((start - level) / (start - end), DIGITS)


# --- A run in pieces ------------------------------------------------------------------------------


class LongRun(NamedTuple):
    """Series of a run: of the pair (A, B), at every output, or at the end of every piece.

    Of data that are not even in n, all but the norms are of the sites 0..W.
    """

    tau: np.ndarray  # (time,)
    l2: np.ndarray  # (time,)
    linf: np.ndarray  # (time,)
    piece_tau: np.ndarray  # (piece,)
    front: np.ndarray  # (piece,), -1 if there is none
    second_front: np.ndarray  # (piece,), the same of |S|^2
    width: np.ndarray  # (piece,): W, the last site integrated
    means: np.ndarray  # (piece, region, 3): of P, |S|^2 and H behind and between the fronts
    maxima: np.ndarray  # (piece, size): of the moduli of so many neighbours in the bulk
    cells: list[np.ndarray]  # of each piece |S|^2 and |D|^2, means of cells of sites, (2, cell)


OUTPUTS = LongRun._fields[:3]


def run_long(problem: Problem, rest: float) -> LongRun:
    """Return the run of `problem`, whose half-width is None where the chain has no ends.

    `rest` is what counts as at rest ahead of the front (see above).
    """
    even, rooms, own = is_even(problem.initial), {}, in_sums(problem)
    state, series = begin(own.initial, problem.half_width), {name: [] for name in LongRun._fields}
    for piece in range(round(problem.end_time / PIECE)):
        state = widen(state, problem.half_width, rest, even)
        times = piece_times(problem, piece)
        record = advance(own, state, times, rooms, even)
        for name, values in zip(OUTPUTS, (times, *_norms(record)), strict=True):
            series[name].extend(values[1 if piece else 0 :])  # the first ends the piece before
        sites = right_half(state, even)
        front, second = find_front(site_powers(sites)), find_front(site_powers(sites[:2]))
        at_end = {
            "piece_tau": times[-1],
            "front": front,
            "second_front": second,
            "width": sites.shape[1] - 1,
            "means": region_means(sites, problem.constants, front, second),
            "maxima": bulk_maxima(turned(sites), front),
            "cells": cell_means(sites),
        }
        for name, value in at_end.items():
            series[name].append(value)
    cells = series.pop("cells")
    return LongRun(**{name: np.array(values) for name, values in series.items()}, cells=cells)


def piece_times(problem: Problem, piece: int) -> np.ndarray:
    """Return the outputs from the start of a piece to its end, both included."""
    outputs = round(PIECE / problem.output_step)
    return problem.output_step * np.arange(piece * outputs, (piece + 1) * outputs + 1)


def _norms(record: Record) -> tuple[np.ndarray, np.ndarray]:
    """Return l2 and l-infinity of the pair (A, B) at every output, each (time,)."""
    s, d = np.swapaxes(record.kept, 0, 1)  # (part, site, time)
    both = turned(np.concatenate([s, d]))
    squares = np.maximum((both[:2] ** 2).sum(axis=0), (both[2:] ** 2).sum(axis=0))
    return np.sqrt((record.l2**2).sum(axis=0)), np.sqrt(squares.max(axis=0))


def right_half(state: np.ndarray, even: bool) -> np.ndarray:
    """Return the sites 0..W of a state, (row, site)."""
    return state[:, 1 if even else 1 + width_of(state, even) : -1]
