"""Digests of variables: two that are equal hold the same values, on any machine."""

import hashlib
from typing import Any

import numpy as np


def digest_values(dimensions: tuple[str, ...], values: Any) -> str:
    """Return the SHA-256 of an array: of its dimensions, its kind of numbers, and every bit.

    Processors write a NaN with either sign, which means nothing, so all NaN count as one. Zeros of
    either sign and infinities stay apart. Words count by their letters and not by how an array
    keeps them.
    """
    array = np.asarray(values)
    if array.dtype.kind in "OUT":
        words = [str(word) for word in array.ravel()]
        kind, content = "words", "".join(f"{len(word)}:{word}" for word in words).encode()
    else:
        if array.dtype.kind == "f":
            array = np.where(np.isnan(array), array.dtype.type(np.nan), array)
        array = np.ascontiguousarray(array, array.dtype.newbyteorder("<"))
        kind, content = array.dtype.str, array.tobytes()
    shape = [f"{name}={size}" for name, size in zip(dimensions, np.shape(values), strict=True)]
    return hashlib.sha256("\n".join([kind, *shape, ""]).encode() + content).hexdigest()


def digest(dataset) -> str:
    """Return the SHA-256 of the variables of an xarray.Dataset: of their names and their values."""
    parts = [
        f"{name} {digest_values(variable.dims, variable.values)}"
        for name, variable in sorted(dataset.variables.items())
    ]
    return hashlib.sha256("\n".join(parts).encode()).hexdigest()
