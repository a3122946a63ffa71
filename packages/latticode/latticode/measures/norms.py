"""Measures of one run, from its norms and its energy: P, largest amplitude, drift."""

import numpy as np

from latticode.numerics.elementary import square_modulus


def power_of(amplitudes: np.ndarray) -> float:
    """Return P = |A|^2 + |B|^2 in l2 of amplitudes (2, N)."""
    return float(np.sum(square_modulus(amplitudes)))


def total_power(trajectory) -> np.ndarray:
    """Return P = |A|^2 + |B|^2, the squared l2 norm of the pair, at all times."""
    return (trajectory["l2"] ** 2).sum("component").values


def largest(trajectory) -> np.ndarray:
    """Return the l-infinity norm of the pair at all times."""
    return trajectory["linf"].max("component").values


def drift(energy) -> np.ndarray:
    """Return abs(H(tau) - H(0)) at each time of an energy (..., time): the error of conservation.

    The paper does not say whether it means this or the part of H(0) that it is.
    """
    energy = np.asarray(energy, dtype=float)
    return np.abs(energy - energy[..., :1])
