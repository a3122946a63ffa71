"""Growth: rates of tangent vectors with their errors, and what is chaotic."""

from itertools import accumulate

import numpy as np

from latticode.numerics.elementary import exp, log

from .difference import VISIBLE, first_above

MANY = float(log(100.0))
"""The logarithm of a growth over the second half of a run that no power law reaches: tau^6 grows by
a factor of 64."""
ERRORS = 3.0
"""A growth must exceed MANY by so many standard errors."""
INTERVALS = 8
ROUNDING = 2.0**-53
"""Relative error of one rounded operation in double precision."""


def mean_rate(tau: np.ndarray, log_growth: np.ndarray, start: float) -> np.ndarray:
    """Return the mean rate of growth from `start` to the end, of log_growth (..., time).

    For a tangent vector it is a Lyapunov exponent, per unit of tau.
    """
    first = int(np.searchsorted(tau, start))
    span = tau[-1] - tau[first]
    return (log_growth[..., -1] - log_growth[..., first]) / span


def mean_rate_error(tau: np.ndarray, log_growth: np.ndarray, start: float, intervals=INTERVALS):
    """Return the standard error of that rate, from as many consecutive parts of the time."""
    edges = np.linspace(np.searchsorted(tau, start), len(tau) - 1, intervals + 1)
    edges = edges.round().astype(int)
    rates = np.diff(log_growth[..., edges], axis=-1) / np.diff(tau[edges])
    return rates.std(axis=-1, ddof=1) / np.sqrt(intervals)


def is_chaotic(
    tau: np.ndarray, log_growth: np.ndarray, size: np.ndarray, many=MANY, errors=ERRORS
) -> np.ndarray:
    """Return whether a tangent vector grows exponentially along a solution, (...).

    It does if its logarithm grows by more than `many` over the second half of the run, even after
    so many standard `errors` are taken off. The growth counts relative to the l2 norm `size` (...,
    time) of the solution, since in a chain that leaves its rest both grow alike. No power law in
    time reaches MANY, so that the limit does not depend on any case.
    """
    middle = tau[-1] / 2
    with np.errstate(divide="ignore", invalid="ignore"):  # a chain at rest has no relative errors
        relative = log_growth - log(size)
        rate = mean_rate(tau, relative, middle)
        error = mean_rate_error(tau, relative, middle)
    return (rate - errors * error) * (tau[-1] - middle) > many


def amplification(tau: np.ndarray, log_growth: np.ndarray, size: np.ndarray) -> np.ndarray:
    """Return log of the relative error at each tau, per relative error made in a unit of tau.

    Errors are made all along, each in proportion to the `size` of the solution at its time s, and
    grown by exp(log_growth(tau) - log_growth(s)). All arguments are (time,), as is the result.
    """
    log_weights = log(size[1:] * np.diff(tau)) - log_growth[1:]
    peak = np.maximum.accumulate(log_weights)
    before = np.concatenate([[-np.inf], peak[:-1]])
    # the sum up to each tau in units of its largest term; a new peak makes the former sum smaller
    terms = zip(exp(before - peak).tolist(), exp(log_weights - peak).tolist(), strict=True)
    sums = accumulate(terms, lambda total, term: total * term[0] + term[1], initial=0.0)
    total = peak + log(np.array(list(sums)[1:])) + log_growth[1:] - log(size[1:])
    return np.concatenate([[-np.inf], total])


def predict(tau: np.ndarray, log_amplification: np.ndarray, error: float) -> float:
    """Return the first tau at which `error` a unit of tau has grown to VISIBLE; inf if at none."""
    return first_above(tau, log_amplification, log(VISIBLE / error))
