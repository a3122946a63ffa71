"""Compares a dataset with the accepted one: first hashes, then the numbers of unequal variables.

Texts, coordinates, attributes, types and shapes must be equal. The module `values` has the
tolerances of numbers. Numbers that rest on chaos cannot be compared, but must be within its limits.
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
"""Attributes that count a solver's work: rounding changes them, in regular runs too."""

SHOWN_OTHERWISE = ("coordinates",)
"""Attributes of the file that xarray turns into coordinates of the dataset."""


class VariableDifference(NamedTuple):
    """A difference of a variable; `beyond` is how many numbers chaos makes incomparable."""

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
    """Return the status of the dataset `name` in the file `new`, and the reason.

    `accepted` is the record of the dataset in the baseline (see `hashes.of`), `accepted_copy` its
    file in the baseline. For `scatter` see the module of this name; for `steps` see `values.jumps`.
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
    """Return a message: why undeclared variables cannot be compared, and the attribute to add."""
    return (
        f"{variables[0]} does not declare whether it rests on chaos, and its dataset names no case:"
        f' in its code set the attribute {CHAOS} = "{NO}" or "{YES}", see docs/another_paper.md'
    )


def fault_of_form(path: Path, content: xr.Dataset) -> str:
    """Return what is wrong with the form of a file: no checksum, or parts that xarray hides.

    Hidden parts are groups, types, unused or unlimited dimensions, and attributes that xarray uses
    to decode values. `content` is the file as xarray reads it.
    """
    if not path.read_bytes()[-LENGTH:].startswith(MARK):
        return "has no checksum at its end: another program wrote it"
    with netCDF4.Dataset(path) as file:
        used = {name for variable in file.variables.values() for name in variable.dimensions}
        unlimited = [name for name, each in file.dimensions.items() if each.isunlimited()]
        hidden = {
            "group": [*file.groups],
            "type": [*file.cmptypes, *file.enumtypes, *file.vltypes],
            "dimension without a variable": [*(file.dimensions.keys() - used)],
            "unlimited dimension": unlimited,
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
    """Yield each difference of two datasets; `accepted` has the texts of `hashes.of` by name."""
    yield from _of_attributes("", was.attrs, now.attrs)
    for key in {**was.variables, **now.variables}:
        before, after = was.variables.get(key), now.variables.get(key)
        if before is None or after is None:
            reason = f"{key} is {'missing' if after is None else 'not in the baseline'}"
            yield VariableDifference(True, 0, reason)
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
    before, after = hashes.attribute_texts(was), hashes.attribute_texts(now)
    for key in sorted({*before, *after}):
        pair = after.get(key, "absent"), before.get(key, "absent")
        if pair[0] != pair[1]:
            counts_work = key in WORK and "absent" not in pair
            reason = "{}attribute {} is {} in place of {}".format(where, key, *pair)
            yield VariableDifference(not counts_work, int(counts_work), reason)


def _of_labels(key: str, now: xr.Variable, time: str) -> VariableDifference | None:
    """Return the difference of texts or coordinates; None if they are equal, and for numbers."""
    if hashes.are_words(now):
        return VariableDifference(True, 0, f"the texts of {key} differ")
    if are_coordinates(key, now, time):
        return VariableDifference(True, 0, f"the coordinates {key} differ")
    return None


def _of_values(
    key: str,
    was: xr.Variable,
    now: xr.Variable,
    freedom: np.ndarray,
    data: xr.Dataset,
    scatter: float | None,
) -> VariableDifference:
    """Return the difference of values that are not bit-identical; see `values.fault`."""
    chaotic = freedom > 0.0
    if fault := values.fault(key, was, now, freedom, data, scatter):
        return VariableDifference(True, 0, fault)
    count = int(chaotic.sum())
    of_chaos = f"{count} of {chaotic.size} numbers of {key} rest on chaos"
    reason = of_chaos if count else f"{key} is off by rounding errors"
    return VariableDifference(False, count, reason)
