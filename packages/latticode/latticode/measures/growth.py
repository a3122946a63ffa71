"""Growth rates of tangent vectors with their errors, a test for chaos, and error amplification."""

from itertools import accumulate

import numpy as np

from latticode.numerics.elementary import exp, log

from .difference import VISIBLE, first_above

MANY = float(log(100.0))
"""Logarithm of the growth factor 100. Over the second half of a run, power laws up to tau^6 grow by
at most 64."""
ERRORS = 3.0
"""Number of standard errors by which a growth must exceed MANY."""
INTERVALS = 8
ROUNDING = 2.0**-53
"""Relative error of one rounded operation in double precision."""


def mean_rate(tau: np.ndarray, log_growth: np.ndarray, start: float) -> np.ndarray:
    """Return the mean rate (...) of `log_growth` (..., time) per unit of tau from `start` on.

    For a tangent vector this estimates a Lyapunov exponent.
    """
    first = int(np.searchsorted(tau, start))
    span = tau[-1] - tau[first]
    return (log_growth[..., -1] - log_growth[..., first]) / span


def mean_rate_error(
    tau: np.ndarray, log_growth: np.ndarray, start: float, intervals: int = INTERVALS
) -> np.ndarray:
    """Return the standard error (...) of `mean_rate`, from the rates in consecutive intervals."""
    edges = np.linspace(np.searchsorted(tau, start), len(tau) - 1, intervals + 1)
    edges = edges.round().astype(int)
    rates = np.diff(log_growth[..., edges], axis=-1) / np.diff(tau[edges])
    return rates.std(axis=-1, ddof=1) / np.sqrt(intervals)


def is_chaotic(
    tau: np.ndarray,
    log_growth: np.ndarray,
    size: np.ndarray,
    many: float = MANY,
    errors: float = ERRORS,
) -> np.ndarray:
    """Return for each tangent vector whether it grows exponentially along a solution, (...).

    The criterion: over the second half of the run, `log_growth` (..., time) minus log(`size`) grows
    by more than `many`, even after subtracting `errors` standard errors. `size` (..., time) is the
    l2 norm of the solution. Its logarithm is subtracted, because in a chain that leaves an
    equilibrium the solution grows as fast as the tangent vector.
    """
    middle = tau[-1] / 2
    with np.errstate(divide="ignore", invalid="ignore"):  # the size is zero at rest
        relative = log_growth - log(size)
        rate = mean_rate(tau, relative, middle)
        error = mean_rate_error(tau, relative, middle)
    return (rate - errors * error) * (tau[-1] - middle) > many


def amplification(tau: np.ndarray, log_growth: np.ndarray, size: np.ndarray) -> np.ndarray:
    """Return the logarithm of the relative error at each time, (time,), for a unit error rate.

    At each time s an error of `size`(s) per unit of tau is added; `size` is the l2 norm of the
    solution. By time tau this error has grown by the factor exp(log_growth(tau) -
    log_growth(s)). All arguments are (time,).
    """
    log_weights = log(size[1:] * np.diff(tau)) - log_growth[1:]
    peak = np.maximum.accumulate(log_weights)
    before = np.concatenate([[-np.inf], peak[:-1]])
    # each sum is divided by its largest term to avoid overflow; a new peak rescales the sum
    terms = zip(exp(before - peak).tolist(), exp(log_weights - peak).tolist(), strict=True)
    sums = accumulate(terms, lambda total, term: total * term[0] + term[1], initial=0.0)
    total = peak + log(np.array(list(sums)[1:])) + log_growth[1:] - log(size[1:])
    return np.concatenate([[-np.inf], total])


def predict(tau: np.ndarray, log_amplification: np.ndarray, error: float) -> float:
    """Return the first tau at which errors of `error` per unit of tau reach VISIBLE; else inf."""
    return first_above(tau, log_amplification, log(VISIBLE / error))
