"""Equations (4) on amplitudes: short runs of the checks, and the data that they start from.

Their solver is dop853 at tolerances so tight that no check measures it instead of the paper.
"""

from collections.abc import Sequence

import numpy as np
from latticode.integrators import DONE
from latticode.measures.norms import power_of
from latticode.numerics import elementary
from latticode.numerics.draws import complex_normal
from latticode.simulation.interrupts import interruptible
from latticode.simulation.lattice import WHOLE
from latticode.simulation.observables import blank_record
from latticode.simulation.problem import output_times
from latticode.simulation.simulate import Trajectory, simulate

from pendula.feasibility import find_fault
from pendula.models.amplitudes import energies, rates
from pendula.models.integrations import make_chain
from pendula.models.solvers import SOLVERS
from pendula.problem import Constants, Problem

BOUNDARIES = ("dirichlet", "free", "periodic")
"""The ends that are checked, and drawn from: written out, since other ones would move all draws."""
TOLERANCES = {"rtol": 1e-12, "atol": 1e-14}
TIGHT = {"name": "dop853", **TOLERANCES}


def run(
    constants: Constants, boundary: str, amplitudes: np.ndarray, end_time, outputs=1, solver=TIGHT
) -> Trajectory:
    """Integrate amplitudes (2, N) on the full chain, without any short cut.

    The trajectory has its start and as many `outputs`, in equal steps up to `end_time`.
    """
    problem = Problem(
        parameters=vars(constants),
        half_width=amplitudes.shape[1] // 2,
        boundary=boundary,
        initial=amplitudes,
        end_time=end_time,
        output_step=end_time / outputs,
        solver=solver,
    )
    return simulate(problem, WHOLE)


def right_hand_side(constants: Constants, boundary: str, amplitudes: np.ndarray) -> np.ndarray:
    """Return (dA/dtau, dB/dtau) of `amplitudes` (..., 2, N), as the library computes them."""
    states, chain = _pack(amplitudes), make_chain(constants, boundary, WHOLE)
    found = np.zeros_like(states)
    for y, dy in zip(states, found, strict=True):
        rates(chain, y, dy)
    return (found[:, 0::2, 1:-1] + 1j * found[:, 1::2, 1:-1]).reshape(amplitudes.shape)


def _pack(amplitudes: np.ndarray) -> np.ndarray:
    """Return the states of whole chains, (count, 4, N + 2), of `amplitudes` (..., 2, N)."""
    chains = amplitudes.reshape(-1, *amplitudes.shape[-2:])
    states = np.zeros((len(chains), 4, chains.shape[2] + 2))
    states[:, 0::2, 1:-1], states[:, 1::2, 1:-1] = chains.real, chains.imag
    return states


def total_energy(constants: Constants, boundary: str, amplitudes: np.ndarray):
    """Return H of equation (8), (...), of `amplitudes` (..., 2, N), as the library computes it."""
    states = _pack(amplitudes)
    found, scratch = np.empty(len(states)), np.empty((2, states.shape[2]))
    energies(make_chain(constants, boundary, WHOLE), states, scratch, found)
    return found.reshape(amplitudes.shape[:-2])[()]


def squared_norm(l2: np.ndarray) -> np.ndarray:
    """Return P = |A|^2 + |B|^2 in l2 from the norms of A and B along the first axis."""
    return l2[0] ** 2 + l2[1] ** 2


def run_powers(
    constants: Sequence, boundaries: Sequence, amplitudes, end_time, outputs, tolerances=TOLERANCES
) -> tuple[np.ndarray, np.ndarray]:
    """Integrate many independent problems; return P (run, 1 + output) and H at the start (run,).

    Constants, ends and data (2, N) are given for each run. Each goes by `taylor` on the whole
    chain. Where a solver refuses a run or gives it up, P is infinite at all times after the first:
    such a run breaks every bound, and nothing that is read off it can pass for a number.
    """
    solver, method = {"name": "taylor", **tolerances}, SOLVERS["taylor"]
    controls = tuple(float(solver[name]) for name in method.controls)
    states, times = _pack(np.array(amplitudes)), output_times(end_time, end_time / outputs)
    peaks = np.abs(states).max(axis=(1, 2)).tolist()
    count, rows, columns = states.shape
    record = blank_record(rows // 2, columns - 2, len(times), 0)
    powers, energies = np.full((count, outputs + 1), np.inf), np.empty(count)

    def follow(stop: np.ndarray) -> None:
        work = None
        for i, (own, boundary, y) in enumerate(zip(constants, boundaries, states, strict=True)):
            if stop[0]:
                return
            chain = make_chain(own, boundary, WHOLE)
            work = method.room_for(chain, y) if work is None else work
            if not find_fault(own, peaks[i], end_time, solver):
                outcome = method.run(chain, y, times, controls, work, record, stop)
                kept = (record.linf, record.l2, record.energy, y[:, 1:-1])
                if outcome.status == DONE and all(np.isfinite(values).all() for values in kept):
                    powers[i], energies[i] = squared_norm(record.l2), record.energy[0]
                    continue
            powers[i, 0] = power_of(amplitudes[i])
            energies[i] = total_energy(own, boundary, amplitudes[i])

    interruptible(follow)
    return powers, energies


def random_amplitudes(rng: np.random.Generator, sites: int, norm: float) -> np.ndarray:
    """Return complex Gaussian amplitudes (2, N) scaled to the l2 norm `norm` of the pair."""
    drawn = complex_normal(rng, (2, sites))
    return norm / np.sqrt(power_of(drawn)) * drawn


def draw_shape(rng: np.random.Generator, sites: int) -> np.ndarray:
    """Return amplitudes (2, N) of norm one: from a single pair to the whole chain, any phases."""
    reach = rng.choice([0.0, 0.5, 1.5, 1e9])
    distance = np.abs(np.arange(sites) - rng.integers(sites))
    near = np.where(distance <= reach, 1.0, 0.0)
    envelope = near if reach < 1 else elementary.exp(-distance / reach)
    drawn = envelope * complex_normal(rng, (2, sites))
    if rng.random() < 0.5:
        drawn[1] = -drawn[0]  # the subspace that the drive acts on
    return 1.0 / np.sqrt(power_of(drawn)) * drawn


def one_pair(sites: int, pair) -> np.ndarray:
    """Return amplitudes (2, N) with one pair in the middle and all else at rest."""
    amplitudes = np.zeros((2, sites), complex)
    amplitudes[:, sites // 2] = pair
    return amplitudes


def alternating(sites: int, x: float) -> np.ndarray:
    """Return A_n = -B_n = (-1)^n x, shape (2, N)."""
    wave = x * (1.0 - 2.0 * (np.arange(sites) % 2))
    return np.stack([wave, -wave]).astype(complex)
