"""Digests of variables: equal digests mean equal values, on any machine."""

import json
from hashlib import sha256
from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from xarray import Dataset


def plain_bytes(values: np.ndarray) -> bytes:
    """Return the content of an array as bytes that do not depend on machine or file format.

    Numbers are little-endian. All NaN become the same bytes, since their sign depends on the
    processor; zeros of different sign remain different.
    """
    if values.dtype.kind in "OUT":
        return json.dumps([str(word) for word in values.flat]).encode()
    if values.dtype.kind == "f":
        values = np.where(np.isnan(values), values.dtype.type(np.nan), values)
    return values.astype(values.dtype.newbyteorder("<")).tobytes()


def digest_values(dimensions: tuple[str, ...], values: Any) -> str:
    """Return the SHA-256 of an array, which covers its dimensions, its type and every bit."""
    array = np.asarray(values)
    kind = "words" if array.dtype.kind in "OUT" else array.dtype.name
    shape = [f"{name}={size}" for name, size in zip(dimensions, array.shape, strict=True)]
    head = "\n".join([kind, *shape, ""]).encode()
    return sha256(head + plain_bytes(array)).hexdigest()


def digest(dataset: "Dataset") -> str:
    """Return the SHA-256 of the names and values of all variables of a dataset."""
    texts = [
        f"{name} {digest_values(variable.dims, variable.values)}"
        for name, variable in sorted(dataset.variables.items())
    ]
    return sha256("\n".join(texts).encode()).hexdigest()


def fingerprint(text: str) -> str:
    """Return the SHA-256 of a text. PNG and PDF files contain the SHA-256 of their description."""
    return sha256(text.encode("utf-8")).hexdigest()
