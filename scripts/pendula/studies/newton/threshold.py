"""Lemma 1 for the pendula (1): the threshold gamma_0(mu) of the drive.

The difference z = x - y of a pair at rest obeys, for each wave number theta of the chain,
z'' + (1 + epsilon mu^2 s + 4 gamma mu^2 cos 2 omega t) z = 0 with s = 4 sin^2(theta / 2): this is
(1) without the cubes and higher powers of its sine. With omega t as time it is Mathieu's equation,
a - 1 = mu^2 kappa / omega^2 and q = 2 |gamma| mu^2 / omega^2, where kappa = epsilon s - Omega as in
(14). The sum x + y is not driven. So the chain at rest is stable while all its waves are.
"""

from collections.abc import Sequence

import numpy as np
from latticode.datasets.netcdf import Variable
from latticode.datasets.trajectories import Contents

from pendula.models.linear_chain import gamma_0

from .mathieu import band_threshold, squared_frequency


def pendula_threshold(omega, mu, epsilon: float) -> np.ndarray:
    """Return gamma_0(mu) of the infinite chain of pendula, on which s covers [0, 4].

    It is zero where a wave is at the first resonance of the drive; none may be near the second.
    """
    square = squared_frequency(omega, mu) / (mu * mu)
    found = band_threshold(-omega / square, (4.0 * epsilon - omega) / square)
    return 0.5 * square * found


def threshold_contents(epsilon: float, omegas: Sequence[float], mus: Sequence[float]) -> Contents:
    """Return thresholds at each of `omegas` and `mus`, and what Lemma 1 says there."""
    omega, mu = np.array(omegas, dtype=float), np.array(mus, dtype=float)
    found = pendula_threshold(omega[:, None], mu, epsilon)
    variables = {
        "omega": Variable(("omega",), omega),
        "mu": Variable(("mu",), mu),
        "gamma_0": Variable(
            ("omega", "mu"),
            found,
            "gamma_0 of the infinite chain of pendula",
            attributes={"significant_digits": np.finfo(float).precision},
        ),
        "gamma_0_lemma": Variable(
            ("omega",), gamma_0(omega, epsilon), "threshold gamma_0 of Lemma 1"
        ),
    }
    return variables, {"title": "Lemma 1 for the pendula", "epsilon": epsilon}
