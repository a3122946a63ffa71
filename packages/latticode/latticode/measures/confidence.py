"""Confidence limits: of a mean of few members, of a share, of a median, of a rate, of an order.

Quantiles of the distributions are rounded to six digits, because the last bits of the special
functions behind them differ between machines.
"""

from collections.abc import Sequence
from itertools import combinations
from math import sqrt
from typing import NamedTuple

import numpy as np
from scipy import special

from ..numerics.elementary import exp

CONFIDENCE = 0.95
"""Limits enclose the true value in so many of all repetitions, as is the custom."""


class ConfidenceInterval(NamedTuple):
    """An estimate and its confidence limits, numbers or arrays of one shape."""

    value: np.ndarray | float
    low: np.ndarray | float
    high: np.ndarray | float

    @property
    def half(self) -> np.ndarray | float:
        """Half the distance of the limits."""
        return 0.5 * (self.high - self.low)


def student(freedom: float, confidence: float = CONFIDENCE) -> float:
    """Return the quantile of Student's t that bounds a mean from both sides."""
    return _rounded(special.stdtrit(freedom, 0.5 * (1.0 + confidence)))


def mean_limits(values, confidence: float = CONFIDENCE) -> ConfidenceInterval:
    """Return the mean over the members of (member, ...) and its limits by Student's t, (...).

    Members must be independent of each other. One member has no limits: they are infinite.
    """
    values = np.asarray(values, dtype=float)
    members, mean = len(values), values.mean(axis=0)
    if members < 2:
        return ConfidenceInterval(mean, mean - np.inf, mean + np.inf)
    off = student(members - 1, confidence) * values.std(axis=0, ddof=1) / sqrt(members)
    return ConfidenceInterval(mean, mean - off, mean + off)


def difference_limits(first, second, confidence: float = CONFIDENCE) -> ConfidenceInterval:
    """Return the mean of `first` minus that of `second`, both (member,), with Welch's limits."""
    first, second = np.asarray(first, dtype=float), np.asarray(second, dtype=float)
    variances = [values.var(ddof=1) / len(values) for values in (first, second)]
    difference, error, off = first.mean() - second.mean(), sqrt(sum(variances)), 0.0
    if error:
        freedom = _freedom(variances, (len(first), len(second)))
        off = student(freedom, confidence) * error
    return ConfidenceInterval(difference, difference - off, difference + off)


def chance_inside(most: int, draws: int, members: int) -> float:
    """Return the chance that at most `most` of `draws` lie within the range of `members` others.

    All are independent draws of one continuous law, whatever it is: those outside are the first and
    the last in an order of all of them.
    """
    total = special.gammaln(np.array([draws + members + 1.0, members + 1.0, draws + 1.0]))
    outside = np.arange(draws - most, draws + 1.0)
    inner = draws + members - outside - 2.0
    ways = special.gammaln(inner + 1.0) - special.gammaln(members - 1.0)
    ways = ways - special.gammaln(inner - members + 3.0)
    orders = exp(ways - (total[0] - total[1] - total[2]))
    return float(f"{((outside + 1.0) * orders).sum():.3g}")


def chance_of_counts(least: int, members: int, share: float) -> float:
    """Return the chance that at least `least` of `members` are of a kind with this share."""
    return float(f"{special.bdtrc(least - 1.0, members, share):.3g}")


def chance_below(score: float, freedom: float) -> float:
    """Return the chance that a draw of Student's t is below a score, to three digits."""
    return float(f"{special.stdtr(freedom, score):.3g}")


def _freedom(variances, draws):
    """Return Welch's degrees of freedom of a difference, from the squared errors of both means."""
    below = sum(
        variance * variance / (count - 1) for variance, count in zip(variances, draws, strict=True)
    )
    return sum(variances) * sum(variances) / below


def ratio_limits(mean, error, members: int, confidence: float = CONFIDENCE) -> ConfidenceInterval:
    """Return the ratio of two means over `members` each, mean[1] / mean[0], and its limits.

    `mean` and `error` hold two means and their standard errors. The limits are Fieller's (Q. J. R.
    Stat. Soc. B 16 (1954) 175), with the smaller of the two numbers of degrees of freedom; they are
    infinite where the lower mean cannot be told from zero.
    """
    (below, above), t = mean, student(members - 1, confidence)
    variances = [(t * relative_error) * (t * relative_error) for relative_error in error]
    bottom = below * below - variances[0]
    ratio = above / below
    if bottom <= 0.0:
        return ConfidenceInterval(ratio, -np.inf, np.inf)
    root = sqrt(variances[1] * bottom + variances[0] * above * above)
    return ConfidenceInterval(
        ratio, (above * below - root) / bottom, (above * below + root) / bottom
    )


def share_limits(count: int, members: int, confidence: float = CONFIDENCE) -> ConfidenceInterval:
    """Return the share of `members` that `count` are, with the exact limits of Clopper and Pearson.

    Their source is Biometrika 26 (1934) 404.
    """
    tail = 0.5 * (1.0 - confidence)
    low = special.betaincinv(count, members - count + 1, tail) if count else 0.0
    high = special.betaincinv(count + 1, members - count, 1.0 - tail) if count < members else 1.0
    return ConfidenceInterval(count / members, _rounded(low), _rounded(high))


def median_limits(values, confidence: float = CONFIDENCE) -> ConfidenceInterval:
    """Return the median of (member,) and the order statistics that bound it, whatever the law.

    Values may be infinite: a life that has not ended when watching stops counts as longer than all
    others. This is the median of Kaplan and Meier where all are watched equally long. A limit is
    infinite where too few lives have ended.
    """
    ordered = np.sort(np.asarray(values, dtype=float))
    members, tail = len(ordered), 0.5 * (1.0 - confidence)
    median = ordered[[(members - 1) // 2, members // 2]].mean()
    rank = np.searchsorted(special.bdtr(np.arange(members, dtype=float), members, 0.5), tail)
    low = ordered[rank - 1] if rank > 0 else -np.inf
    high = ordered[members - rank] if rank > 0 else np.inf
    return ConfidenceInterval(float(median), float(low), float(high))


def event_rate(
    times, start: float, end: float, confidence: float = CONFIDENCE
) -> ConfidenceInterval:
    """Return the events per unit of time among those members that had none by `start`.

    `times` is (member,), infinite where no event came by `end`. The limits are the exact ones of a
    Poisson count, however small (F. Garwood, Biometrika 28 (1936) 437). NaN where none was left.
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
    """Return the share of pairs in which a value of an earlier group is larger, and its limits.

    Pairs are of values of two `groups`; equal values count half, and values may be infinite. The
    limits have the width of Jonckheere's test (Biometrika 41 (1954) 133): if all values are draws
    of one law, they enclose 1/2 with this confidence, or a larger one where values are equal.
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
