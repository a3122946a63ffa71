"""Random numbers that have the same bits on every machine, from NumPy's generators."""

import numpy as np

from .elementary import complex_of, log


def normal(rng: np.random.Generator, size: int | tuple[int, ...] | None) -> np.ndarray:
    """Return standard normal numbers of shape `size`; beyond 3.65 rounded to 40 binary places.

    NumPy computes the tail with the C library's log1p, whose last bit depends on the machine. It
    also uses the C library's exp, but only to accept or reject a few draws, which a last bit hardly
    ever changes.
    """
    drawn = rng.normal(size=size)
    return np.where(np.abs(drawn) > 3.65, np.ldexp(np.rint(np.ldexp(drawn, 40)), -40), drawn)


def complex_normal(rng: np.random.Generator, shape: int | tuple[int, ...]) -> np.ndarray:
    """Return complex numbers whose real and imaginary parts are standard normal."""
    return complex_of(normal(rng, shape), normal(rng, shape))


def uniform(
    rng: np.random.Generator, low: float, high: float, size: int | tuple[int, ...] | None = None
) -> np.ndarray | float:
    """Return uniform numbers in [low, high); `rng.uniform` is fused on some processors."""
    return low + (high - low) * rng.random(size)


def exponential(rng: np.random.Generator) -> float:
    """Return one exponentially distributed number of mean 1."""
    return float(-log(1.0 - rng.random()))
