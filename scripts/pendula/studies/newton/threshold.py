"""Lemma 1 for the pendula (1): the threshold gamma_0(mu) of the drive.

Linearised about rest, equations (1) give for the difference z = x - y and each wave number theta

    z'' + (1 + epsilon mu^2 s + 4 gamma mu^2 cos 2 omega t) z = 0,   s = 4 sin^2(theta / 2).

With omega t as time this is Mathieu's equation with a - 1 = mu^2 kappa / omega^2 and
q = 2 |gamma| mu^2 / omega^2, where kappa = epsilon s - Omega as in (14). The sum x + y is not
driven, so the chain at rest is stable if all waves of z are.
"""

from collections.abc import Sequence

import numpy as np
from latticode.datasets.netcdf import Variable
from latticode.datasets.trajectories import Contents
from numpy.typing import ArrayLike
from replication.variables import FEW_CHOICES, REGULAR

from pendula.models.linear_chain import gamma_0

from .mathieu import band_threshold, squared_frequency


def pendula_threshold(omega: ArrayLike, mu: ArrayLike, epsilon: float) -> np.ndarray:
    """Return gamma_0(mu) of the infinite chain of pendula, whose waves have s from 0 to 4.

    It is zero if a wave is at the first resonance of the drive. No wave may be near the second.
    """
    square = squared_frequency(omega, mu) / (mu * mu)
    q = band_threshold(-omega / square, (4.0 * epsilon - omega) / square)
    return 0.5 * square * q


def solve_thresholds(epsilon: float, omegas: Sequence[float], mus: Sequence[float]) -> Contents:
    """Return the dataset of thresholds: of the pendula (omega, mu), and of Lemma 1 (omega,)."""
    omega, mu = np.array(omegas, dtype=float), np.array(mus, dtype=float)
    thresholds = pendula_threshold(omega[:, None], mu, epsilon)
    variables = {
        "omega": Variable(("omega",), omega, attributes=FEW_CHOICES),
        "mu": Variable(("mu",), mu, attributes=FEW_CHOICES),
        "gamma_0": Variable(
            ("omega", "mu"),
            thresholds,
            "gamma_0 of the infinite chain of pendula",
            attributes={"significant_digits": np.finfo(float).precision},
        ),
        "gamma_0_lemma": Variable(
            ("omega",), gamma_0(omega, epsilon), "threshold gamma_0 of Lemma 1"
        ),
    }
    return variables, {"title": "Lemma 1 for the pendula", "epsilon": epsilon, **REGULAR}
