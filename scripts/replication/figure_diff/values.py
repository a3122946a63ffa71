"""Compares the numbers of a variable with the accepted ones, row by row of equal words.

A regular number may be off by TOLERANCE of the largest of its row, and an error of rounding by a
factor. A proven bound may grow by a part of itself: a smaller one is not what was proved. A number
that rests on chaos differs from one right run to the next, but within limits: soon after the
horizon by little, later by at most TIMES_SCATTER what rows of right runs differ by (`scatter`). It
keeps its sign and its range, and its steps in time are not much longer.
"""

from collections.abc import Iterator

import numpy as np
import xarray as xr

from replication.variables import BOUND, KIND, STATISTIC

from . import hashes
from .chaos import ROUNDING, TOLERANCE

NOISE = 1e-11
"""Roundings of a regular run, as a part of the largest of the variable."""

UNIT, FACTOR = 1e-15, 100.0
"""A rounding of one, and by what factor an error may differ that is a sum of roundings."""

GROWN = 0.01
"""How much larger a proven bound may be, which is no error of rounding however small it is."""

TIMES_SCATTER, LEAST, UNKNOWN_SCATTER = 2.5, 0.05, 0.6
"""Limit of the mean difference of a chaotic row: so many times its scatter, but at least so large a
part of its mean size, and such a part where the scatter is not known."""

SCATTER, LONG, SMALL = 4.0, 100, 0.01
"""By what factor a statistic may be larger or smaller; LONG chaotic rows also keep their
range. What is SMALL beside the largest of the variable may be anything."""

ROUNDED = 1e-5
"""How far equal numbers may be apart, relative to the largest: accepted ones have seven digits."""

STEP, FEWEST = 3.0, 20
"""How much larger a step in time may be than the largest accepted one, and twice that of a
statistic: one excursion of a chaotic run makes the largest step of its drift. FEWEST times make a
run."""


def fault(
    key: str,
    was: xr.Variable,
    now: xr.Variable,
    freedom: np.ndarray,
    data: xr.Dataset,
    scatter: float | None,
) -> str:
    """Return what is wrong with numbers of `now`, or an empty text.

    `freedom` is how far each may be off (see `Chaos`), `scatter` by how much the chaotic ones of
    right runs differ, of their mean size, if that is known.
    """
    before, after = was.values.astype(float), now.values.astype(float)
    largest, is_exact = hashes.largest(before), now.dtype.kind != "f"
    most = UNKNOWN_SCATTER if scatter is None else max(TIMES_SCATTER * scatter, LEAST)
    for row in rows(now, data):
        old, new, free = (np.atleast_1d(each[row]) for each in (before, after, freedom))
        rests = free > 0.0
        reason = _of_regular(now, old[~rests], new[~rests], largest, is_exact)
        if not reason and rests.any():
            reason = _soon_after_the_horizon(now, old, new, free)
            reason = reason or _of_chaotic(now, old[rests], new[rests], SMALL * largest, most)
        if reason:
            return f"{key} {reason}"
    return ""


def jumps(was: xr.Dataset, now: xr.Dataset, steps: tuple[str, ...]) -> Iterator[str]:
    """Yield a message for each variable that changes too much from one place to the next.

    `steps` are the dimensions along which values change little.

    Its largest change there is compared with that of the accepted run (see STEP).
    """
    for key, variable in was.variables.items():
        times = [dim for dim in steps if variable.sizes.get(dim, 0) >= FEWEST]
        for dim in times if variable.dtype.kind == "f" else ():
            axis, rounded = variable.get_axis_num(dim), ROUNDED * hashes.largest(variable.values)
            longest = STEP * (2.0 if is_statistic(variable) else 1.0)
            changes = [abs(np.diff(data[key].values, axis=axis)) for data in (was, now)]
            for row in rows(variable, was):
                before, after = (hashes.largest(each[row]) for each in changes)
                if after > longest * before + rounded:
                    yield f"{key} jumps along {dim}"
                    break


def rows(variable: xr.Variable, data: xr.Dataset) -> Iterator[tuple]:
    """Yield an index for each combination of words along the dimensions.

    The words may be the coordinate of a dimension, or any text along it alone.
    """
    texts = {
        each.dims[0]
        for each in data.variables.values()
        if each.ndim == 1 and hashes.are_words(each)
    }
    words = [dim in texts for dim in variable.dims]
    sizes = [size if word else 1 for size, word in zip(variable.shape, words, strict=True)]
    for place in np.ndindex(*sizes):
        yield tuple(i if word else slice(None) for i, word in zip(place, words, strict=True))


def is_statistic(variable: xr.Variable) -> bool:
    """Return whether a variable is what a few runs say of their scatter, uncertain itself."""
    return variable.attrs.get(KIND) == STATISTIC


def _of_regular(
    variable: xr.Variable, old: np.ndarray, new: np.ndarray, largest: float, exact: bool
) -> str:
    with np.errstate(invalid="ignore"):
        difference = abs(new - old)  # NaN where only one of two is finite, or none
    same = (old == new) | (np.isnan(old) & np.isnan(new))
    if gaps := int((~same & ~np.isfinite(difference)).sum()):
        return f"has NaN or infinity elsewhere, at {gaps} places"
    if variable.attrs.get(KIND) == BOUND:
        return _of_proven(old[~same], new[~same])
    scale, off = hashes.largest(old), float(difference[~same].max(initial=0.0))
    tolerance = TOLERANCE * (FACTOR if is_statistic(variable) else 1.0)
    if off <= (0.0 if exact else tolerance * scale + NOISE * largest):
        return ""
    if not exact and are_roundings(scale, hashes.largest(new)):
        return ""
    allowed = 0.0 if exact else TOLERANCE
    return f"is off by {off / (scale or 1):.2g} of its largest value, {allowed:.2g} is allowed"


def _of_proven(old: np.ndarray, new: np.ndarray) -> str:
    """Return what is wrong with bounds: a smaller one is not proved."""
    grown = (new - old) / np.maximum(abs(old), np.finfo(float).tiny)
    least, most = grown.min(initial=0.0), grown.max(initial=0.0)
    if least < -TOLERANCE:
        return f"is smaller than what was proved, by {-least:.2g} of it"
    return "" if most <= GROWN else f"is off by {most:.2g} of what is proved"


def are_roundings(was: float, now: float) -> bool:
    """Return whether two sizes may be those of one error of rounding."""
    small, large = sorted(max(abs(each), UNIT) for each in (was, now))
    return large < ROUNDING and large < FACTOR * small


def _soon_after_the_horizon(
    variable: xr.Variable, old: np.ndarray, new: np.ndarray, free: np.ndarray
) -> str:
    """Return where numbers differ by more than errors can have grown to by then."""
    known = (free > 0.0) & np.isfinite(free) & np.isfinite(old) & np.isfinite(new)
    if is_statistic(variable) or not known.any():  # an error is no part of the solution
        return ""
    grown = free[known] * (hashes.largest(old) or 1.0)
    beyond = (abs(new - old)[known] / grown).max()
    if beyond <= 1.0:
        return ""
    return f"is off soon after the horizon by {beyond:.2g} times what errors can have grown to"


def _of_chaotic(
    variable: xr.Variable, old: np.ndarray, new: np.ndarray, small: float, most: float
) -> str:
    """Return what no right run of a chaotic case has, though nobody knows its numbers.

    Its mean difference is at most the part `most` of its mean size.
    """
    if np.isfinite(old).all() and not np.isfinite(new).all():
        return "has NaN or infinity where there was none"
    both = np.isfinite(old) & np.isfinite(new)
    old, new = old[both], new[both]
    if not old.size:
        return ""
    if old.min() >= 0 > new.min():
        return "is negative, as it never was"
    size, new_size, difference = (float(abs(each).mean()) for each in (old, new, new - old))
    differs = f"rests on chaos, but differs by too much: {new_size:.3g} in place of {size:.3g}"
    if is_statistic(variable) or old.min() < 0 < old.max() or new.min() < 0 < new.max():
        is_alike = 1 / SCATTER <= (new_size + small) / (size + small) <= SCATTER
        return "" if is_alike else differs
    if difference > most * size + small:
        relative = difference / (size or 1)
        return f"rests on chaos, but differs by too much: by {relative:.2g} of its size"
    outside = max(new.max() - old.max(), old.min() - new.min())
    if old.size >= LONG and outside > np.ptp(old) + small:
        return f"leaves the range of the accepted values by {outside:.2g}"
    return ""
