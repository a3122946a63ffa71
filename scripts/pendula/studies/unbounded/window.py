"""An even chain of which only the sites in motion are integrated: 0..W, and W grows.

The window opens by a block when anything above `rest` of the largest amplitude comes near its end.
For the numbers of a short run 1e-20 is enough, four orders below rounding. But a front that is
pulled by the growth of its leading edge is slowed by a cut (Brunet and Derrida, Phys. Rev. E 56
(1997) 2597): up to tau = 600 not by a site, by tau = 1800 it is 0.9 sites behind. A long run takes
1e-150, about the least whose square is a normal double, and keeps the speed of linear spreading.
"""

from collections.abc import Mapping
from typing import NamedTuple

import numpy as np

from pendula.integrators.outcome import DONE, FAULTS, Outcome
from pendula.problem import Constants, place
from pendula.simulation.lattice import Reduction, find_reduction, pack
from pendula.simulation.observables import Record, blank_record
from pendula.simulation.simulate import IntegrationError, aligned, make_chain
from pendula.simulation.solvers import SOLVERS

BLOCK, GUARD = 64, 32
"""Sites by which the window opens, and how many at its end must be at rest: no front crosses
GUARD sites within a piece of a few units of tau."""


class Piece(NamedTuple):
    """What one stretch of time gave: norms and energy at its outputs, the state at its end."""

    record: Record
    state: np.ndarray  # (row, 1 + site): sites 0..W and two ghosts
    outcome: Outcome


def open_window(initial: np.ndarray, half_width: int | None) -> np.ndarray:
    """Return the state of even data on the sites 0..W; `half_width` None is a chain without ends.

    Raises ValueError where the data are not even in n.
    """
    reach = initial.shape[1] // 2
    width = reach + BLOCK if half_width is None else min(reach + BLOCK, half_width)
    amplitudes = place(initial, width)
    reduction = find_reduction(amplitudes)
    if not reduction.even:
        raise ValueError("the window opens to both sides alike: give data that are even in n")
    return pack(amplitudes, reduction)


def powers(state: np.ndarray) -> np.ndarray:
    """Return |A_n|^2 + |B_n|^2 on the sites 0..W of a state (|A_n|^2 alone where A = B)."""
    return (state[:, 1:-1] ** 2).sum(axis=0)


def widen(state: np.ndarray, half_width: int | None, rest: float) -> np.ndarray:
    """Return the state with a block of sites at rest added where its end is no longer at rest."""
    power = powers(state)
    width = power.size - 1
    if width == half_width or not power[-GUARD:].max() > rest**2 * power.max():
        return state
    wider = width + BLOCK if half_width is None else min(width + BLOCK, half_width)
    opened = np.zeros((state.shape[0], wider + 3))
    opened[:, : width + 2] = state[:, :-1]
    return opened


def advance(constants: Constants, state: np.ndarray, times: np.ndarray, solver: Mapping) -> Piece:
    """Integrate `state` in place over `times` (outputs, both ends included) on its window.

    Raises IntegrationError where the solver gives up.
    """
    method = SOLVERS[solver["name"]]
    record = blank_record(state.shape[0] // 2, state.shape[1] - 2, len(times), 0)
    controls = tuple(float(solver[name]) for name in method.controls)
    work = aligned((method.work, *state.shape))
    chain = make_chain(constants, "dirichlet", Reduction(even=True, synchronised=False))
    outcome = method.run(chain, state, times, controls, work, record)
    if outcome.status != DONE:
        reason = FAULTS[outcome.status]
        raise IntegrationError(f"stopped at tau = {outcome.time:.6g}: {reason}")
    return Piece(record, state, outcome)
