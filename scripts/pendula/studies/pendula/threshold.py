"""Lemma 1 for the pendula (1): the threshold gamma_0(mu) of the drive, and rates of growth.

The difference z = x - y of a pair at rest obeys, for each wave number theta of the chain,
z'' + (1 + epsilon mu^2 s + 4 gamma mu^2 cos 2 omega t) z = 0 with s = 4 sin^2(theta / 2): this is
(1) without the cubes and higher powers of its sine. With omega t as time it is Mathieu's equation,
a - 1 = mu^2 kappa / omega^2 and q = 2 |gamma| mu^2 / omega^2, where kappa = epsilon s - Omega as in
(14). The sum x + y is not driven. So the chain at rest is stable while all its waves are.
"""

from collections.abc import Sequence

import numpy as np

from pendula.datasets.netcdf import Variable
from pendula.datasets.trajectories import Contents
from pendula.models.linear_chain import curvatures, finite_threshold, gamma_0, growth_rate

from .mathieu import band_threshold, growth, squared_frequency, wave_threshold


def pendula_threshold(omega, mu, epsilon: float) -> np.ndarray:
    """Return gamma_0(mu) of the infinite chain of pendula, on which s covers [0, 4].

    It is zero where a wave is at a resonance of the drive, and NaN where all waves lie above the
    second one.
    """
    square = squared_frequency(omega, mu) / (mu * mu)
    found = band_threshold(-omega / square, (4.0 * epsilon - omega) / square)
    return 0.5 * square * found


def finite_pendula_threshold(omega, mu, epsilon: float, sites: int) -> np.ndarray:
    """Return the same of a chain of N sites with Dirichlet ends, on which s has N values."""
    omega, mu = np.broadcast_arrays(omega, mu)
    square = (squared_frequency(omega, mu) / (mu * mu))[..., None]
    offset = (epsilon * curvatures(sites, "dirichlet") - omega[..., None]) / square
    known = offset < 3.0
    found = np.where(known, wave_threshold(np.where(known, offset, 0.0)), np.nan)
    return (0.5 * square * found).min(axis=-1)


def second_resonance(mu, epsilon: float) -> tuple[np.ndarray, np.ndarray]:
    """Return the least and the largest Omega at which a wave has the frequency of the drive.

    There 1 + epsilon mu^2 s = 4 omega^2 for an s in [0, 4], and any drive makes the wave unstable.
    """
    largest = epsilon - 0.75 / (np.asarray(mu) * np.asarray(mu))
    return largest - epsilon, largest


def correction(omega, epsilon: float) -> np.ndarray:
    """Return the coefficient of mu^2 in gamma_0(mu): gamma_0^2 / 4, with a minus above the band.

    The edges of the first tongue are a - 1 = +-q - q^2 / 8 + ..., by (28.6.2) and (28.6.3) of the
    NIST Digital Library of Mathematical Functions: both bend to one side.
    """
    lemma = gamma_0(omega, epsilon)
    return np.where(np.asarray(omega) > 0.0, -0.25, 0.25) * lemma * lemma


def next_correction(omega, epsilon: float) -> np.ndarray:
    """Return the coefficient of mu^4 in gamma_0(mu), from the same series one order further."""
    lemma = gamma_0(omega, epsilon)
    shift = np.where(np.asarray(omega) > 0.0, epsilon, 0.0)
    return lemma * lemma * (0.6875 * lemma + shift)


def fastest_curvature(omega, epsilon: float) -> np.ndarray:
    """Return the s in [0, 4] whose wave is the nearest to the resonance, |kappa| least."""
    return np.clip(np.asarray(omega) / epsilon, 0.0, 4.0)


def pendula_rate(omega, mu, gamma, epsilon: float) -> np.ndarray:
    """Return how fast the wave nearest to the resonance grows, per unit of tau."""
    square = squared_frequency(omega, mu) / (mu * mu)
    kappa = epsilon * fastest_curvature(omega, epsilon) - omega
    per_theta = growth(kappa / square, 2.0 * np.abs(gamma) / square)
    return 2.0 * np.sqrt(squared_frequency(omega, mu)) / (mu * mu) * per_theta


# --- The dataset ----------------------------------------------------------------------------------


def threshold_contents(
    epsilon: float, omegas: Sequence[float], mus: Sequence[float], half_width: int,
    growth_omegas: Sequence[float], gammas: Sequence[float], curve_omegas: Sequence[float],
) -> Contents:  # fmt: skip
    """Return thresholds at `omegas`, rates at `growth_omegas` and `gammas`, and curves to draw."""
    omega, mu = np.array(omegas, dtype=float), np.array(mus, dtype=float)
    sites, grid = 2 * half_width + 1, (omega[:, None], mu[None, :])
    lemma, curve = gamma_0(omega, epsilon), np.array(curve_omegas, dtype=float)
    driven, gamma = np.array(growth_omegas, dtype=float), np.array(gammas, dtype=float)
    kappa = epsilon * fastest_curvature(driven, epsilon) - driven
    resonance, waves = second_resonance(mu, epsilon), "Omega at which waves have"
    both, over = ("omega", "mu"), ("growth_omega", "mu", "gamma")
    variables = {
        "omega": Variable(("omega",), omega),
        "mu": Variable(("mu",), mu),
        "gamma_0": Variable(both, pendula_threshold(*grid, epsilon),
                            "threshold of the drive for the infinite chain of pendula",
                            attributes={"significant_digits": np.finfo(float).precision}),
        "gamma_0_finite": Variable(both, finite_pendula_threshold(*grid, epsilon, sites),
                                   "threshold of the drive for the finite chain of pendula"),
        "gamma_0_lemma": Variable(("omega",), lemma, "threshold gamma_0 of Lemma 1"),
        "gamma_0_lemma_finite": Variable(
            ("omega",), finite_threshold(omega, epsilon, sites, "dirichlet"),
            "threshold of the finite chain of amplitudes"),
        "correction": Variable(("omega",), correction(omega, epsilon),
                               "coefficient of mu^2 in the threshold of the pendula"),
        "next_correction": Variable(("omega",), next_correction(omega, epsilon),
                                    "coefficient of mu^4 in the threshold of the pendula"),
        "resonance_low": Variable(("mu",), resonance[0], f"least {waves} the drive's frequency"),
        "resonance_high": Variable(("mu",), resonance[1], f"largest {waves} the drive's frequency"),
        "growth_omega": Variable(("growth_omega",), driven, "detuning Omega of rates of growth"),
        "gamma": Variable(("gamma",), gamma),
        "wave_rate": Variable(
            over, pendula_rate(driven[:, None, None], mu[:, None], gamma, epsilon),
            "rate of growth of the pendula's wave nearest to the resonance, per unit of tau"),
        "rate_lemma": Variable(
            ("growth_omega", "gamma"), growth_rate(kappa[:, None], gamma),
            "rate of growth of the same wave by Lemma 1, per unit of tau"),
        "curve_omega": Variable(("curve_omega",), curve),
        "curve_gamma_0": Variable(("curve_omega", "mu"),
                                  pendula_threshold(curve[:, None], mu, epsilon),
                                  "threshold of the pendula on a finer grid"),
        "curve_gamma_0_lemma": Variable(("curve_omega",), gamma_0(curve, epsilon),
                                        "threshold of Lemma 1 on a finer grid"),
    }  # fmt: skip
    about = {"title": "Lemma 1 for the pendula", "epsilon": epsilon, "sites": sites}
    return variables, about | {"boundary": "dirichlet"}
