"""Digests of variables: two that are equal hold the same values, on any machine."""

import json
from hashlib import sha256
from typing import Any

import numpy as np


def plain_bytes(values: np.ndarray) -> bytes:
    """Return the content of an array in a form that no machine and no way of keeping it changes.

    Processors write a NaN with either sign, which means nothing, so all NaN are written alike.
    Zeros of either sign and infinities stay apart. Numbers are little-endian.
    """
    if values.dtype.kind in "OUT":
        return json.dumps([str(word) for word in values.flat]).encode()
    if values.dtype.kind == "f":
        values = np.where(np.isnan(values), values.dtype.type(np.nan), values)
    return values.astype(values.dtype.newbyteorder("<")).tobytes()


def digest_values(dimensions: tuple[str, ...], values: Any) -> str:
    """Return the SHA-256 of an array: of its dimensions, its kind of numbers, and every bit."""
    array = np.asarray(values)
    kind = "words" if array.dtype.kind in "OUT" else array.dtype.name
    shape = [f"{name}={size}" for name, size in zip(dimensions, array.shape, strict=True)]
    head = "\n".join([kind, *shape, ""]).encode()
    return sha256(head + plain_bytes(array)).hexdigest()


def digest(dataset) -> str:
    """Return the SHA-256 of the variables of an xarray.Dataset: of their names and their values."""
    texts = [
        f"{name} {digest_values(variable.dims, variable.values)}"
        for name, variable in sorted(dataset.variables.items())
    ]
    return sha256("\n".join(texts).encode()).hexdigest()


def fingerprint(text: str) -> str:
    """Return what PNG and PDF carry of the description that stands beside them: its SHA-256."""
    return sha256(text.encode("utf-8")).hexdigest()
