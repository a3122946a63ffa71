"""Compares the numbers of a variable with the accepted ones, row by row.

A row consists of all numbers with the same text labels. A regular number may differ by TOLERANCE
times the largest number of its row, and a rounding error by the factor FACTOR. A proven bound may
be larger by GROWN, but not smaller, because a smaller bound was not proved. A number that rests on
chaos may differ more: soon after the horizon by the allowed error (`Chaos`), later by a few times
the scatter of correct runs (`scatter`). Its sign, range and steps in time are limited too.
"""

from collections.abc import Iterator

import numpy as np
import xarray as xr

from replication.variables import BOUND, KIND, STATISTIC

from . import hashes
from .chaos import ROUNDING, TOLERANCE

NOISE = 1e-11
"""Allowed rounding error of a regular run relative to the largest value of the variable."""

UNIT, FACTOR = 1e-15, 100.0
"""Rounding error of 1.0; factor by which two sums of rounding errors may differ."""

GROWN = 0.01
"""Allowed relative growth of a proven bound; even a tiny bound is not a rounding error."""

TIMES_SCATTER, LEAST, UNKNOWN_SCATTER = 2.5, 0.05, 0.6
"""Limits of the mean difference of a chaotic row relative to its mean size. The limit is
TIMES_SCATTER times the scatter, but at least LEAST. Without known scatter it is UNKNOWN_SCATTER."""

SCATTER, LONG, SMALL = 4.0, 100, 0.01
"""Factor by which a statistic may be larger or smaller. Smallest length of a chaotic row with a
limited range. Numbers below SMALL times the largest of the variable may have any value."""

ROUNDED = 1e-5
"""Rounding error of accepted numbers relative to the largest: they are stored to seven digits."""

STEP, FEWEST = 3.0, 20
"""Factor by which the largest step in time may grow, if there are FEWEST times or more. The factor
is doubled for a statistic, because one excursion of a chaotic run may be the largest step."""


def fault(
    key: str,
    was: xr.Variable,
    now: xr.Variable,
    freedom: np.ndarray,
    data: xr.Dataset,
    scatter: float | None,
) -> str:
    """Return what is wrong with the numbers of `now`, or an empty text.

    `freedom` is the allowed error of each number (see `Chaos`). `scatter` is the scatter of the
    variable (see the module of this name), or None if it is not known.
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
    """Yield a message for each variable with a jump: a step much larger than all accepted ones.

    `steps` are the dimensions along which values change gradually (see STEP).
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
    """Yield the index of each row: one row for each combination of text labels.

    A dimension has text labels if a text variable, such as its coordinate, has only this dimension.
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
    """Return whether a variable is a statistic of a few runs, which is itself uncertain."""
    return variable.attrs.get(KIND) == STATISTIC


def _of_regular(
    variable: xr.Variable, old: np.ndarray, new: np.ndarray, largest: float, exact: bool
) -> str:
    with np.errstate(invalid="ignore"):
        difference = abs(new - old)  # NaN or infinite unless both are finite
    same = (old == new) | (np.isnan(old) & np.isnan(new))
    if gaps := int((~same & ~np.isfinite(difference)).sum()):
        return f"differs in NaN or infinity, at {gaps} places"
    if variable.attrs.get(KIND) == BOUND:
        return _of_proven(old[~same], new[~same])
    scale, off = hashes.largest(old), float(difference[~same].max(initial=0.0))
    tolerance = TOLERANCE * (FACTOR if is_statistic(variable) else 1.0)
    if off <= (0.0 if exact else tolerance * scale + NOISE * largest):
        return ""
    if not exact and are_roundings(scale, hashes.largest(new)):
        return ""
    allowed = 0.0 if exact else TOLERANCE
    return f"is off by {off / (scale or 1):.2g} of its largest value; {allowed:.2g} is allowed"


def _of_proven(old: np.ndarray, new: np.ndarray) -> str:
    """Return a message if proven bounds are smaller or much larger, else an empty text."""
    grown = (new - old) / np.maximum(abs(old), np.finfo(float).tiny)
    least, most = grown.min(initial=0.0), grown.max(initial=0.0)
    if least < -TOLERANCE:
        return f"is smaller than the proven bound by {-least:.2g} of it, so it is not proved"
    return "" if most <= GROWN else f"exceeds the proven bound by {most:.2g} of it"


def are_roundings(was: float, now: float) -> bool:
    """Return whether both values can be the same rounding error, computed in two environments."""
    small, large = sorted(max(abs(each), UNIT) for each in (was, now))
    return large < ROUNDING and large < FACTOR * small


def _soon_after_the_horizon(
    variable: xr.Variable, old: np.ndarray, new: np.ndarray, free: np.ndarray
) -> str:
    """Return a message if a number differs by more than its allowed error `free`."""
    known = (free > 0.0) & np.isfinite(free) & np.isfinite(old) & np.isfinite(new)
    if is_statistic(variable) or not known.any():  # `free` limits solutions, not statistics
        return ""
    grown = free[known] * (hashes.largest(old) or 1.0)
    beyond = (abs(new - old)[known] / grown).max()
    if beyond <= 1.0:
        return ""
    return f"is off soon after the horizon by {beyond:.2g} times what errors can have grown to"


def _of_chaotic(
    variable: xr.Variable, old: np.ndarray, new: np.ndarray, small: float, most: float
) -> str:
    """Return a message if chaotic numbers differ more than in correct runs, or an empty text.

    Numbers below `small` may have any value. The mean difference may be up to `most` times the mean
    size.
    """
    if np.isfinite(old).all() and not np.isfinite(new).all():
        return "has NaN or infinity where there was none"
    both = np.isfinite(old) & np.isfinite(new)
    old, new = old[both], new[both]
    if not old.size:
        return ""
    if old.min() >= 0 > new.min():
        return "is negative, but the accepted values are not"
    size, new_size, difference = (float(abs(each).mean()) for each in (old, new, new - old))
    differs = f"rests on chaos, but differs by too much: {new_size:.3g} in place of {size:.3g}"
    if is_statistic(variable) or old.min() < 0 < old.max() or new.min() < 0 < new.max():
        is_alike = 1 / SCATTER <= (new_size + small) / (size + small) <= SCATTER
        return "" if is_alike else differs
    if difference > most * size + small:
        relative = difference / (size or 1)
        return f"rests on chaos, but differs by too much: by {relative:.2g} of its mean size"
    outside = max(new.max() - old.max(), old.min() - new.min())
    if old.size >= LONG and outside > np.ptp(old) + small:
        return f"leaves the range of the accepted values by {outside:.2g}"
    return ""
