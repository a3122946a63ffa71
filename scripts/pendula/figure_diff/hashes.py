"""What a dataset holds, read once as it is stored: its hashes, and what the baseline keeps of it.

A hash that is the same decides that two variables are the same, to the last bit and with their
attributes, without numbers to compare them with. The hash of a number does not depend on the byte
order of a machine, nor on the sign and the digits that its processor gives to a NaN.
"""

import json
import re
from collections.abc import Mapping
from hashlib import sha256
from pathlib import Path
from typing import Any, NamedTuple

import netCDF4
import numpy as np

from pendula.datasets import complete_or_absent
from pendula.datasets.digest import plain_bytes
from pendula.datasets.netcdf import readable

DIGITS = 16
"""Hexadecimal digits of a hash: by chance one of 1e19 other contents has the same."""

NO_RESULT = ("version", "history")
"""Attributes that name the version of this project. They change with every release, and with no
number, so no hash holds them."""

LEAST = 1e-30
"""Single precision loses digits below 1e-38 and ends at 3e38; this keeps well away from both."""

SINGLE = 7
"""Significant digits of single precision. A variable of which more are right says so by the
attribute `significant_digits`."""

WORK = ("steps", "rejected_steps", "right_hand_sides")
"""Attributes that count what a solver did. They follow its path, so that in chaos they change where
numbers do."""
MOST_WORK = 0.1
"""How far such a count may change, as a part of it: another rounding moved one by 0.09."""

Hashes = dict[str, Any]
"""Of a dataset: the hash of its `attributes`, and its `variables` by name; of a variable its `type`
and `shape` in words, and the hashes of its `values` and `attributes`."""


class Variable(NamedTuple):
    """A variable as a file holds it."""

    dimensions: tuple[str, ...]
    values: np.ndarray
    attributes: dict[str, Any]


class Content(NamedTuple):
    """A dataset as a file holds it: the attributes, and the variables by name.

    What lies in a group of netCDF has the name of the group before its own, as in `group/name`.
    """

    attributes: dict[str, Any]
    variables: dict[str, Variable]


def read(path: Path) -> Content:
    """Return all that the file holds; a damaged one raises DatasetError, which names it."""
    with readable(path), netCDF4.Dataset(path) as file:
        file.set_auto_maskandscale(False)
        file.set_auto_chartostring(False)
        return _content(file)


def _content(holder: netCDF4.Dataset) -> Content:
    attributes = _attributes(holder)
    variables = {name: _variable(found) for name, found in holder.variables.items()}
    for group, inner in ((name, _content(held)) for name, held in holder.groups.items()):
        attributes |= {f"{group}/{name}": each for name, each in inner.attributes.items()}
        variables |= {f"{group}/{name}": each for name, each in inner.variables.items()}
    return Content(attributes, variables)


def _variable(found: netCDF4.Variable) -> Variable:
    return Variable(found.dimensions, np.asarray(found[...]), _attributes(found))


def _attributes(holder: netCDF4.Dataset | netCDF4.Variable) -> dict[str, Any]:
    return {name: holder.getncattr(name) for name in holder.ncattrs()}


def of_bytes(content: bytes) -> str:
    """Return the hash of a file that is no dataset."""
    return sha256(content).hexdigest()[:DIGITS]


def of(content: Content) -> Hashes:
    """Return the hashes of a dataset."""
    variables = {name: _of_variable(each) for name, each in content.variables.items()}
    return {"attributes": _of_attributes(content.attributes), "variables": variables}


def _of_variable(variable: Variable) -> dict[str, str]:
    values = variable.values
    pairs = zip(variable.dimensions, values.shape, strict=True)
    return {
        "type": "words" if values.dtype.kind == "O" else values.dtype.name,
        "shape": ", ".join(f"{dimension} {size}" for dimension, size in pairs),
        "values": of_bytes(plain_bytes(values)),
        "attributes": _of_attributes(variable.attributes),
    }


def _of_attributes(attributes: Mapping[str, Any]) -> str:
    return of_bytes(json.dumps(in_words(attributes), sort_keys=True).encode())


def in_words(attributes: Mapping[str, Any]) -> dict[str, str]:
    """Return the attributes that belong to the result, each as text with all digits."""
    kept = {name: each for name, each in attributes.items() if name not in NO_RESULT}
    return {name: json.dumps(np.asarray(each).tolist()) for name, each in kept.items()}


def in_lines(accepted: Mapping[str, Any]) -> str:
    """Return the hashes by file as JSON, each variable in a line, so that a change is one line."""

    def one_line(variable: re.Match) -> str:
        return "{" + re.sub(r"\n\s*", " ", variable[1]) + "}"

    return re.sub(r'\{\s+("type"[^}]*?)\s+\}', one_line, json.dumps(accepted, indent=1))


def unlike_in_kind(was: Hashes, now: Hashes) -> list[str]:
    """Return in words which variables are gone, new, or of another type or shape."""
    before, after = was["variables"], now["variables"]
    said = [f"{name} is gone" for name in before if name not in after]
    said += [f"{name} is new" for name in after if name not in before]
    for name in before.keys() & after.keys():
        kinds = ["{type} ({shape})".format(**each[name]) for each in (before, after)]
        if kinds[0] != kinds[1]:
            said.append(f"{name} is {kinds[1]} in place of {kinds[0]}")
    return sorted(said)


def unlike_in_values(was: Hashes, now: Hashes) -> list[str]:
    """Return the variables that both have and whose values are others."""
    return [name for name, pair in _both(was, now) if pair[0]["values"] != pair[1]["values"]]


def same_attributes(was: Hashes, now: Hashes) -> bool:
    """Return whether the dataset and the variables that both have hold the same attributes."""
    pairs = [(was, now), *(pair for _, pair in _both(was, now))]
    return all(before["attributes"] == after["attributes"] for before, after in pairs)


def _both(was: Hashes, now: Hashes) -> list[tuple[str, tuple[dict, dict]]]:
    before, after = was["variables"], now["variables"]
    return [(name, (before[name], after[name])) for name in before if name in after]


def unlike_in_attributes(was: Content, now: Content, moved: bool) -> list[str]:
    """Return in words each attribute that differs, of the dataset and of what both hold.

    If numbers have `moved`, counts of a solver's work may have followed them.
    """
    said = []
    for name, pair in _pairs_of_attributes(was, now).items():
        before, after = (in_words(attributes) for attributes in pair)
        for key in sorted({*before, *after}):
            texts = after.get(key, "absent"), before.get(key, "absent")
            if texts[0] != texts[1] and not (moved and _is_same_work(key, *pair)):
                said.append(f"{name}attribute {key} is {texts[0]} in place of {texts[1]}")
    return said


def _pairs_of_attributes(was: Content, now: Content) -> dict[str, tuple[Mapping, Mapping]]:
    both = [name for name in was.variables if name in now.variables]
    held = {f"{name}: ": (was.variables[name], now.variables[name]) for name in both}
    pairs = {name: (pair[0].attributes, pair[1].attributes) for name, pair in held.items()}
    return {"": (was.attributes, now.attributes), **pairs}


def _is_same_work(name: str, was: Mapping[str, Any], now: Mapping[str, Any]) -> bool:
    """Return whether a count of work is as it was, up to MOST_WORK of it or of all steps."""
    if name not in WORK or name not in was or name not in now:
        return False
    whole = max(was[name], was.get("steps", 0))
    return abs(int(now[name]) - int(was[name])) <= MOST_WORK * whole


def as_kept(content: Content) -> Content:
    """Return the content as the baseline keeps it: at every sample, in single precision.

    Single precision resolves 6e-8 of a number, less than any tolerance. A variable stays as it is
    if it declares more digits than that, or if its largest number is too large or too small.
    """
    kept = {n: each._replace(values=_single(each)) for n, each in content.variables.items()}
    return content._replace(variables=kept)


def _single(variable: Variable) -> np.ndarray:
    values, digits = variable.values, variable.attributes.get("significant_digits", 0)
    if values.dtype.kind != "f" or digits > SINGLE:
        return values
    largest = abs(values[np.isfinite(values)]).max(initial=0)
    held = largest == 0 or LEAST < largest < 1 / LEAST
    return values.astype("float32") if held else values


def keep(path: Path, content: Content) -> None:
    """Write the content as it is, compressed as well as netCDF can."""
    with complete_or_absent(path) as partial, netCDF4.Dataset(partial, "w") as file:
        file.setncatts(content.attributes)
        for name, variable in content.variables.items():
            _keep_variable(file, name, variable)


def _keep_variable(file: netCDF4.Dataset, name: str, variable: Variable) -> None:
    for dimension, size in zip(variable.dimensions, variable.values.shape, strict=True):
        if dimension not in file.dimensions:
            file.createDimension(dimension, size)
    kind, packed = variable.values.dtype, {"zlib": True, "complevel": 9, "shuffle": True}
    if kind.kind == "O":
        kind, packed = str, {}
    elif variable.values.size <= 100:
        packed = {}
    target = file.createVariable(name, kind, variable.dimensions, **packed)
    target.set_auto_maskandscale(False)
    target.setncatts(variable.attributes)
    target[...] = variable.values


def as_dataset(content: Content):
    """Return the content as the xarray.Dataset that a reader of the file would get."""
    import xarray as xr  # here, since files with the accepted hashes do without it

    variables = {name: _as_xarray(variable) for name, variable in content.variables.items()}
    return xr.decode_cf(xr.Dataset(variables, attrs=content.attributes))


def _as_xarray(variable: Variable) -> tuple:
    words = variable.values.dtype.kind == "O"
    values = variable.values.astype(str) if words else variable.values
    return variable.dimensions, values, variable.attributes
