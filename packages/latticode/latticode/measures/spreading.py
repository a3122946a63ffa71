"""How l2^2 grows where a front spreads: l2^2 = a tau + b, and whether the exponent is one half.

A bulk of P a site behind fronts of speed v makes l2^2 = 2 v P tau + b: what the start cost stands
in b. A power of tau laid through such a curve is off for as long as b counts, so b is fitted too.
All sums are plain ones, so that the last bits hang on no library.
"""

from functools import lru_cache
from typing import NamedTuple

import numpy as np

from latticode.numerics.elementary import expm1, log

from .confidence import CONFIDENCE, ConfidenceInterval, mean_limits, student

BLOCKS = 10
"""Stretches of time that count as independent in the error of a single curve."""

STEPS, SETTLED = 20, 1e-10
"""The most steps of Gauss and Newton to the exponent, and the change of it that ends them."""

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


class LateGrowth(NamedTuple):
    """A line through the late part of an ensemble's curves, with its confidence limits."""

    slope: ConfidenceInterval
    offset: float
    relative: ConfidenceInterval
    """What the line gains from its first to its last time, over the mean of the curves."""


def fit_line(x: np.ndarray, values: np.ndarray, start: float, confidence=CONFIDENCE) -> LateGrowth:
    """Return values = slope x + offset of curves (member, x), from x = `start` on.

    `x` is tau, or any clock: 2 (v tau - delay log tau) makes the slope the power P of a site. The
    limits are those of the mean over the members, which are independent, however long each of
    them remembers itself; a single curve is cut into BLOCKS stretches of time.
    """
    is_fitted = x >= start
    lines = [lay_line(x[is_fitted], series[is_fitted]) for series in values]
    if len(values) > 1:
        slope = mean_limits([line.slope for line in lines], confidence)
    else:
        slope = _of_stretches(x[is_fitted], values[0][is_fitted], lines[0], confidence)
    span = (x[-1] - x[is_fitted][0]) / values[:, is_fitted].mean()
    relative = ConfidenceInterval(*(bound * span for bound in slope))
    return LateGrowth(slope, float(np.mean([line.offset for line in lines])), relative)


def _of_stretches(
    x: np.ndarray, y: np.ndarray, line: Line, confidence: float
) -> ConfidenceInterval:
    """Return the slope of one curve with limits that hold for residuals with a memory.

    What a stretch of the residuals adds to the slope counts as one independent value; two degrees
    of freedom went into the line (the clustered estimate of the variance of a regression).
    """
    off = x - x.mean()
    weighted = off * (y - line.at(x))
    block_sums = np.array([block.sum() for block in np.array_split(weighted, BLOCKS)])
    error = np.sqrt((block_sums**2).sum() * BLOCKS / (BLOCKS - 2)) / (off * off).sum()
    half = student(BLOCKS - 2, confidence) * float(error)
    return ConfidenceInterval(line.slope, line.slope - half, line.slope + half)


def exponent_with_offset(tau: np.ndarray, squares: np.ndarray) -> np.ndarray:
    """Return q of the law squares = a tau^(2 q) + b of least squares for curves (..., time).

    The best of a grid from LEAST to MOST is refined by the method of Gauss and Newton. Near q = 0
    the law is a logarithm, and below it tends to a limit.
    """
    x = log(tau / tau[-1])
    first = q = _best_of_grid(x.tobytes(), squares)
    for _ in range(STEPS):
        law, change = _law(x, q[..., None])
        slope_of_change = _slope(law, change)
        alone = _centred(change) - slope_of_change * _centred(law)  # what no a and b can make
        share = (alone * squares).sum(axis=-1) / (alone * alone).sum(axis=-1)
        slope = _slope(law, squares - share[..., None] * change)[..., 0]
        step = np.divide(share, slope, out=np.zeros_like(share), where=slope != 0.0)
        before, q = q, np.clip(q + step, first - GRID, first + GRID)
        if np.abs(q - before).max() < SETTLED:
            break
    return np.clip(q, LEAST, MOST)


def _best_of_grid(x: bytes, squares: np.ndarray) -> np.ndarray:
    """Return the q of the grid whose law leaves the least sum of squares of each curve."""
    exponents, laws = _laws_of_grid(x)
    explained = [
        (laws * square).sum(axis=-1) ** 2 for square in squares.reshape(-1, laws.shape[-1])
    ]
    return exponents[np.argmax(explained, axis=-1)].reshape(squares.shape[:-1])


@lru_cache(maxsize=8)
def _laws_of_grid(x: bytes) -> tuple[np.ndarray, np.ndarray]:
    """Return the exponents of the grid, and their laws less their means, of sum of squares one.

    All curves with the same times share them; `x` is the bytes of log(tau / tau[-1]).
    """
    exponents = np.linspace(LEAST, MOST, round((MOST - LEAST) / GRID) + 1)
    laws = _centred(_law(np.frombuffer(x), exponents[:, None])[0])
    return exponents, laws / np.sqrt((laws * laws).sum(axis=-1, keepdims=True))


def _centred(values: np.ndarray) -> np.ndarray:
    return values - values.mean(axis=-1, keepdims=True)


def _slope(x: np.ndarray, y: np.ndarray) -> np.ndarray:
    """Return the slopes of least squares of y over x, (..., 1)."""
    off = _centred(x)
    return (off * y).sum(axis=-1, keepdims=True) / (off * off).sum(axis=-1, keepdims=True)


def _law(x: np.ndarray, q: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return (exp(2 q x) - 1) / (2 q), which is x at q = 0, and its derivative by q."""
    p = 2.0 * np.where(np.abs(q) > NEARLY_ZERO, q, NEARLY_ZERO)
    law = expm1(p * x) / p
    return law, 2.0 * (x * (1.0 + p * law) - law) / p


def fit_exponent(
    tau: np.ndarray, l2: np.ndarray, start: float, confidence=CONFIDENCE
) -> ConfidenceInterval:
    """Return the exponent of tau in l2 (member, tau), l2^2 = a tau^(2 q) + b from `start` on.

    The limits are those of the mean over the members; one member alone has infinite ones.
    """
    is_fitted = tau >= start
    return mean_limits(exponent_with_offset(tau[is_fitted], l2[:, is_fitted] ** 2), confidence)
