"""What the flow keeps and what it does not: the energy, the l2 norm, the phase."""

import numpy as np

from pendula.datasets.checks import table, variable

from .runs import BOUNDARIES, mean_spacing, random_amplitudes, right_hand_side, run, squared_norm


def gauge_defect(constants, boundary: str, amplitudes: np.ndarray, angle: float = 0.7) -> float:
    """Return how far turning all phases by `angle` is from a symmetry of the right-hand side."""
    turn = np.exp(1j * angle)
    rates = right_hand_side(constants, boundary, amplitudes)
    return float(
        np.abs(right_hand_side(constants, boundary, turn * amplitudes) - turn * rates).max()
    )


def check_conservation(
    gamma: float, epsilon: float, omegas, sites: int, end_time: float, seed: int = 13
) -> dict:
    """Follow H and the l2 norm from random data, and turn the phase, for each kind of ends."""
    rng = np.random.default_rng(seed)
    times = mean_spacing(50, end_time)
    shape = (len(BOUNDARIES), len(omegas))
    drift, change, defect = np.zeros(shape), np.zeros(shape), np.zeros(shape)
    for i, boundary in enumerate(BOUNDARIES):
        for j, omega in enumerate(omegas):
            constants = (epsilon, gamma, omega)
            start = random_amplitudes(rng, sites, 2.0)
            trajectory = run(constants, boundary, start, times)
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
