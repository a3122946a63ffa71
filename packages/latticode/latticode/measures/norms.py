"""Power P, largest amplitude and energy drift of one run, from its norms and its energy."""

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike

from latticode.numerics.elementary import square_modulus

if TYPE_CHECKING:
    import xarray as xr


def power_of(amplitudes: np.ndarray) -> float:
    """Return the power P of amplitudes (2, site): the sum of |A|^2 + |B|^2 over all sites."""
    return float(np.sum(square_modulus(amplitudes)))


def total_power(trajectory: "xr.Dataset") -> np.ndarray:
    """Return the power P (time,) of a stored trajectory: the sum of its squared l2 norms."""
    return (trajectory["l2"] ** 2).sum("component").values


def largest(trajectory: "xr.Dataset") -> np.ndarray:
    """Return the larger of the l-infinity norms of A and B of a stored trajectory, (time,)."""
    return trajectory["linf"].max("component").values


def drift(energy: ArrayLike) -> np.ndarray:
    """Return the conservation error abs(H(tau) - H(0)) of an `energy` (..., time), same shape.

    ASSUME: the paper does not specify whether its drift is this difference or relative to H(0).
    """
    energy = np.asarray(energy, dtype=float)
    return np.abs(energy - energy[..., :1])
