"""Datasets made small for the baseline, and cut into curves that a rule can name."""

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np
import xarray as xr

MOST_NUMBERS = 10_000
"""A dataset of the baseline keeps at most so many: 40 kB before compression."""


class Curve(NamedTuple):
    """The values of one variable for one choice of its named coordinates (case, component, ...)."""

    label: str
    values: np.ndarray
    tau: np.ndarray | None
    """The time of each value, if it has one, in the shape of the values."""

    @property
    def largest(self) -> float:
        """Return the largest modulus, or infinity for what is exact (words, whole numbers)."""
        if self.values.dtype.kind != "f":
            return np.inf
        return float(abs(self.values[np.isfinite(self.values)]).max(initial=0))


def thin(data: xr.Dataset) -> xr.Dataset:
    """Return the dataset as the baseline keeps it: every 2nd, 4th, ... sample, in single precision.

    Single precision resolves 6e-8, less than any tolerance; longest dimensions are thinned first.
    """
    while sum(variable.size for variable in data.variables.values()) > MOST_NUMBERS:
        longest = max(data.sizes, key=data.sizes.get)
        data = data.isel({longest: slice(None, None, 2)})
    single = {name: _single(variable) for name, variable in data.variables.items()}
    coordinates = {name: single.pop(name) for name in data.coords}
    return xr.Dataset(single, coordinates, {"thinned": "for tests/baseline"})


def _single(variable: xr.Variable) -> xr.Variable:
    kept = xr.Variable(variable.dims, variable.values, dict(variable.attrs))
    return kept.astype("float32") if kept.dtype.kind == "f" else kept


def curves(data: xr.Dataset, stem: str) -> Iterator[Curve]:
    """Yield every variable, one curve for each combination of its dimensions that hold words.

    A label reads `figures/fig3:l2 amplitude=large component=A`.
    """
    for name, variable in data.variables.items():
        words = [dim for dim in variable.dims if dim in data.coords and _is_text(data[dim])]
        array = variable.transpose(*words, ...)
        shape = tuple(variable.sizes[dim] for dim in words)
        tau = _times(data, array.dims[len(words) :], array.shape[len(words) :])
        for index in np.ndindex(shape):
            chosen = [f"{d}={data[d].values[i]}" for d, i in zip(words, index, strict=True)]
            yield Curve(" ".join([f"{stem}:{name}", *chosen]), array.values[index], tau)


def _is_text(array: xr.DataArray) -> bool:
    return array.dtype.kind in "UOT"


def _times(data: xr.Dataset, dims: tuple[str, ...], shape: tuple[int, ...]) -> np.ndarray | None:
    for axis, dim in enumerate(dims):
        for name in (dim, f"{dim}_tau"):
            if name in data.variables and name.endswith("tau"):
                along = [-1 if place == axis else 1 for place in range(len(dims))]
                return np.broadcast_to(data[name].values.reshape(along), shape)
    return None
