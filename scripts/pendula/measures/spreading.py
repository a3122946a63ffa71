"""How l2^2 grows where a front spreads: l2^2 = a tau + b, and whether the exponent is one half.

A bulk of P a site behind fronts of speed v makes l2^2 = 2 v P tau + b: what the start cost stands
in b. A power of tau laid through such a curve is off for as long as b counts, so b is fitted too.
All sums are plain ones, so that the last bits hang on no library.
"""

from typing import NamedTuple

import numpy as np

from pendula.numerics.elementary import exp, expm1, log

from .confidence import CONFIDENCE, Limits, mean_limits, student

BLOCKS = 10
"""Stretches of time that count as independent in the error of a single curve."""

STEPS = 20
"""Steps of Gauss and Newton to the exponent."""

LEAST, MOST, GRID, NEARLY_ZERO = -1.0, 3.0, 0.05, 1e-4
"""Exponents are searched between the first two, and first on a grid; those nearer to zero than the
last count as this one."""


class Line(NamedTuple):
    """y = slope x + offset."""

    slope: float
    offset: float

    def at(self, x):
        """Return y at x."""
        return self.slope * x + self.offset


def lay_line(x: np.ndarray, y: np.ndarray) -> Line:
    """Return the line of least squares through the points."""
    off = x - x.mean()
    slope = (off * y).sum() / (off * off).sum()
    return Line(float(slope), float(y.mean() - slope * x.mean()))


class Growth(NamedTuple):
    """A line through the late part of an ensemble's curves, with its confidence limits."""

    slope: Limits
    offset: float
    relative: Limits
    """What the line gains from its first to its last time, over the mean of the curves."""


def fit_line(x: np.ndarray, values: np.ndarray, start: float, confidence=CONFIDENCE) -> Growth:
    """Return values = slope x + offset of curves (member, x), from x = `start` on.

    `x` is tau, or any clock: 2 (v tau - delay log tau) makes the slope the power P of a site. The
    limits are those of the mean over the members, which are independent, however long each of
    them remembers itself; a single curve is cut into BLOCKS stretches of time.
    """
    kept = x >= start
    lines = [lay_line(x[kept], series[kept]) for series in values]
    if len(values) > 1:
        slope = mean_limits([line.slope for line in lines], confidence)
    else:
        slope = _of_stretches(x[kept], values[0][kept], lines[0], confidence)
    span = (x[-1] - x[kept][0]) / values[:, kept].mean()
    relative = Limits(*(bound * span for bound in slope))
    return Growth(slope, float(np.mean([line.offset for line in lines])), relative)


def _of_stretches(x: np.ndarray, y: np.ndarray, line: Line, confidence: float) -> Limits:
    """Return the slope of one curve with limits that hold for residuals with a memory.

    What a stretch of the residuals adds to the slope counts as one independent value; two degrees
    of freedom went into the line (the clustered estimate of the variance of a regression).
    """
    off = x - x.mean()
    weighted = off * (y - line.at(x))
    parts = np.array([part.sum() for part in np.array_split(weighted, BLOCKS)])
    error = np.sqrt((parts**2).sum() * BLOCKS / (BLOCKS - 2)) / (off * off).sum()
    half = student(BLOCKS - 2, confidence) * float(error)
    return Limits(line.slope, line.slope - half, line.slope + half)


def exponent_with_offset(tau: np.ndarray, squares: np.ndarray) -> float:
    """Return q of the law squares = a tau^(2 q) + b of least squares, between LEAST and MOST.

    The best of a grid is refined by the method of Gauss and Newton. Near q = 0 the law is a
    logarithm, and below it tends to a limit.
    """
    x = log(tau / tau[-1])
    grid = np.linspace(LEAST, MOST, round((MOST - LEAST) / GRID) + 1)
    first = q = float(min(grid, key=lambda tried: _left_over(x, squares, tried)))
    for _ in range(STEPS):
        law, change = _law(x, q)
        alone = change - lay_line(law, change).at(law)  # what no choice of a and b can make
        share = (alone * squares).sum() / (alone * alone).sum()
        slope = lay_line(law, squares - share * change).slope
        if slope == 0.0:
            break
        q = min(max(q + share / slope, first - GRID), first + GRID)
    return min(max(float(q), LEAST), MOST)


def _left_over(x: np.ndarray, squares: np.ndarray, q: float) -> float:
    """Return the sum of squares that the law with q leaves."""
    law = _law(x, q)[0]
    return float(((squares - lay_line(law, squares).at(law)) ** 2).sum())


def _law(x: np.ndarray, q: float) -> tuple[np.ndarray, np.ndarray]:
    """Return (exp(2 q x) - 1) / (2 q), which is x at q = 0, and its derivative by q."""
    p = 2.0 * (q if abs(q) > NEARLY_ZERO else NEARLY_ZERO)
    law = expm1(p * x) / p
    return law, 2.0 * (x * exp(p * x) - law) / p


def fit_exponent(tau: np.ndarray, l2: np.ndarray, start: float, confidence=CONFIDENCE) -> Limits:
    """Return the exponent of tau in l2 (member, tau), l2^2 = a tau^(2 q) + b from `start` on.

    The limits are those of the mean over the members; one member alone has infinite ones.
    """
    kept = tau >= start
    found = [exponent_with_offset(tau[kept], series[kept] ** 2) for series in l2]
    return mean_limits(found, confidence)
