"""Random numbers that have the same bits on every machine, from NumPy's generators."""

import numpy as np

from .elementary import complex_of, log


def normal(rng: np.random.Generator, size: int | tuple[int, ...] | None) -> np.ndarray:
    """Return standard normal numbers of shape `size`.

    Moduli above 3.65 are rounded to 40 binary places, because NumPy computes them with the C
    library's log1p, and the last bit of log1p depends on the machine. NumPy also uses the C
    library's exp to accept or reject a few draws; a last bit hardly ever changes the decision.
    """
    drawn = rng.normal(size=size)
    return np.where(np.abs(drawn) > 3.65, np.ldexp(np.rint(np.ldexp(drawn, 40)), -40), drawn)


def complex_normal(rng: np.random.Generator, shape: int | tuple[int, ...]) -> np.ndarray:
    """Return complex numbers whose real and imaginary parts are standard normal."""
    return complex_of(normal(rng, shape), normal(rng, shape))


def uniform(
    rng: np.random.Generator, low: float, high: float, size: int | tuple[int, ...] | None = None
) -> np.ndarray | float:
    """Return uniform numbers in [low, high); `rng.uniform` fuses operations on some processors."""
    return low + (high - low) * rng.random(size)


def exponential(rng: np.random.Generator) -> float:
    """Return one exponentially distributed number with mean 1."""
    return float(-log(1.0 - rng.random()))
