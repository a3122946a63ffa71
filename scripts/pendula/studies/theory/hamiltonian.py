"""Equations (4) as the Hamiltonian system (7) of the energy (8), and their reduction A = B."""

import numpy as np

from pendula.datasets.checks import table, variable
from pendula.models.linear_flow import curvatures, modes

from .runs import (
    BOUNDARIES,
    mean_spacing,
    random_amplitudes,
    right_hand_side,
    run,
    squared_norm,
    total_energy,
)

EPS = np.finfo(float).eps


def slope(function, point: np.ndarray, direction: np.ndarray) -> float:
    """Return the derivative of a quartic polynomial along `direction`, exact but for rounding.

    The five-point formula has no truncation error up to degree four, so the step can be one and
    nothing cancels.
    """
    f = [function(point + step * direction) for step in (-2, -1, 1, 2)]
    return (8.0 * (f[2] - f[1]) - (f[3] - f[0])) / 12.0


def hamiltonian_rates(constants, boundary: str, amplitudes: np.ndarray) -> np.ndarray:
    """Return -i dH/d(conj A), -i dH/d(conj B) of (7) from values of the energy alone, (2, N)."""
    out = np.zeros_like(amplitudes)
    for index in np.ndindex(amplitudes.shape):
        unit = np.zeros_like(amplitudes)
        unit[index] = 1.0
        by_re = slope(lambda z: total_energy(constants, boundary, z), amplitudes, unit)
        by_im = slope(lambda z: total_energy(constants, boundary, z), amplitudes, 1j * unit)
        out[index] = -0.5j * (by_re + 1j * by_im)
    return out


def check_gradient(constants, sites: int, samples: int = 3, seed: int = 1) -> dict:
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


def check_symmetries(constants, sites: int, end_time: float, seed: int = 2) -> dict:
    """Test the exchange of A and B, the reduction A = B (5), its conserved norm, and its equation.

    All four along trajectories: exchange must hold to the last bit, A = B as well.
    """
    rng = np.random.default_rng(seed)
    times = mean_spacing(8, end_time)
    found = {name: [] for name in ("exchange", "synchrony", "norm_drift", "scalar")}
    for boundary in BOUNDARIES:
        pair = random_amplitudes(rng, sites, 2.0)
        forth = run(constants, boundary, pair, times).final
        back = run(constants, boundary, pair[::-1].copy(), times).final
        alike = np.stack([pair[0], pair[0]])
        both = run(constants, boundary, alike, times)
        norms = squared_norm(both.l2)
        scalar = scalar_run(constants[0], constants[2], boundary, pair[0], end_time)
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
