"""Compares a dataset with the accepted one: by its hashes, and where they differ by its numbers.

Words, coordinates, attributes, types and shapes must be equal, and numbers agree as `values` says.
Those that rest on chaos are beyond comparison, but obey its limits.
"""

from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any, NamedTuple

import netCDF4
import numpy as np
import xarray as xr
from latticode.datasets.netcdf import LENGTH, MARK, DatasetError, read

from replication.variables import CHAOS, NO, YES

from . import Status, hashes, values
from .chaos import Chaos, are_coordinates

WORK = ("steps", "rejected_steps", "right_hand_sides")
"""Attributes that count what a solver did: they follow every rounding, also of a regular run."""


SHOWN_OTHERWISE = ("coordinates",)
"""Attributes that xarray shows by what they mean."""


class VariableDifference(NamedTuple):
    """One thing that differs: if it is a fault, how many numbers cannot be judged, in words."""

    is_fault: bool
    beyond: int
    reason: str


def compare(
    name: str,
    new: Path,
    accepted: Mapping[str, Any],
    accepted_copy: Path,
    chaos: Chaos,
    scatter: Mapping[str, float],
    steps: tuple[str, ...] = (),
) -> tuple[Status, str]:
    """Return status and reason of the dataset `name`, in the file `new`, with its accepted hashes.

    `accepted_copy` is the file in the baseline, `scatter` that of chaotic variables by right runs
    (see the module `scatter`), and `steps` are the dimensions of `values.jumps`.
    """
    try:
        content = read(new)
    except DatasetError:
        return Status.DAMAGED, "cannot be read"
    if fault := fault_of_form(new, content):
        return Status.DAMAGED, fault
    if hashes.of(content).items() <= accepted.items():
        return Status.IDENTICAL, ""
    if undeclared := chaos.undeclared(name, content):
        return Status.DIFFERENT, undeclared_words(undeclared)
    was = read(accepted_copy)
    unlike = list(differences(name, was, content, accepted["variables"], chaos, scatter))
    faults = [each.reason for each in unlike if each.is_fault]
    if faults := faults or [*values.jumps(was, content, steps)]:
        return Status.DIFFERENT, "; ".join(faults[:3])
    if beyond := [each.reason for each in unlike if each.beyond]:
        count = sum(each.beyond for each in unlike)
        return Status.BEYOND, f"{count} numbers cannot be compared, because {'; '.join(beyond[:3])}"
    return Status.WITHIN, "; ".join([each.reason for each in unlike][:3])


def undeclared_words(variables: list[str]) -> str:
    """Return why variables cannot be compared, and what their maker must write."""
    return (
        f"{variables[0]} does not say whether it rests on chaos, and its data name no case: let "
        f'its maker write the attribute {CHAOS} = "{NO}" or "{YES}", see docs/another_paper.md'
    )


def fault_of_form(path: Path, content: xr.Dataset) -> str:
    """Return what a file holds beside its `content` as xarray shows it, or that it has no checksum.

    That is groups, types, dimensions without a variable or without an end, and attributes by which
    xarray turns values into others.
    """
    if not path.read_bytes()[-LENGTH:].startswith(MARK):
        return "has lost the checksum in its last line: it was written by another program"
    with netCDF4.Dataset(path) as file:
        used = {name for variable in file.variables.values() for name in variable.dimensions}
        endless = [name for name, each in file.dimensions.items() if each.isunlimited()]
        hidden = {
            "group": [*file.groups],
            "type": [*file.cmptypes, *file.enumtypes, *file.vltypes],
            "dimension without a variable": [*(file.dimensions.keys() - used)],
            "dimension without an end": endless,
            "hidden attribute": [
                f"{name}:{key}"
                for name, variable in file.variables.items()
                for key in variable.ncattrs()
                if key not in (*content.variables[name].attrs, *SHOWN_OTHERWISE)
            ],
        }
    faults = [f"has a {kind}: {names[0]}" for kind, names in hidden.items() if names]
    return faults[0] if faults else ""


def differences(
    name: str,
    was: xr.Dataset,
    now: xr.Dataset,
    accepted: Mapping[str, str],
    chaos: Chaos,
    scatter: Mapping[str, float],
) -> Iterator[VariableDifference]:
    """Yield all that differs from what is kept; `accepted` are the texts of hashes."""
    yield from _of_attributes("", was.attrs, now.attrs)
    for key in {**was.variables, **now.variables}:
        before, after = was.variables.get(key), now.variables.get(key)
        if before is None or after is None:
            yield VariableDifference(True, 0, f"{key} is {'gone' if after is None else 'new'}")
            continue
        kind, hash_of_values, _ = accepted[key].rsplit(" ", 2)
        yield from _of_attributes(f"{key}: ", before.attrs, after.attrs)
        if (now_kind := hashes.kind(after)) != kind:
            yield VariableDifference(True, 0, f"{key} is {now_kind} in place of {kind}")
        elif hashes.of_values(after) != hash_of_values:
            known = scatter.get(f"{name.removesuffix('.nc')}:{key}")
            if fault := _of_labels(key, after, chaos.time):
                yield fault
                continue
            yield _of_values(key, before, after, chaos.freedom(name, key, now), now, known)


def _of_attributes(where: str, was: Mapping, now: Mapping) -> Iterator[VariableDifference]:
    before, after = hashes.in_words(was), hashes.in_words(now)
    for key in sorted({*before, *after}):
        pair = after.get(key, "absent"), before.get(key, "absent")
        if pair[0] != pair[1]:
            counts_work = key in WORK and "absent" not in pair
            reason = "{}attribute {} is {} in place of {}".format(where, key, *pair)
            yield VariableDifference(not counts_work, int(counts_work), reason)


def _of_labels(key: str, now: xr.Variable, time: str) -> VariableDifference | None:
    """Return the fault of words or coordinates with other values; None for numbers."""
    if hashes.are_words(now):
        return VariableDifference(True, 0, f"{key} holds other words")
    if are_coordinates(key, now, time):
        return VariableDifference(True, 0, f"{key} holds other coordinates")
    return None


def _of_values(
    key: str,
    was: xr.Variable,
    now: xr.Variable,
    freedom: np.ndarray,
    data: xr.Dataset,
    scatter: float | None,
) -> VariableDifference:
    """Compare values with other bits; `freedom` says which of them rest on chaos."""
    chaotic = freedom > 0.0
    if fault := values.fault(key, was, now, freedom, data, scatter):
        return VariableDifference(True, 0, fault)
    count = int(chaotic.sum())
    of_chaos = f"{count} of {chaotic.size} numbers of {key} rest on chaos"
    return VariableDifference(False, count, of_chaos if count else f"{key} is off by roundings")
