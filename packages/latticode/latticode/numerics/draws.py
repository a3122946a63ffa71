"""Random numbers that have the same bits on every machine, from NumPy's generators."""

import numpy as np

from .elementary import complex_of, log


def normal(rng: np.random.Generator, size) -> np.ndarray:
    """Return standard normal draws of NumPy, those of its tail rounded to 40 binary places.

    NumPy takes the values of the tail from the C library's log1p. Its exp decides only
    whether a few draws are kept, and a last bit turns such a decision as good as never.
    """
    drawn = rng.normal(size=size)
    return np.where(np.abs(drawn) > 3.65, np.ldexp(np.rint(np.ldexp(drawn, 40)), -40), drawn)


def complex_normal(rng: np.random.Generator, shape) -> np.ndarray:
    """Return complex numbers whose real and imaginary parts are normal."""
    return complex_of(normal(rng, shape), normal(rng, shape))


def uniform(rng: np.random.Generator, low: float, high: float, size=None):
    """Return uniform numbers; the generator's own scaling may be fused on some processors."""
    return low + (high - low) * rng.random(size)


def exponential(rng: np.random.Generator) -> float:
    """Return an exponential number of mean one."""
    return float(-log(1.0 - rng.random()))
