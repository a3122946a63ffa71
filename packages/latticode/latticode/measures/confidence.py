"""Confidence intervals of means, ratios, shares, medians, rates of events, and orderings.

Quantiles of the distributions are rounded to six digits, because the last bits of the special
functions behind them differ between machines.
"""

from collections.abc import Iterable, Sequence
from itertools import combinations
from math import sqrt
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike
from scipy import special

from ..numerics.elementary import exp

CONFIDENCE = 0.95
"""Share of repetitions in which an interval contains the true value (the usual choice)."""


class ConfidenceInterval(NamedTuple):
    """An estimate with the ends of its confidence interval: numbers, or arrays of one shape."""

    value: np.ndarray | float
    low: np.ndarray | float
    high: np.ndarray | float

    @property
    def half(self) -> np.ndarray | float:
        """Half the width of the interval."""
        return 0.5 * (self.high - self.low)


def student(freedom: float, confidence: float = CONFIDENCE) -> float:
    """Return the two-sided quantile of Student's t with `freedom` degrees of freedom."""
    return _rounded(special.stdtrit(freedom, 0.5 * (1.0 + confidence)))


def mean_limits(values: ArrayLike, confidence: float = CONFIDENCE) -> ConfidenceInterval:
    """Return the mean of `values` (member, ...) over the members, with its interval by Student's t.

    Estimate and ends have the shape (...). Members must be independent. With one member the
    interval is infinite.
    """
    values = np.asarray(values, dtype=float)
    members, mean = len(values), values.mean(axis=0)
    if members < 2:
        return ConfidenceInterval(mean, mean - np.inf, mean + np.inf)
    off = student(members - 1, confidence) * values.std(axis=0, ddof=1) / sqrt(members)
    return ConfidenceInterval(mean, mean - off, mean + off)


def difference_limits(
    first: ArrayLike, second: ArrayLike, confidence: float = CONFIDENCE
) -> ConfidenceInterval:
    """Return mean(first) - mean(second) with Welch's confidence interval; both are (member,)."""
    first, second = np.asarray(first, dtype=float), np.asarray(second, dtype=float)
    variances = [values.var(ddof=1) / len(values) for values in (first, second)]
    difference, error, off = first.mean() - second.mean(), sqrt(sum(variances)), 0.0
    if error:
        freedom = _freedom(variances, (len(first), len(second)))
        off = student(freedom, confidence) * error
    return ConfidenceInterval(difference, difference - off, difference + off)


def chance_inside(most: int, draws: int, members: int) -> float:
    """Return the probability that at most `most` of `draws` lie in the range of `members` values.

    All values are independent with the same continuous distribution, so all orders of draws and
    members are equally likely. The result, to three digits, is the share of orders with at least
    `draws` - `most` draws below the lowest or above the highest member.
    """
    total = special.gammaln(np.array([draws + members + 1.0, members + 1.0, draws + 1.0]))
    outside = np.arange(draws - most, draws + 1.0)
    inner = draws + members - outside - 2.0
    ways = special.gammaln(inner + 1.0) - special.gammaln(members - 1.0)
    ways = ways - special.gammaln(inner - members + 3.0)
    orders = exp(ways - (total[0] - total[1] - total[2]))
    return float(f"{((outside + 1.0) * orders).sum():.3g}")


def chance_of_counts(least: int, members: int, share: float) -> float:
    """Return the probability of at least `least` successes in `members` trials, to three digits.

    Each trial succeeds with probability `share`.
    """
    return float(f"{special.bdtrc(least - 1.0, members, share):.3g}")


def chance_below(score: float, freedom: float) -> float:
    """Return the probability that Student's t is below `score`, to three digits."""
    return float(f"{special.stdtr(freedom, score):.3g}")


def _freedom(variances: Sequence[float], counts: Sequence[int]) -> float:
    """Return Welch's degrees of freedom of a difference of two means with these variances."""
    pairs = zip(variances, counts, strict=True)
    below = sum(variance * variance / (count - 1) for variance, count in pairs)
    return sum(variances) * sum(variances) / below


def ratio_limits(
    mean: Sequence[float], error: Sequence[float], members: int, confidence: float = CONFIDENCE
) -> ConfidenceInterval:
    """Return the ratio of two means, mean[1] / mean[0], with Fieller's confidence interval.

    `mean` and `error` are the two means and their standard errors, each over `members` members. The
    interval uses Student's t with `members` - 1 degrees of freedom (J. R. Stat. Soc. B 16 (1954)
    175). The interval is infinite if mean[0] does not differ significantly from zero.
    """
    (below, above), t = mean, student(members - 1, confidence)
    variances = [(t * relative_error) * (t * relative_error) for relative_error in error]
    bottom = below * below - variances[0]
    ratio, both = above / below, above * below
    if bottom <= 0.0:
        return ConfidenceInterval(ratio, -np.inf, np.inf)
    root = sqrt(variances[1] * bottom + variances[0] * above * above)
    return ConfidenceInterval(ratio, (both - root) / bottom, (both + root) / bottom)


def share_limits(count: int, members: int, confidence: float = CONFIDENCE) -> ConfidenceInterval:
    """Return `count` / `members` with the exact confidence interval of Clopper and Pearson.

    Biometrika 26 (1934) 404.
    """
    tail = 0.5 * (1.0 - confidence)
    low = special.betaincinv(count, members - count + 1, tail) if count else 0.0
    high = special.betaincinv(count + 1, members - count, 1.0 - tail) if count < members else 1.0
    return ConfidenceInterval(count / members, _rounded(low), _rounded(high))


def median_limits(values: ArrayLike, confidence: float = CONFIDENCE) -> ConfidenceInterval:
    """Return the median of `values` (member,) with order statistics as its confidence interval.

    The interval is valid for any distribution. Values may be infinite, such as a lifetime that has
    not ended during the observation. If all members are observed equally long, the result is the
    Kaplan-Meier median. An end of the interval is infinite if too few lifetimes have ended.
    """
    ordered = np.sort(np.asarray(values, dtype=float))
    members, tail = len(ordered), 0.5 * (1.0 - confidence)
    median = ordered[[(members - 1) // 2, members // 2]].mean()
    rank = np.searchsorted(special.bdtr(np.arange(members, dtype=float), members, 0.5), tail)
    low = ordered[rank - 1] if rank > 0 else -np.inf
    high = ordered[members - rank] if rank > 0 else np.inf
    return ConfidenceInterval(float(median), float(low), float(high))


def event_rate(
    times: Iterable[float], start: float, end: float, confidence: float = CONFIDENCE
) -> ConfidenceInterval:
    """Return the rate of events per unit of time among the members without an event by `start`.

    `times` (member,) are the times of the events, infinite if a member has none by `end`. The
    interval is exact for a Poisson count (F. Garwood, Biometrika 28 (1936) 437). The result
    is NaN if every member had its event by `start`.
    """
    left = np.asarray([time - start for time in times if time > start])
    if not left.size:
        return ConfidenceInterval(np.nan, np.nan, np.nan)
    events, tail = int(np.isfinite(left).sum()), 0.5 * (1.0 - confidence)
    watched = float(np.minimum(left, end - start).sum())
    low = _rounded(special.chdtri(2 * events, 1.0 - tail)) if events else 0.0
    high = _rounded(special.chdtri(2 * (events + 1), tail))
    return ConfidenceInterval(events / watched, 0.5 * low / watched, 0.5 * high / watched)


def order_limits(
    groups: Sequence[np.ndarray], confidence: float = CONFIDENCE
) -> ConfidenceInterval:
    """Return the share of pairs with the larger value in the earlier group, with its interval.

    A pair has values of two different `groups`; equal values count half, and values may be
    infinite. The interval has the width of Jonckheere's test (Biometrika 41 (1954) 133). If
    all values have the same distribution, the interval contains 1/2 with at least this confidence.
    """
    larger = pairs = 0.0
    for earlier, later in combinations([np.asarray(group, float) for group in groups], 2):
        larger += (earlier[:, None] > later).sum() + 0.5 * (earlier[:, None] == later).sum()
        pairs += len(earlier) * len(later)
    sizes = np.array([len(group) for group in groups], float)
    total = sizes.sum()
    spread = total * total * (2.0 * total + 3.0) - (sizes * sizes * (2.0 * sizes + 3.0)).sum()
    deviation = sqrt(spread / 72.0) / pairs
    off = _rounded(special.ndtri(0.5 * (1.0 + confidence))) * deviation
    return ConfidenceInterval(larger / pairs, larger / pairs - off, larger / pairs + off)


def _rounded(value: float) -> float:
    return float(f"{float(value):.6g}")
