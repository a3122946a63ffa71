"""Compare one curve with that of the baseline, by the method that its rule names.

Each method returns how far the curve is off in units of what is allowed (more than 1 is a fault),
and says it in words.
"""

from typing import NamedTuple

import numpy as np

from .curves import Curve
from .tolerances import FLOOR, Rule


class Deviation(NamedTuple):
    """How far a curve is off, in units of what is allowed, and in words."""

    excess: float
    says: str
    moved: bool = False
    """Whether a curve may have moved in the picture, although it was found alike."""


VISIBLE = 1e-4
"""A tenth of a pixel in a panel 900 pixels wide."""

SAME = Deviation(0.0, "")


def deviation(reference: Curve, new: Curve, rule: Rule) -> Deviation:
    """Return how far `new` is from `reference` under this rule."""
    if reference.values.shape != new.values.shape:
        says = f"has the shape {new.values.shape} in place of {reference.values.shape}"
        return Deviation(np.inf, says)
    if reference.values.dtype.kind != new.values.dtype.kind:
        return Deviation(np.inf, "holds values of another type")
    if reference.values.dtype.kind != "f":
        return _exact(reference.values, new.values)
    if np.array_equal(reference.values, new.values, equal_nan=True):
        return SAME
    if not np.array_equal(np.isfinite(reference.values), np.isfinite(new.values)):
        return Deviation(np.inf, "has gaps (NaN) elsewhere")
    return METHODS[rule.method](reference, new, rule)


def _exact(reference: np.ndarray, new: np.ndarray) -> Deviation:
    unlike = np.atleast_1d(reference != new)
    if not unlike.any():
        return SAME
    was, now = np.atleast_1d(reference)[unlike][0], np.atleast_1d(new)[unlike][0]
    return Deviation(np.inf, f"is {now!s} in place of {was!s}")


def _pointwise(reference: Curve, new: Curve, rule: Rule) -> Deviation:
    """Largest difference, as a part of the largest value of the curve."""
    was, now = (np.atleast_1d(c.values).astype(float) for c in (reference, new))
    difference = np.nan_to_num(abs(now - was))
    scale = reference._replace(values=was).largest or 1.0
    place = np.unravel_index(difference.argmax(), difference.shape)
    off = difference[place] / scale
    tau = "" if reference.tau is None else f" at tau = {np.atleast_1d(reference.tau)[place]:.4g}"
    says = f"is off by {off:.2g} of its scale{tau}, {rule.limit:.2g}"
    return Deviation(off / rule.limit, says, moved=off > VISIBLE)


def _chaotic(reference: Curve, new: Curve, rule: Rule) -> Deviation:
    """Pointwise up to the horizon, by mean, spread and maximum beyond it."""
    if reference.tau is None:
        return _by_statistics(reference.values, new.values, rule)
    trusted = reference.tau <= rule.horizon
    cut = [Curve(c.label, np.where(trusted, c.values, 0), c.tau) for c in (reference, new)]
    before = _pointwise(*cut, rule)
    if before.excess > 1 or trusted.all():
        return before
    beyond = _by_statistics(reference.values[~trusted], new.values[~trusted], rule)
    return max(before, beyond, key=lambda found: found.excess)._replace(moved=True)


def _by_statistics(reference: np.ndarray, new: np.ndarray, rule: Rule) -> Deviation:
    """Mean, standard deviation and maximum, each within its band of the reference's own."""
    found, finite = [], np.isfinite(reference)
    reference, new = reference[finite], new[finite]
    if not reference.size:
        return SAME
    for name, measure, band in zip(STATISTICS, STATISTICS.values(), rule.bands, strict=True):
        was, now = float(measure(reference)), float(measure(new))
        if band is None or was == now:
            continue
        off = abs(now - was) / (abs(was) or 1.0)
        says = f"has the {name} {now:.4g} in place of {was:.4g}, {band:.2g} of it"
        found.append(Deviation(off / band, says, moved=True))
    return max(found, default=Deviation(0.0, "", True), key=lambda each: each.excess)


def _magnitude(reference: Curve, new: Curve, rule: Rule) -> Deviation:
    """Of errors: their largest size, as a factor; below the floor any size is as good."""
    was, now = (max(curve.largest, FLOOR) for curve in (reference, new))
    decades = abs(np.log10(now / was))
    says = f"is of size {now:.2g} in place of {was:.2g}, a factor of {10**rule.limit:.2g}"
    return Deviation(decades / rule.limit, says, moved=True)


STATISTICS = {
    "mean": np.mean,
    "standard deviation": np.std,
    "maximum": lambda values: np.max(abs(values)),
}
METHODS = {"pointwise": _pointwise, "chaotic": _chaotic, "magnitude": _magnitude}
