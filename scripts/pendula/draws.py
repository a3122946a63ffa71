"""Random numbers that have the same bits on every machine, from NumPy's generators."""

import numpy as np

from .elementary import complex_of, log


def complex_normal(rng: np.random.Generator, shape) -> np.ndarray:
    """Return complex numbers whose real and imaginary parts are normal."""
    real = rng.normal(size=shape)
    return complex_of(real, rng.normal(size=shape))


def uniform(rng: np.random.Generator, low: float, high: float, size=None):
    """Return uniform numbers; the generator's own scaling may be fused on some processors."""
    return low + (high - low) * rng.random(size)


def exponential(rng: np.random.Generator) -> float:
    """Return an exponential number of mean one."""
    return float(-log(1.0 - rng.random()))
