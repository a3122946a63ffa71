"""Which law a slowly changing curve follows: bounded ones and growing ones, compared.

A logarithm passes any test that asks for a small power of time, so the laws are laid side by side.
Their distances from the curve count in its errors, and these must know that a curve remembers
itself: means over long spans of time forget each other, and their scatter over the members of an
ensemble holds whatever a member remembers within a span.
"""

from collections.abc import Callable
from itertools import pairwise
from typing import NamedTuple

import numpy as np

from pendula.numerics.elementary import exp, geometric, log, power

from .confidence import Limits, student

SPANS = 8
"""Spans of a curve, equally long in log tau."""


class Law(NamedTuple):
    """f(y) = a + b g(tau), a straight line after both are bent; without g it is y = a."""

    of_time: Callable | None
    bend: Callable = lambda y: y
    unbend: Callable = lambda z: z
    steepness: Callable = np.ones_like
    """df / dy."""

    @property
    def parameters(self) -> int:
        """How many constants are fitted."""
        return 1 if self.of_time is None else 2


BOUNDED = {
    "constant": Law(None),
    "limit_less_1_over_tau": Law(lambda tau: -1.0 / tau),
    "limit_less_1_over_root_tau": Law(lambda tau: -1.0 / np.sqrt(tau)),
    "limit_less_1_over_fourth_root_tau": Law(lambda tau: -1.0 / np.sqrt(np.sqrt(tau))),
    "limit_less_1_over_tenth_root_tau": Law(lambda tau: -power(tau, -0.1)),
}
GROWING = {
    "log_tau": Law(log),
    "fourth_root_of_log_tau": Law(
        log,
        lambda y: (y * y) * (y * y),
        lambda z: np.sqrt(np.sqrt(np.maximum(z, 0.0))),
        lambda y: 4.0 * (y * y * y),
    ),
    "power_of_tau": Law(log, log, exp, lambda y: 1.0 / y),
}
"""By their names in the ledger. A bounded curve may come to its limit from below or from above.

The slower it does, the more a bounded law is like a logarithm: (1 - tau^-p) / p is ln tau where p
goes to zero. So a free exponent would fit whatever a logarithm fits. The family ends at 1/10, where
a time ten times as long still leaves four fifths of the way to the limit.
"""


class Means(NamedTuple):
    """Means of an ensemble's curves over spans of time, with independent errors."""

    values: np.ndarray  # (span,)
    errors: np.ndarray  # (span,): standard errors of the means over the members
    freedom: int  # of the errors
    times: list[np.ndarray]  # of each span
    neighbours: float  # the correlation of what neighbouring means of a member are off


class Fitted(NamedTuple):
    """A law laid through the means."""

    chi2: float
    criterion: float  # Akaike's: chi2 + 2 parameters
    slope: Limits  # b; of a growing law no less than zero
    at: Callable  # tau -> the law's value


def span_means(tau: np.ndarray, curves: np.ndarray, start: float) -> Means:
    """Return the means of curves (member, tau) over SPANS spans of log tau from `start` on.

    The variance of a span's mean is taken to fall as one over its length, which is right for
    spans that are longer than the curve's memory: so the scatter of all spans tells one number.
    """
    edges = geometric(start, float(tau[-1]), SPANS + 1)
    kept = [(tau >= a) & (tau < b) for a, b in pairwise(edges)]
    kept[-1] |= tau == tau[-1]
    means = np.array([[curve[span].mean() for span in kept] for curve in curves])
    scaled = (means - means.mean(axis=0)) * np.sqrt(np.diff(edges))
    freedom = SPANS * (len(curves) - 1)
    variance = (scaled**2).sum() / freedom if freedom else np.nan
    errors = np.sqrt(variance / np.diff(edges) / len(curves))
    pairs = (scaled[:, 1:] * scaled[:, :-1]).mean() / (scaled**2).mean() if freedom else np.nan
    return Means(means.mean(axis=0), errors, freedom, [tau[span] for span in kept], float(pairs))


def fit_law(law: Law, means: Means, growing: bool) -> Fitted:
    """Return the law of least squares; a `growing` one with a falling curve stays constant."""
    z, errors = law.bend(means.values), means.errors * law.steepness(means.values)
    weights = 1.0 / errors**2
    x = np.zeros_like(z)
    if law.of_time is not None:
        x = np.array([law.of_time(times).mean() for times in means.times])
    middle, height = (weights * x).sum() / weights.sum(), (weights * z).sum() / weights.sum()
    spread = (weights * (x - middle) ** 2).sum()
    slope = (weights * (x - middle) * (z - height)).sum() / spread if spread > 0.0 else 0.0
    if growing:
        slope = max(slope, 0.0)
    chi2 = float((weights * (z - height - slope * (x - middle)) ** 2).sum())

    def at(tau: float) -> float:
        ahead = 0.0 if law.of_time is None else law.of_time(tau) - middle
        return float(law.unbend(height + slope * ahead))

    half = student(means.freedom) / np.sqrt(spread) if spread > 0.0 else 0.0
    limits = Limits(float(slope), float(slope - half), float(slope + half))
    return Fitted(chi2, chi2 + 2.0 * law.parameters, limits, at)


def compare(means: Means) -> tuple[dict[str, Fitted], dict[str, Fitted]]:
    """Return the fitted BOUNDED laws and the GROWING ones, by name."""
    bounded = {name: fit_law(law, means, growing=False) for name, law in BOUNDED.items()}
    return bounded, {name: fit_law(law, means, growing=True) for name, law in GROWING.items()}


def best(fitted: dict[str, Fitted]) -> str:
    """Return the name of the law with the least criterion."""
    return min(fitted, key=lambda name: fitted[name].criterion)
