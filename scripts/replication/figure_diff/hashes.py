"""Hashes of a dataset, independent of byte order and of the sign of NaN; its accepted copy."""

import json
from collections.abc import Mapping
from hashlib import sha256
from pathlib import Path
from typing import Any

import netCDF4
import numpy as np
import xarray as xr
from latticode.datasets import complete_or_absent
from latticode.datasets.digest import digest_values

DIGITS = 16
"""Hexadecimal digits of a hash. The chance that two contents have the same hash is 1e-19."""

NO_RESULT = ("version", "history")
"""Attributes that name the version of this project; they are not hashed."""

LEAST = 1e-30
"""Values are stored in single precision if their largest modulus is between LEAST and 1 / LEAST.
Single precision has a range from 1e-38 to 3e38."""

SINGLE = np.finfo(np.float32).precision
"""Decimal digits of single precision. If more digits of a variable are correct, its attribute
`significant_digits` declares their number."""

FEW, PACKED = 100, {"zlib": True, "complevel": 9, "shuffle": True}


def of_bytes(content: bytes) -> str:
    """Return the hash of bytes."""
    return sha256(content).hexdigest()[:DIGITS]


def of(data: xr.Dataset) -> dict[str, Any]:
    """Return the hash of the attributes, and a text for each variable.

    The text has the variable's kind, the hash of its values and the hash of its attributes.
    """
    variables = {
        name: f"{kind(each)} {of_values(each)} {_of_attributes(each.attrs)}"
        for name, each in data.variables.items()
    }
    return {"attributes": _of_attributes(data.attrs), "variables": variables}


def are_words(variable: xr.Variable) -> bool:
    """Return whether the values of a variable are texts."""
    return variable.dtype.kind in "OUT"


def kind(variable: xr.Variable) -> str:
    """Return type and shape as text, such as `float64 (component 2, tau 2001)`."""
    shape = ", ".join(f"{dimension} {size}" for dimension, size in variable.sizes.items())
    return f"{'words' if are_words(variable) else variable.dtype.name} ({shape})"


def of_values(variable: xr.Variable) -> str:
    """Return the hash of the values and dimension names of a variable."""
    return digest_values(variable.dims, variable.values)[:DIGITS]


def _of_attributes(attributes: Mapping[str, Any]) -> str:
    return of_bytes(json.dumps(attribute_texts(attributes), sort_keys=True).encode())


def attribute_texts(attributes: Mapping[str, Any]) -> dict[str, str]:
    """Return the attributes that are part of the result, each as text with all digits."""
    of_result = {name: each for name, each in attributes.items() if name not in NO_RESULT}
    return {name: json.dumps(np.asarray(each).tolist()) for name, each in of_result.items()}


def keep(copy_path: Path, path: Path) -> None:
    """Copy the dataset at `path` to `copy_path`, compressed and in single precision.

    A variable is copied unchanged if it declares more digits than single precision has.
    """
    with (
        complete_or_absent(copy_path) as partial,
        netCDF4.Dataset(path) as source,
        netCDF4.Dataset(partial, "w") as target,
    ):
        source.set_auto_maskandscale(False)
        target.setncatts(source.__dict__)
        for name, variable in source.variables.items():
            for dimension in variable.get_dims():
                if dimension.name not in target.dimensions:
                    target.createDimension(dimension.name, dimension.size)
            is_text, values = variable.dtype is str, variable[...]
            digits = getattr(variable, "significant_digits", 0)
            values = values if is_text or digits > SINGLE else _single(np.asarray(values))
            packed = {} if is_text or variable.size <= FEW else PACKED
            type_ = str if is_text else values.dtype
            copy = target.createVariable(name, type_, variable.dimensions, **packed)
            copy.set_auto_maskandscale(False)
            copy.setncatts(variable.__dict__)
            copy[...] = values


def _single(values: np.ndarray) -> np.ndarray:
    """Return the values in single precision, or unchanged if the largest is outside its range."""
    size = values.dtype.kind == "f" and (largest(values) or 1.0)
    return values.astype("float32") if LEAST < size < 1 / LEAST else values


def largest(values: np.ndarray) -> float:
    """Return the largest modulus of the finite values."""
    return float(abs(values[np.isfinite(values)]).max(initial=0.0))
