"""Random tangent vectors, even or odd in n; apart from kernels, which their users may not need."""

import numpy as np

from pendula.numerics.draws import complex_normal

PARITIES = ("even", "odd")


def random_tangent(sites: int, parity: str | None, rng: np.random.Generator) -> np.ndarray:
    """Return complex Gaussian amplitudes (2, N), of the parity asked for to the last bit."""
    z = complex_normal(rng, (2, sites))
    return {None: z, "even": z + z[:, ::-1], "odd": z - z[:, ::-1]}[parity]
