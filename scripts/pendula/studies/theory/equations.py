"""Equations (4) on complex amplitudes: as the Hamiltonian system (7), reduced to A = B, conserved.

Short runs of the checks start here too. Their solver is dop853 at tolerances so tight that no
check measures it instead of the paper.
"""

from collections.abc import Mapping, Sequence

import numpy as np

from pendula.datasets.checks import table, variable
from pendula.models.amplitudes import ENDS, energy, rates
from pendula.models.linear_chain import curvatures, modes
from pendula.problem import Constants, Problem
from pendula.simulation.lattice import WHOLE, pack, unpack
from pendula.simulation.simulate import IntegrationError, Trajectory, make_chain, simulate

EPS = np.finfo(float).eps
BOUNDARIES = tuple(ENDS)
TOLERANCES = {"rtol": 1e-12, "atol": 1e-14}
TIGHT = {"name": "dop853", **TOLERANCES}


def run(
    constants: Constants,
    boundary: str,
    amplitudes: np.ndarray,
    end_time: float,
    outputs: int = 1,
    solver: Mapping = TIGHT,
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
    """Return (dA/dtau, dB/dtau), shape (2, N), as the library computes them."""
    y = pack(amplitudes, WHOLE)
    dy = np.zeros_like(y)
    rates(make_chain(constants, boundary, WHOLE), y, dy)
    return unpack(dy, WHOLE)


def total_energy(constants: Constants, boundary: str, amplitudes: np.ndarray) -> float:
    """Return H of equation (8) for amplitudes (2, N), as the library computes it."""
    return float(energy(make_chain(constants, boundary, WHOLE), pack(amplitudes, WHOLE)))


def squared_norm(l2: np.ndarray) -> np.ndarray:
    """Return P = |A|^2 + |B|^2 in l2 from the norms of A and B along the first axis."""
    return l2[0] ** 2 + l2[1] ** 2


def run_powers(
    constants: Sequence[Constants],
    boundaries: Sequence[str],
    amplitudes: Sequence[np.ndarray],
    end_time: float,
    outputs: int,
    tolerances: Mapping[str, float] = TOLERANCES,
) -> tuple[np.ndarray, np.ndarray]:
    """Integrate many independent problems; return P (run, 1 + output) and H at the start (run,).

    Constants, ends and data (2, N) are given for each run. Each goes by `taylor` on the whole
    chain. Where a solver refuses a run or gives it up, P is infinite at all times after the first:
    such a run breaks every bound, and nothing that is read off it can pass for a number.
    """
    solver = {"name": "taylor", **tolerances}
    runs = list(zip(constants, boundaries, amplitudes, strict=True))
    powers, energies = np.full((len(runs), outputs + 1), np.inf), np.empty(len(runs))
    for i, (own, boundary, data) in enumerate(runs):
        try:
            trajectory = run(own, boundary, data, end_time, outputs, solver)
        except IntegrationError:
            powers[i, 0] = np.sum(np.abs(data) ** 2)
            energies[i] = total_energy(own, boundary, data)
        else:
            powers[i], energies[i] = squared_norm(trajectory.l2), trajectory.energy[0]
    return powers, energies


def random_amplitudes(rng: np.random.Generator, sites: int, norm: float) -> np.ndarray:
    """Return complex Gaussian amplitudes (2, N) scaled to the l2 norm `norm` of the pair."""
    drawn = rng.normal(size=(2, sites)) + 1j * rng.normal(size=(2, sites))
    return norm * drawn / np.sqrt(np.sum(np.abs(drawn) ** 2))


def draw_shape(rng: np.random.Generator, sites: int) -> np.ndarray:
    """Return amplitudes (2, N) of norm one: from a single pair to the whole chain, any phases."""
    reach = rng.choice([0.0, 0.5, 1.5, 1e9])
    distance = np.abs(np.arange(sites) - rng.integers(sites))
    envelope = np.where(distance <= reach, 1.0, 0.0) if reach < 1 else np.exp(-distance / reach)
    drawn = envelope * (rng.normal(size=(2, sites)) + 1j * rng.normal(size=(2, sites)))
    if rng.random() < 0.5:
        drawn[1] = -drawn[0]  # the subspace that the drive acts on
    return drawn / np.sqrt(np.sum(np.abs(drawn) ** 2))


def slope(function, point: np.ndarray, direction: np.ndarray) -> float:
    """Return the derivative of a quartic polynomial along `direction`, exact but for rounding.

    The five-point formula has no truncation error up to degree four, so the step can be one and
    nothing cancels.
    """
    f = [function(point + step * direction) for step in (-2, -1, 1, 2)]
    return (8.0 * (f[2] - f[1]) - (f[3] - f[0])) / 12.0


def hamiltonian_rates(constants: Constants, boundary: str, amplitudes: np.ndarray) -> np.ndarray:
    """Return -i dH/d(conj A), -i dH/d(conj B) of (7) from values of the energy alone, (2, N)."""
    out = np.zeros_like(amplitudes)
    for index in np.ndindex(amplitudes.shape):
        unit = np.zeros_like(amplitudes)
        unit[index] = 1.0
        by_re = slope(lambda z: total_energy(constants, boundary, z), amplitudes, unit)
        by_im = slope(lambda z: total_energy(constants, boundary, z), amplitudes, 1j * unit)
        out[index] = -0.5j * (by_re + 1j * by_im)
    return out


def check_gradient(constants: Constants, sites: int, samples: int, seed: int) -> dict:
    """Compare the right-hand side with the energy's gradient for each kind of ends.

    The tolerance is what rounding in the energy allows: some tens of units in its last place.
    """
    rng = np.random.default_rng(seed)
    errors = np.zeros((len(BOUNDARIES), samples))
    for row, boundary in enumerate(BOUNDARIES):
        for sample in range(samples):
            amplitudes = random_amplitudes(rng, sites, np.sqrt(2.0 * sites))
            expected = hamiltonian_rates(constants, boundary, amplitudes)
            found = right_hand_side(constants, boundary, amplitudes)
            energy = abs(total_energy(constants, boundary, amplitudes)) + np.abs(found).max()
            errors[row, sample] = np.abs(found - expected).max() / energy
    dims = ("boundary", "sample")
    return table(
        "Right-hand side of (4) against the gradient (7) of the energy (8)",
        {"boundary": list(BOUNDARIES), "sample": np.arange(samples)},
        error=variable(errors, dims, "largest difference over the energy", tolerance=50 * EPS),
    )


def scalar_run(epsilon: float, omega: float, boundary: str, a: np.ndarray, end_time: float):
    """Integrate the scalar dNLS i a' = epsilon Lap a + Omega a + |a|^2 a / 2, written apart.

    Fourth-order Strang composition (Suzuki): the exact linear flow of every mode and the exact
    rotation of the phase, so that the l2 norm is kept but for rounding.
    """
    basis = modes(len(a), boundary)
    kappa = epsilon * curvatures(len(a), boundary) - omega
    outer = 1.0 / (4.0 - 4.0 ** (1.0 / 3.0))
    count = 100 * max(1, int(np.ceil(end_time)))
    for _ in range(count):
        for part in (outer, outer, 1.0 - 4.0 * outer, outer, outer):
            h = part * end_time / count
            a = a * np.exp(-0.25j * h * np.abs(a) ** 2)
            a = basis.T @ (np.exp(1j * kappa * h) * (basis @ a))
            a = a * np.exp(-0.25j * h * np.abs(a) ** 2)
    return a


def check_symmetries(constants: Constants, sites: int, end_time: float, seed: int) -> dict:
    """Test the exchange of A and B, the reduction A = B (5), its conserved norm, and its equation.

    All four along trajectories: exchange must hold to the last bit, A = B as well.
    """
    rng = np.random.default_rng(seed)
    found = {name: [] for name in ("exchange", "synchrony", "norm_drift", "scalar")}
    for boundary in BOUNDARIES:
        pair = random_amplitudes(rng, sites, 2.0)
        forth = run(constants, boundary, pair, end_time, 8).final
        back = run(constants, boundary, pair[::-1].copy(), end_time, 8).final
        alike = np.stack([pair[0], pair[0]])
        both = run(constants, boundary, alike, end_time, 8)
        norms = squared_norm(both.l2)
        scalar = scalar_run(constants.epsilon, constants.omega, boundary, pair[0], end_time)
        found["exchange"].append(np.abs(forth - back[::-1]).max())
        found["synchrony"].append(np.abs(both.final[0] - both.final[1]).max())
        found["norm_drift"].append(np.abs(norms / norms[0] - 1.0).max())
        found["scalar"].append(np.abs(both.final[0] - scalar).max())
    dims = ("boundary",)
    return table(
        "Exchange of A and B, and the invariant reduction A = B (5)",
        {"boundary": list(BOUNDARIES)},
        exchange=variable(found["exchange"], dims, "change under A <-> B", tolerance=0.0),
        synchrony=variable(found["synchrony"], dims, "|A - B| from A = B", tolerance=0.0),
        norm_drift=variable(
            found["norm_drift"], dims, "relative drift of l2 on A = B", tolerance=1e-10
        ),
        scalar=variable(found["scalar"], dims, "distance to the scalar dNLS", tolerance=1e-7),
    )


def gauge_defect(
    constants: Constants, boundary: str, amplitudes: np.ndarray, angle: float = 0.7
) -> float:
    """Return how far turning all phases by `angle` is from a symmetry of the right-hand side."""
    turn = np.exp(1j * angle)
    rates = right_hand_side(constants, boundary, amplitudes)
    return float(
        np.abs(right_hand_side(constants, boundary, turn * amplitudes) - turn * rates).max()
    )


def check_conservation(
    gamma: float, epsilon: float, omegas, sites: int, end_time: float, seed: int
) -> dict:
    """Follow H and the l2 norm from random data, and turn the phase, for each kind of ends."""
    rng = np.random.default_rng(seed)
    shape = (len(BOUNDARIES), len(omegas))
    drift, change, defect = np.zeros(shape), np.zeros(shape), np.zeros(shape)
    for i, boundary in enumerate(BOUNDARIES):
        for j, omega in enumerate(omegas):
            constants = Constants(epsilon=epsilon, gamma=gamma, omega=omega)
            start = random_amplitudes(rng, sites, 2.0)
            trajectory = run(constants, boundary, start, end_time, 50)
            power = squared_norm(trajectory.l2)
            drift[i, j] = np.abs(trajectory.energy - trajectory.energy[0]).max()
            change[i, j] = np.abs(power / power[0] - 1.0).max()
            defect[i, j] = gauge_defect(constants, boundary, start)
    dims = ("boundary", "omega")
    return table(
        "What is conserved along the flow",
        {"boundary": list(BOUNDARIES), "omega": np.asarray(omegas, float)},
        energy_drift=variable(drift, dims, "largest |H - H(0)|", tolerance=1e-7),
        l2_change=variable(change, dims, "largest relative change of the squared l2 norm"),
        gauge_defect=variable(defect, dims, "defect of turning all phases"),
    )
