"""Growth laws: the power of tau that a series follows, with its error."""

from itertools import pairwise
from typing import NamedTuple

import numpy as np

POINTS = 60
"""Points of a fit, equally spaced in log tau, so that no decade of time outweighs another."""


class Power(NamedTuple):
    """values ~ tau^exponent, with the standard error of the exponent."""

    exponent: float
    error: float


def slope(tau: np.ndarray, values: np.ndarray, start: float) -> float:
    """Return the slope of log values over log tau from `start` on."""
    x, y = _log_points(tau, values, start)
    return float(np.polyfit(x, y, 1)[0])


def fit_power(tau: np.ndarray, values: np.ndarray, start: float) -> Power:
    """Return the power of values (member, time) from `start` on.

    Its error is that of the mean over the members; of one member, that of a block bootstrap.
    """
    slopes = np.array([slope(tau, series, start) for series in values])
    if len(slopes) > 1:
        return Power(slopes.mean(), slopes.std(ddof=1) / np.sqrt(len(slopes)))
    return Power(slopes[0], bootstrap_error(tau, values[0], start))


def fit_rise(tau: np.ndarray, values: np.ndarray, start: float) -> Power:
    """Return what the members' values gain per unit of log tau, with its error over members."""
    x = np.linspace(np.log(start), np.log(tau[-1]), POINTS)
    kept = tau > 0
    drawn = [np.interp(x, np.log(tau[kept]), series[kept]) for series in values]
    slopes = np.polyfit(x, np.array(drawn).T, 1)[0]
    error = slopes.std(ddof=1) / np.sqrt(len(slopes)) if len(slopes) > 1 else np.inf
    return Power(float(slopes.mean()), float(error))


def bootstrap_error(
    tau: np.ndarray, values: np.ndarray, start: float, blocks: int = 10, draws: int = 400
) -> float:
    """Return the standard error of a slope, its residuals redrawn in blocks that keep memory."""
    x, y = _log_points(tau, values, start)
    line = np.polyval(np.polyfit(x, y, 1), x)
    residuals = (y - line).reshape(blocks, -1)
    rng = np.random.default_rng(2017)
    chosen = rng.integers(blocks, size=(draws, blocks))
    return float(np.polyfit(x, (line + residuals[chosen].reshape(draws, -1)).T, 1)[0].std())


def local_powers(tau: np.ndarray, values: np.ndarray, octaves: int) -> tuple[np.ndarray, list]:
    """Return the middles of the last octaves of time, and the Power of each."""
    edges = tau[-1] * 0.5 ** np.arange(octaves, -1, -1)
    powers = []
    for first, last in pairwise(edges):
        kept = tau <= last * (1.0 + 1e-9)
        powers.append(fit_power(tau[kept], values[:, kept], first))
    return np.sqrt(edges[:-1] * edges[1:]), powers


def _log_points(tau: np.ndarray, values: np.ndarray, start: float):
    x = np.linspace(np.log(max(start, tau[tau > 0][0])), np.log(tau[-1]), POINTS)
    return x, np.interp(x, np.log(tau[tau > 0]), np.log(values[tau > 0]))
