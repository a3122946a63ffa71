"""What the checks share: the library's equations on complex amplitudes, short runs, random data.

The solver is dop853 at tolerances so tight that no check measures it instead of the paper.
"""

import numpy as np

from pendula.models.amplitudes import ENDS, Chain, energy, rates
from pendula.problem import Constants, Problem
from pendula.simulation.lattice import WHOLE, pack, unpack
from pendula.simulation.simulate import IntegrationError, Trajectory, simulate

BOUNDARIES = tuple(ENDS)
TOLERANCES = {"rtol": 1e-12, "atol": 1e-14}
TIGHT = {"name": "dop853", **TOLERANCES}


def make_chain(constants: tuple[float, float, float], boundary: str) -> Chain:
    """Return the whole chain with (epsilon, gamma, omega) and two equal ends."""
    return Chain(*map(float, constants), ENDS[boundary], ENDS[boundary])


def run(constants, boundary: str, amplitudes: np.ndarray, times, solver=TIGHT) -> Trajectory:
    """Integrate amplitudes (2, N) over `times` on the full chain, without any short cut."""
    end_time = float(times[-1])
    problem = Problem(
        constants=Constants(**dict(zip(("epsilon", "gamma", "omega"), constants, strict=True))),
        half_width=amplitudes.shape[1] // 2,
        boundary=boundary,
        initial=amplitudes,
        end_time=end_time,
        output_step=end_time / (len(times) - 1),
        solver=solver,
    )
    return simulate(problem, WHOLE)


def right_hand_side(constants, boundary: str, amplitudes: np.ndarray) -> np.ndarray:
    """Return (dA/dtau, dB/dtau), shape (2, N), as the library computes them."""
    y = pack(amplitudes, WHOLE)
    dy = np.zeros_like(y)
    rates(make_chain(constants, boundary), y, dy)
    return unpack(dy, WHOLE)


def total_energy(constants, boundary: str, amplitudes: np.ndarray) -> float:
    """Return H of equation (8) for amplitudes (2, N), as the library computes it."""
    return float(energy(make_chain(constants, boundary), pack(amplitudes, WHOLE)))


def squared_norm(l2: np.ndarray) -> np.ndarray:
    """Return P = |A|^2 + |B|^2 in l2 from the norms of A and B along the first axis."""
    return l2[0] ** 2 + l2[1] ** 2


def run_powers(constants, boundaries, amplitudes, times, tolerances=TOLERANCES):
    """Integrate many independent problems; return P (run, time) and H at the first time (run,).

    `constants` holds (epsilon, gamma, Omega) of each run, `boundaries` the name of its ends,
    `amplitudes` its data (2, N). Each run goes by `taylor` on the whole chain. Where a solver
    refuses a run or gives it up, P is infinite at all times after the first: such a run breaks
    every bound, and nothing that is read off it can pass for a number.
    """
    solver, times = {"name": "taylor", **tolerances}, np.asarray(times, float)
    runs = list(zip(constants, boundaries, amplitudes, strict=True))
    powers, energies = np.full((len(runs), len(times)), np.inf), np.empty(len(runs))
    for i, (numbers, boundary, data) in enumerate(runs):
        try:
            trajectory = run(numbers, boundary, data, times, solver)
        except IntegrationError:
            powers[i, 0] = np.sum(np.abs(data) ** 2)
            energies[i] = total_energy(numbers, boundary, data)
        else:
            powers[i], energies[i] = squared_norm(trajectory.l2), trajectory.energy[0]
    return powers, energies


def mean_spacing(count: int, span: float) -> np.ndarray:
    """Return `count` + 1 equal output times from 0 to `span`."""
    return span * np.arange(count + 1) / count


def random_amplitudes(rng: np.random.Generator, sites: int, norm: float) -> np.ndarray:
    """Return complex Gaussian amplitudes (2, N) scaled to the l2 norm `norm` of the pair."""
    drawn = rng.normal(size=(2, sites)) + 1j * rng.normal(size=(2, sites))
    return norm * drawn / np.sqrt(np.sum(np.abs(drawn) ** 2))
