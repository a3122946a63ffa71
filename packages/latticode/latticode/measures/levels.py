"""Levelling off and range of a curve against a parameter; moments and quantiles of an ensemble."""

from collections.abc import Sequence

import numpy as np

# ASSUME: the paper does not define "approaches a level"; 0.5 % is the width of a printed line.
LEVEL = 5e-3


def levelling(
    half_widths: np.ndarray, values: np.ndarray, tolerance: float = LEVEL, least: int = 3
) -> float:
    """Return the smallest half-width from which on all values agree with the last value.

    `tolerance` is relative. The result is infinite if fewer than `least` values agree; the last
    value always agrees with itself.
    """
    return _first_of_tail(half_widths, np.abs(values / values[-1] - 1.0) <= tolerance, least)


def _first_of_tail(half_widths: np.ndarray, near: np.ndarray, least: int) -> float:
    first = len(near) - int(np.argmin(near[::-1])) if not near.all() else 0
    return float(half_widths[first]) if first <= len(near) - least else np.inf


def relative_range(values: np.ndarray) -> float:
    """Return (max - min) / abs(mean) of the values."""
    return float((np.max(values) - np.min(values)) / abs(np.mean(values)))


def correlation(first: np.ndarray, second: np.ndarray) -> float:
    """Return the correlation coefficient of two series (time,); 0 if one of them is constant."""
    first, second = first - first.mean(), second - second.mean()
    scale = np.sqrt((first * first).mean() * (second * second).mean())
    return float((first * second).mean() / scale) if scale > 0 else 0.0


def bands(norms: np.ndarray, quantiles: Sequence[float]) -> np.ndarray:
    """Return the quantiles of `norms` (member, ...) over the members, shape (quantile, ...)."""
    return np.quantile(norms, quantiles, axis=0)


def moments(values: np.ndarray) -> dict[str, np.ndarray]:
    """Return mean, standard deviation and standard error of `values` (member, ...) over members."""
    deviation = values.std(axis=0, ddof=1)
    return {
        "mean": values.mean(axis=0),
        "deviation": deviation,
        "error": deviation / np.sqrt(len(values)),
    }
