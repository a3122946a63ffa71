"""Growth: exponents of power laws and of tangent vectors, with their errors; what is chaotic."""

from itertools import pairwise
from typing import NamedTuple

import numpy as np

POINTS = 60
"""Points of a fit, equally spaced in log tau, so that no decade of time outweighs another."""

MANY = np.log(100.0)
"""The logarithm of a growth over the second half of a run that no power law reaches: tau^6 grows by
a factor of 64."""
ERRORS = 3.0
"""A growth must exceed MANY by so many standard errors."""
PARTS = 8


class Exponent(NamedTuple):
    """values ~ tau^value, with the standard error of the exponent."""

    value: float
    error: float


def slope(tau: np.ndarray, values: np.ndarray, start: float) -> float:
    """Return the slope of log values over log tau from `start` on."""
    x, y = _log_points(tau, values, start)
    return float(np.polyfit(x, y, 1)[0])


def fit_exponent(tau: np.ndarray, values: np.ndarray, start: float) -> Exponent:
    """Return the exponent of tau that values (member, time) follow from `start` on.

    Its error is the standard error of the mean over the members, or that of a block bootstrap if
    there is only one member.
    """
    slopes = np.array([slope(tau, series, start) for series in values])
    if len(slopes) > 1:
        return Exponent(slopes.mean(), slopes.std(ddof=1) / np.sqrt(len(slopes)))
    return Exponent(slopes[0], bootstrap_error(tau, values[0], start))


def fit_rise(tau: np.ndarray, values: np.ndarray, start: float) -> Exponent:
    """Return the mean slope of the members' values over log tau, and its standard error."""
    x = np.linspace(np.log(start), np.log(tau[-1]), POINTS)
    kept = tau > 0
    drawn = [np.interp(x, np.log(tau[kept]), series[kept]) for series in values]
    slopes = np.polyfit(x, np.array(drawn).T, 1)[0]
    error = slopes.std(ddof=1) / np.sqrt(len(slopes)) if len(slopes) > 1 else np.inf
    return Exponent(float(slopes.mean()), float(error))


def bootstrap_error(
    tau: np.ndarray, values: np.ndarray, start: float, blocks: int = 10, draws: int = 400
) -> float:
    """Return the standard error of a slope by a block bootstrap of its residuals.

    Blocks keep the correlation of neighbouring residuals.
    """
    x, y = _log_points(tau, values, start)
    line = np.polyval(np.polyfit(x, y, 1), x)
    residuals = (y - line).reshape(blocks, -1)
    rng = np.random.default_rng(2017)
    chosen = rng.integers(blocks, size=(draws, blocks))
    return float(np.polyfit(x, (line + residuals[chosen].reshape(draws, -1)).T, 1)[0].std())


def local_exponents(tau: np.ndarray, values: np.ndarray, octaves: int) -> tuple[np.ndarray, list]:
    """Return the middle time of each of the last octaves, and the Exponent there."""
    edges = tau[-1] * 0.5 ** np.arange(octaves, -1, -1)
    found = []
    for first, last in pairwise(edges):
        kept = tau <= last * (1.0 + 1e-9)
        found.append(fit_exponent(tau[kept], values[:, kept], first))
    return np.sqrt(edges[:-1] * edges[1:]), found


def _log_points(tau: np.ndarray, values: np.ndarray, start: float):
    x = np.linspace(np.log(max(start, tau[tau > 0][0])), np.log(tau[-1]), POINTS)
    return x, np.interp(x, np.log(tau[tau > 0]), np.log(values[tau > 0]))


def mean_rate(tau: np.ndarray, log_growth: np.ndarray, start: float) -> np.ndarray:
    """Return the mean rate of growth from `start` to the end, of log_growth (..., time).

    For a tangent vector it is a Lyapunov exponent, per unit of tau.
    """
    first = int(np.searchsorted(tau, start))
    span = tau[-1] - tau[first]
    return (log_growth[..., -1] - log_growth[..., first]) / span


def mean_rate_error(tau: np.ndarray, log_growth: np.ndarray, start: float, parts=PARTS):
    """Return the standard error of that rate, from as many consecutive parts of the time."""
    edges = np.linspace(np.searchsorted(tau, start), len(tau) - 1, parts + 1)
    edges = edges.round().astype(int)
    rates = np.diff(log_growth[..., edges], axis=-1) / np.diff(tau[edges])
    return rates.std(axis=-1, ddof=1) / np.sqrt(parts)


def is_chaotic(tau: np.ndarray, log_growth: np.ndarray, size: np.ndarray) -> np.ndarray:
    """Return whether a tangent vector grows exponentially along a solution, (...).

    It does if its logarithm grows by more than MANY over the second half of the run, even after
    ERRORS standard errors are taken off. The growth counts relative to the l2 norm `size` (...,
    time) of the solution, since in a chain that leaves its rest both grow alike. No power law in
    time reaches MANY, so that the limit does not depend on any case.
    """
    middle = tau[-1] / 2
    with np.errstate(divide="ignore", invalid="ignore"):  # a chain at rest has no relative errors
        relative = log_growth - np.log(size)
        rate = mean_rate(tau, relative, middle)
        error = mean_rate_error(tau, relative, middle)
    return (rate - ERRORS * error) * (tau[-1] - middle) > MANY
