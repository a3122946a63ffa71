"""Compares a dataset with the accepted one: by its hashes, and where they differ by its numbers.

Words, coordinates, attributes, types and shapes must be equal. Numbers may be off by TOLERANCE of
the largest of their variable; those that rest on chaos, and roundings, are beyond comparison.
"""

from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any, NamedTuple

import netCDF4
import numpy as np
import xarray as xr
from latticode.datasets.netcdf import LENGTH, MARK, DatasetError, read

from . import Status, hashes
from .chaos import ROUNDING, TOLERANCE, Chaos, are_coordinates

WORK = ("steps", "rejected_steps", "right_hand_sides")
"""Attributes that count what a solver did: they follow every rounding, also of a regular run."""


class Unlike(NamedTuple):
    """One thing that differs: if it is a fault, how many numbers cannot be judged, in words."""

    is_fault: bool
    beyond: int
    says: str


def compare(
    name: str, new: Path, accepted: Mapping[str, Any], kept: Path | None, chaos: Chaos
) -> tuple[Status, str]:
    """Return status and reason of the dataset `name`, in the file `new`, with its accepted hashes.

    `kept` is the copy in the baseline, or None where only the accepted bits are right.
    """
    try:
        content = read(new)
    except DatasetError:
        return Status.DAMAGED, "cannot be read"
    if fault := fault_of_form(new):
        return Status.DAMAGED, fault
    if hashes.of(content).items() <= accepted.items():
        return Status.IDENTICAL, ""
    if kept is None:
        return Status.DIFFERENT, "is not the accepted reference: it has other bits"
    found = list(differences(name, read(kept), content, accepted["variables"], chaos))
    if faults := [each.says for each in found if each.is_fault]:
        return Status.DIFFERENT, "; ".join(faults[:3])
    if beyond := [each.says for each in found if each.beyond]:
        count = sum(each.beyond for each in found)
        return Status.BEYOND, f"{count} numbers cannot be compared, because {'; '.join(beyond[:3])}"
    return Status.WITHIN, "; ".join([each.says for each in found][:3])


def fault_of_form(path: Path) -> str:
    """Return a fault that xarray does not show: no checksum, groups, idle dimensions."""
    if not path.read_bytes()[-LENGTH:].startswith(MARK):
        return "has lost the checksum in its last line: it was written by another program"
    with netCDF4.Dataset(path) as file:
        used = {name for variable in file.variables.values() for name in variable.dimensions}
        hidden = [*file.groups, *(file.dimensions.keys() - used)]
    return f"has a group or a dimension without a variable: {hidden[0]}" if hidden else ""


def differences(
    name: str, was: xr.Dataset, now: xr.Dataset, accepted: Mapping[str, str], chaos: Chaos
) -> Iterator[Unlike]:
    """Yield all that differs from what is kept; `accepted` are the texts of hashes."""
    yield from _of_attributes("", was.attrs, now.attrs)
    for key in {**was.variables, **now.variables}:
        before, after = was.variables.get(key), now.variables.get(key)
        if before is None or after is None:
            yield Unlike(True, 0, f"{key} is {'gone' if after is None else 'new'}")
            continue
        kind, values, _ = accepted[key].rsplit(" ", 2)
        yield from _of_attributes(f"{key}: ", before.attrs, after.attrs)
        if (now_kind := hashes.kind(after)) != kind:
            yield Unlike(True, 0, f"{key} is {now_kind} in place of {kind}")
        elif hashes.of_values(after) != values:
            yield _of_values(key, before, after, chaos.beyond(name, key, now))


def _of_attributes(where: str, was: Mapping, now: Mapping) -> Iterator[Unlike]:
    before, after = hashes.in_words(was), hashes.in_words(now)
    for key in sorted({*before, *after}):
        pair = after.get(key, "absent"), before.get(key, "absent")
        if pair[0] != pair[1]:
            counts_work = key in WORK and "absent" not in pair
            says = "{}attribute {} is {} in place of {}".format(where, key, *pair)
            yield Unlike(not counts_work, int(counts_work), says)


def _of_values(key: str, was: xr.Variable, now: xr.Variable, beyond: np.ndarray) -> Unlike:
    """Compare values with other bits; `beyond` says which of them cannot be judged."""
    is_text = hashes.are_words(was)
    if is_text or (are_coordinates(key, now) and not beyond.all()):
        return Unlike(True, 0, f"{key} holds other {'words' if is_text else 'coordinates'}")
    before, after = was.values.astype(float), now.values.astype(float)
    largest, is_exact = hashes.largest(before), now.dtype.kind != "f"
    if not is_exact and max(largest, hashes.largest(after)) < ROUNDING:
        return Unlike(False, before.size, f"{key} holds errors of rounding")
    with np.errstate(invalid="ignore"):
        apart = abs(after - before)  # NaN where only one of two is finite, or none
    same = beyond | (before == after) | (np.isnan(before) & np.isnan(after))
    if gaps := int((~same & ~np.isfinite(apart)).sum()):
        return Unlike(True, 0, f"{key} has NaN or infinity elsewhere, at {gaps} places")
    off = float(apart[~same].max(initial=0.0)) / (largest or 1.0)
    allowed = 0.0 if is_exact else TOLERANCE
    if off <= allowed and beyond.any():
        says = f"{beyond.sum()} of {beyond.size} numbers of {key} rest on chaos"
        return Unlike(False, int(beyond.sum()), says)
    says = f"{key} is off by {off:.2g} of its largest value, {allowed:.2g} is allowed"
    return Unlike(off > allowed, 0, says)
