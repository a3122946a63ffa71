"""Growth of l2^2 behind a spreading front: fits of a tau + b and of a tau^(2 q) + b.

Two fronts of speed v that leave a power P at each site behind them give l2^2 = 2 v P tau + b, where
b comes from the transient at the start. A fit of a power of tau without b is biased while b is not
negligible, so b is fitted too. The fits call no linear algebra library, because its last bits
depend on the machine.
"""

from functools import lru_cache
from typing import NamedTuple

import numpy as np

from latticode.numerics.elementary import expm1, log

from .confidence import CONFIDENCE, ConfidenceInterval, mean_limits, student

BLOCKS = 10
"""Number of time intervals that count as independent in the error of a single curve."""

STEPS, SETTLED = 20, 1e-10
"""Maximum number of Gauss-Newton steps for the exponent, and the change at which they stop."""

LEAST, MOST, GRID, NEARLY_ZERO = -1.0, 3.0, 0.05, 1e-4
"""Lowest and highest exponent, and the spacing of the grid for the first search. NEARLY_ZERO
replaces exponents of smaller modulus, because the law at 0 is a limit."""


class Line(NamedTuple):
    """The line y = slope x + offset."""

    slope: float
    offset: float

    def at(self, x: np.ndarray) -> np.ndarray:
        """Return y at x."""
        return self.slope * x + self.offset


def lay_line(x: np.ndarray, y: np.ndarray) -> Line:
    """Return the least-squares line through the points x, y (point,)."""
    off = x - x.mean()
    slope = (off * y).sum() / (off * off).sum()
    return Line(float(slope), float(y.mean() - slope * x.mean()))


class LateGrowth(NamedTuple):
    """A line through the late part of an ensemble's curves, with confidence intervals."""

    slope: ConfidenceInterval
    offset: float
    relative: ConfidenceInterval
    """Rise of the line over the fitted times, relative to the mean of the curves."""


def fit_line(
    x: np.ndarray, values: np.ndarray, start: float, confidence: float = CONFIDENCE
) -> LateGrowth:
    """Return the line values = slope x + offset through curves (member, x), from x = `start` on.

    `x` is tau or a function of tau. If x is the number of sites between two fronts, 2 (v tau -
    delay log tau), the slope is the power P of a site. The interval describes the mean over the
    independent members and is valid for curves with long correlation times. A single curve is
    divided into BLOCKS time intervals instead.
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
    """Return the slope of one curve, with an interval that holds for correlated residuals.

    The contribution of each block of residuals to the slope counts as one independent value (the
    cluster-robust variance of a regression). The line itself takes two degrees of freedom.
    """
    off = x - x.mean()
    weighted = off * (y - line.at(x))
    block_sums = np.array([block.sum() for block in np.array_split(weighted, BLOCKS)])
    error = np.sqrt((block_sums**2).sum() * BLOCKS / (BLOCKS - 2)) / (off * off).sum()
    half = student(BLOCKS - 2, confidence) * float(error)
    return ConfidenceInterval(line.slope, line.slope - half, line.slope + half)


def exponent_with_offset(tau: np.ndarray, squares: np.ndarray) -> np.ndarray:
    """Return the least-squares exponents q of squares = a tau^(2 q) + b, (...).

    `squares` are curves (..., time). The Gauss-Newton method refines the best value of a grid from
    LEAST to MOST. At q = 0 the law is a log tau + b; for q < 0 the law tends to the limit b.
    """
    x = log(tau / tau[-1])
    first = q = _best_of_grid(x.tobytes(), squares)
    for _ in range(STEPS):
        law, change = _law(x, q[..., None])
        slope_of_change = _slope(law, change)
        residual = _centred(change) - slope_of_change * _centred(law)  # a and b cannot fit this
        share = (residual * squares).sum(axis=-1) / (residual * residual).sum(axis=-1)
        slope = _slope(law, squares - share[..., None] * change)[..., 0]
        step = np.divide(share, slope, out=np.zeros_like(share), where=slope != 0.0)
        before, q = q, np.clip(q + step, first - GRID, first + GRID)
        if np.abs(q - before).max() < SETTLED:
            break
    return np.clip(q, LEAST, MOST)


def _best_of_grid(x: bytes, squares: np.ndarray) -> np.ndarray:
    """Return for each curve the exponent on the grid with the least sum of squared residuals."""
    exponents, laws = _laws_of_grid(x)
    curves = squares.reshape(-1, laws.shape[-1])
    explained = [(laws * curve).sum(axis=-1) ** 2 for curve in curves]
    return exponents[np.argmax(explained, axis=-1)].reshape(squares.shape[:-1])


@lru_cache(maxsize=8)
def _laws_of_grid(x: bytes) -> tuple[np.ndarray, np.ndarray]:
    """Return the exponents of the grid, and their laws (exponent, time), centred and normalised.

    `x` is log(tau / tau[-1]) as bytes, which the cache can hash.
    """
    exponents = np.linspace(LEAST, MOST, round((MOST - LEAST) / GRID) + 1)
    laws = _centred(_law(np.frombuffer(x), exponents[:, None])[0])
    return exponents, laws / np.sqrt((laws * laws).sum(axis=-1, keepdims=True))


def _centred(values: np.ndarray) -> np.ndarray:
    return values - values.mean(axis=-1, keepdims=True)


def _slope(x: np.ndarray, y: np.ndarray) -> np.ndarray:
    """Return the slopes (..., 1) of least-squares lines through the points x, y."""
    off = _centred(x)
    return (off * y).sum(axis=-1, keepdims=True) / (off * off).sum(axis=-1, keepdims=True)


def _law(x: np.ndarray, q: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return (exp(2 q x) - 1) / (2 q), which tends to x as q -> 0, and its derivative by q."""
    p = 2.0 * np.where(np.abs(q) > NEARLY_ZERO, q, NEARLY_ZERO)
    law = expm1(p * x) / p
    return law, 2.0 * (x * (1.0 + p * law) - law) / p


def fit_exponent(
    tau: np.ndarray, l2: np.ndarray, start: float, confidence: float = CONFIDENCE
) -> ConfidenceInterval:
    """Return the exponent q of l2^2 = a tau^(2 q) + b from `start` on, for `l2` (member, tau).

    The confidence interval of the mean over the members is returned; one member gives infinity.
    """
    is_fitted = tau >= start
    return mean_limits(exponent_with_offset(tau[is_fitted], l2[:, is_fitted] ** 2), confidence)
