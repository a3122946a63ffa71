"""Measures of a curve against a parameter, and of an ensemble: levels, ranges, means."""

import numpy as np

# ASSUME: the paper gives no measure of "approaches a level"; half a percent is a line's width.
LEVEL = 5e-3


def levelling(
    half_widths: np.ndarray, values: np.ndarray, tolerance: float = LEVEL, least: int = 3
) -> float:
    """Return the half-width from which all values equal the last one to `tolerance`.

    It is infinite if fewer than `least` values agree, since the last value agrees with itself.
    """
    return _first_of_tail(half_widths, np.abs(values / values[-1] - 1.0) <= tolerance, least)


def _first_of_tail(half_widths: np.ndarray, near: np.ndarray, least: int) -> float:
    first = len(near) - int(np.argmin(near[::-1])) if not near.all() else 0
    return float(half_widths[first]) if first <= len(near) - least else np.inf


def relative_range(values: np.ndarray) -> float:
    """Return the range of the values over their mean."""
    return float((np.max(values) - np.min(values)) / abs(np.mean(values)))


def correlation(first: np.ndarray, second: np.ndarray) -> float:
    """Return the correlation of two series (time,); 0 where one does not change."""
    first, second = first - first.mean(), second - second.mean()
    scale = np.sqrt((first * first).mean() * (second * second).mean())
    return float((first * second).mean() / scale) if scale > 0 else 0.0


def bands(norms: np.ndarray, quantiles) -> np.ndarray:
    """Return the quantiles over the members of (member, ...), shape (quantile, ...)."""
    return np.quantile(norms, quantiles, axis=0)


def moments(values: np.ndarray) -> dict[str, np.ndarray]:
    """Return the mean, standard deviation and standard error over the members of (member, ...)."""
    deviation = values.std(axis=0, ddof=1)
    return {
        "mean": values.mean(axis=0),
        "deviation": deviation,
        "error": deviation / np.sqrt(len(values)),
    }
