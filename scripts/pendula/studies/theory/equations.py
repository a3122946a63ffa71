"""Equations (4) on amplitudes: as the Hamiltonian system (7), and what they conserve.

Short runs of the checks start here too. Their solver is dop853 at tolerances so tight that no
check measures it instead of the paper.
"""

import itertools
from collections.abc import Sequence
from dataclasses import replace
from functools import partial

import numpy as np

from pendula.datasets.checks import tabulate, variable
from pendula.feasibility import find_fault
from pendula.integrators import DONE
from pendula.measures.norms import power_of
from pendula.models.amplitudes import energies, rates
from pendula.numerics import elementary
from pendula.numerics.draws import complex_normal
from pendula.numerics.elementary import complex_of, modulus, product
from pendula.problem import Constants, Problem, output_times
from pendula.simulation.interrupts import interruptible
from pendula.simulation.lattice import WHOLE
from pendula.simulation.models import make_chain
from pendula.simulation.observables import blank_record
from pendula.simulation.simulate import Trajectory, simulate
from pendula.simulation.solvers import SOLVERS

EPS = np.finfo(float).eps
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
        constants=constants,
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


def gradient(function, point: np.ndarray) -> np.ndarray:
    """Return d/d(conj z) of a real quartic polynomial in the real and imaginary parts of z.

    The five-point formula has no truncation error up to degree four, so the step can be one and
    nothing cancels.
    """

    def slope(direction: np.ndarray) -> float:
        f = [function(point + step * direction) for step in (-2, -1, 1, 2)]
        return (8.0 * (f[2] - f[1]) - (f[3] - f[0])) / 12.0

    units = np.eye(point.size).reshape(-1, *point.shape)
    found = [0.5 * complex_of(slope(unit), slope(1j * unit)) for unit in units]
    return np.reshape(found, point.shape)


def misstated(constants: Constants, omega_off: float = 0.0, gamma_times: float = 1.0) -> Constants:
    """Return the constants as a statement has them: in a control not those of the motion.

    Every check can be asked about a wrong statement, whose Omega is off by `omega_off` or whose
    gamma is `gamma_times` the right one; the negative controls of the ledger rest on that.
    """
    omega, gamma = constants.omega + omega_off, constants.gamma * gamma_times
    return replace(constants, omega=omega, gamma=gamma)


def check_gradient(
    constants: Constants, sites: int, samples: int, seed: int, omega_off: float = 0.0
) -> dict:
    """Compare the rates with -i dH/d(conj A), -i dH/d(conj B) of (7), for each kind of ends.

    The tolerance is what rounding in the energy allows: some tens of units in its last place.
    """
    stated = misstated(constants, omega_off)
    rng, errors = np.random.default_rng(seed), []
    for boundary, _ in itertools.product(BOUNDARIES, range(samples)):
        z = random_amplitudes(rng, sites, np.sqrt(2.0 * sites))
        found = right_hand_side(constants, boundary, z)
        expected = product(-1j, gradient(partial(total_energy, stated, boundary), z))
        size = abs(total_energy(constants, boundary, z)) + modulus(found).max()
        errors.append({"gradient_error": modulus(found - expected).max() / size})
    return tabulate(
        "Right-hand side of (4) against the gradient (7) of the energy (8)",
        {"boundary": BOUNDARIES, "sample": np.arange(samples)},
        errors,
        {"gradient_error": ("largest difference over the energy", 50 * EPS)},
    )


def check_conservation(
    gamma, epsilon, omegas, sites: int, end_time, seed: int, omega_off=0.0, turn: complex = 1.0
) -> dict:
    """Follow H and the l2 norm from random data, and turn the phase, for each kind of ends.

    The phase is turned of any data and of data with B = `turn` * A, which is A in the paper. H of
    a statement with another Omega has the same rate as the right H but for `omega_off` times P.
    """
    rng, angle, rows = np.random.default_rng(seed), elementary.turn(0.7), []
    for boundary, omega in itertools.product(BOUNDARIES, omegas):
        constants = Constants(epsilon=epsilon, gamma=gamma, omega=omega)
        opposite = replace(constants, gamma=-gamma)
        start = random_amplitudes(rng, sites, 2.0)
        alike = np.stack([start[0], product(turn, start[0])])
        trajectory = run(constants, boundary, start, end_time, 50)
        power = squared_norm(trajectory.l2)
        energy = trajectory.energy + omega_off * power
        row = {
            "energy_drift": np.abs(energy - energy[0]).max(),
            "l2_change": np.abs(power / power[0] - 1.0).max(),
            "gauge_defect": phase_defect(constants, constants, boundary, start, angle),
            "gauge_defect_alike": phase_defect(constants, constants, boundary, alike, angle),
            "sign_defect": phase_defect(constants, opposite, boundary, start, product(1j, turn)),
        }
        rows.append(row)
    about = {
        "energy_drift": ("largest |H - H(0)|", 1e-7),
        "l2_change": "largest relative change of the squared l2 norm",
        "gauge_defect": "defect of turning all phases",
        "gauge_defect_alike": ("the same on A = B", 1e-13),
        "sign_defect": ("defect of turning the sign of gamma", 1e-13),
    }
    title = "What is conserved along the flow, and what turning the phases does"
    coords = {"boundary": BOUNDARIES, "point": np.arange(len(omegas))}
    omega = variable(omegas, ("point",), "detuning Omega")
    return tabulate(title, coords, rows, about, omega=omega)


def phase_defect(constants, other: Constants, boundary: str, amplitudes, factor: complex) -> float:
    """Return how far multiplying (A, B) by `factor` is from taking (4) to (4) with the `other`."""
    turned = right_hand_side(other, boundary, product(factor, amplitudes))
    expected = product(factor, right_hand_side(constants, boundary, amplitudes))
    return float(modulus(turned - expected).max())
