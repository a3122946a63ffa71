"""Compares the numbers of a variable with the accepted ones, row by row of equal words.

A regular number may be off by TOLERANCE of the largest of its row, an error of rounding by a
factor, and a proven bound by a part of itself. A number that rests on chaos differs from one right
run to the next, but within limits: it keeps its sign and its range, over a row it differs by less
than it is large, and its steps in time are not much longer. These limits are about twice what runs
show whose epsilon is moved by its last bits (`.ci/elsewhere moved`).
"""

import re
from collections.abc import Iterator

import numpy as np
import xarray as xr

from . import hashes
from .chaos import ROUNDING, TOLERANCE

NOISE = 1e-11
"""Roundings of a regular run, as a part of the largest of the variable."""

UNIT, FACTOR = 1e-15, 100.0
"""A rounding of one, and by what factor an error may differ that is a sum of roundings."""

PROVEN, PROVEN_APART = re.compile("bound|radius"), 0.01
"""Names of what is proved, which is no error of rounding however small it is."""

SCATTERED = re.compile("error|deviation|correlation|width|drift|uncertainty")
"""Names of what a few runs say of their own scatter, which is uncertain itself."""

SIGNED = re.compile("correlation|energy|region_mean")
"""Names of what may have either sign."""

APART, SCATTER, LONG, SMALL = 0.6, 4.0, 100, 0.01
"""Limits of the mean difference of chaotic rows, and of their scatter; LONG rows also keep their
range. What is SMALL beside the largest of the variable may be anything."""

ROUNDED = 1e-5
"""How far equal numbers may be apart, relative to the largest: accepted ones have seven digits."""

TIMES = ("tau", "snapshot", "snapshot_tau")
STEP, FEWEST = 3.0, 20
"""How much larger a step in time may be than the largest accepted one, and twice that of what is
SCATTERED: one excursion of a chaotic run makes the largest step of its drift. FEWEST times make a
run."""


def fault(
    key: str, was: xr.Variable, now: xr.Variable, chaotic: np.ndarray, data: xr.Dataset
) -> str:
    """Return what is wrong with numbers of `now`, or an empty text; `chaotic` says which are."""
    before, after = was.values.astype(float), now.values.astype(float)
    largest, is_exact = hashes.largest(before), now.dtype.kind != "f"
    for row in rows(now, data):
        old, new, rests = (np.atleast_1d(each[row]) for each in (before, after, chaotic))
        says = _of_regular(key, old[~rests], new[~rests], largest, is_exact)
        says = says or (rests.any() and _of_chaotic(key, old[rests], new[rests], SMALL * largest))
        if says:
            return f"{key} {says}"
    return ""


def jumps(was: xr.Dataset, now: xr.Dataset) -> Iterator[str]:
    """Yield a message for each variable that changes too much from one time to the next.

    Its largest change there is compared with that of the accepted run (see STEP).
    """
    for key, variable in was.variables.items():
        times = [dim for dim in TIMES if variable.sizes.get(dim, 0) >= FEWEST]
        for dim in times if variable.dtype.kind == "f" else ():
            axis, rounded = variable.get_axis_num(dim), ROUNDED * hashes.largest(variable.values)
            longest = STEP * (2.0 if SCATTERED.search(str(key)) else 1.0)
            steps = [abs(np.diff(data[key].values, axis=axis)) for data in (was, now)]
            for row in rows(variable, was):
                before, after = (hashes.largest(each[row]) for each in steps)
                if after > longest * before + rounded:
                    yield f"{key} jumps along {dim}"
                    break


def rows(variable: xr.Variable, data: xr.Dataset) -> Iterator[tuple]:
    """Yield an index for each combination of words along the dimensions."""
    words = [
        dim in data.variables and hashes.are_words(data.variables[dim]) for dim in variable.dims
    ]
    sizes = [size if word else 1 for size, word in zip(variable.shape, words, strict=True)]
    for place in np.ndindex(*sizes):
        yield tuple(i if word else slice(None) for i, word in zip(place, words, strict=True))


def _of_regular(key: str, old: np.ndarray, new: np.ndarray, largest: float, exact: bool) -> str:
    with np.errstate(invalid="ignore"):
        apart = abs(new - old)  # NaN where only one of two is finite, or none
    same = (old == new) | (np.isnan(old) & np.isnan(new))
    if gaps := int((~same & ~np.isfinite(apart)).sum()):
        return f"has NaN or infinity elsewhere, at {gaps} places"
    if PROVEN.search(key):
        off = (apart[~same] / np.maximum(abs(old[~same]), np.finfo(float).tiny)).max(initial=0.0)
        return "" if off <= PROVEN_APART else f"is off by {off:.2g} of what is proved"
    scale, off = hashes.largest(old), float(apart[~same].max(initial=0.0))
    tolerance = TOLERANCE * (FACTOR if SCATTERED.search(key) else 1.0)
    if off <= (0.0 if exact else tolerance * scale + NOISE * largest):
        return ""
    if not exact and are_roundings(scale, hashes.largest(new)):
        return ""
    allowed = 0.0 if exact else TOLERANCE
    return f"is off by {off / (scale or 1):.2g} of its largest value, {allowed:.2g} is allowed"


def are_roundings(was: float, now: float) -> bool:
    """Return whether two sizes may be those of one error of rounding."""
    small, large = sorted(max(abs(each), UNIT) for each in (was, now))
    return large < ROUNDING and large < FACTOR * small


def _of_chaotic(key: str, old: np.ndarray, new: np.ndarray, small: float) -> str:
    """Return what no right run of a chaotic case has, though nobody knows its numbers."""
    if np.isfinite(old).all() and not np.isfinite(new).all():
        return "has NaN or infinity where there was none"
    both = np.isfinite(old) & np.isfinite(new)
    old, new = old[both], new[both]
    if not old.size:
        return ""
    if not SIGNED.search(key) and old.min() >= 0 > new.min():
        return "is negative, as it never was"
    size, new_size, apart = (float(abs(each).mean()) for each in (old, new, new - old))
    differs = f"rests on chaos, but differs by too much: {new_size:.3g} in place of {size:.3g}"
    if SCATTERED.search(key) or old.min() < 0 < old.max() or new.min() < 0 < new.max():
        is_alike = 1 / SCATTER <= (new_size + small) / (size + small) <= SCATTER
        return "" if is_alike else differs
    if apart > APART * size + small:
        return differs
    outside = max(new.max() - old.max(), old.min() - new.min())
    if old.size >= LONG and outside > np.ptp(old) + small:
        return f"leaves the range of the accepted values by {outside:.2g}"
    return ""
