"""Measures of one run, from its norms and its energy: P, largest amplitude, drift, margin."""

import numpy as np

from pendula.numerics.elementary import exp, log, square_modulus
from pendula.problem import Constants


def power_of(amplitudes: np.ndarray) -> float:
    """Return P = |A|^2 + |B|^2 in l2 of amplitudes (2, N)."""
    return float(np.sum(square_modulus(amplitudes)))


def total_power(trajectory) -> np.ndarray:
    """Return P = |A|^2 + |B|^2, the squared l2 norm of the pair, at all times."""
    return (trajectory["l2"] ** 2).sum("component").values


def largest(trajectory) -> np.ndarray:
    """Return the l-infinity norm of the pair at all times."""
    return trajectory["linf"].max("component").values


def constants(dataset) -> Constants:
    """Return the constants of a trajectory or a sweep."""
    return Constants.of(dataset.attrs)


def drift(energy) -> np.ndarray:
    """Return abs(H(tau) - H(0)) at each time of an energy (..., time): the error of conservation.

    The paper does not say whether it means this or the part of H(0) that it is.
    """
    energy = np.asarray(energy, dtype=float)
    return np.abs(energy - energy[..., :1])


def growth_margin(tau: np.ndarray, l2: np.ndarray, gamma: float) -> dict[str, float]:
    """Return how close a trajectory with norms `l2`, shape (2, time), comes to the bound (19).

    `from_start`: largest P(tau) / (P(0) e^{4 |gamma| tau}) over tau > 0; `backwards`: the same
    seen from the end; `steepest`: largest |change of log P| over 4 |gamma| times its duration,
    one for any pair of times at the bound. All must be at most one.
    """
    rise = log(np.sum(np.asarray(l2) ** 2, axis=0))
    allowed = 4.0 * abs(gamma) * np.asarray(tau, dtype=float)
    forth = (rise - rise[0]) - (allowed - allowed[0])
    back = (rise - rise[-1]) - (allowed[-1] - allowed)
    steps = np.abs(np.diff(rise))
    bound = np.diff(allowed)
    unbounded = np.where(steps > 0, np.inf, 0.0)  # without a drive P may not move at all
    steepest = np.where(bound > 0, steps / np.where(bound > 0, bound, 1.0), unbounded)
    return {
        "from_start": float(exp(forth[1:].max())),
        "backwards": float(exp(back[:-1].max())),
        "steepest": float(steepest.max()),
    }
