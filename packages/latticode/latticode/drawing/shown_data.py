"""Names of the rows of data that curves of a figure show; a row is recognised by its values.

A curve that is reversed, scaled or shows a wrong variable has no name or a different name. This
works on any machine, for chaotic data too, because data and figure are from the same run.
"""

from collections.abc import Iterator
from itertools import permutations
from typing import NamedTuple

import numpy as np
import xarray as xr

FEWEST = 4
"""Smallest number of finite values of a row; shorter rows may be equal by chance."""


class Place(NamedTuple):
    """A row or plane of a dataset: its variable, and its index along every other dimension."""

    key: str
    along: tuple[tuple[str, int], ...]

    def name_in(self, data: xr.Dataset) -> str:
        """Return a name such as `l2 [small, A]`."""
        labels = [_label(dimension, index, data) for dimension, index in self.along]
        return f"{self.key} [{', '.join(labels)}]" if labels else self.key


class Rows:
    """The names of the rows and planes of a dataset, by their values."""

    def __init__(self, data: xr.Dataset) -> None:
        self.data = data
        self.known: dict[tuple, dict[bytes, Place]] = {}

    def name(self, values: np.ndarray) -> str:
        """Return the name of the row or plane that has these values, "" if there is none.

        The values may be the start or the end of a row, or a row without its NaN.
        """
        if np.isfinite(values).sum() < FEWEST:
            return ""
        if values.shape not in self.known:
            self.known[values.shape] = dict(reversed([*_contents(self.data, values.shape)]))
        place = self.known[values.shape].get(_content(values))
        return place.name_in(self.data) if place else ""

    def of_curve(self, x: np.ndarray, y: np.ndarray) -> str:
        """Return the names of the rows that a curve shows, such as `l2 [small, A] over tau`."""
        return " over ".join(filter(None, [self.name(y), self.name(x)]))


def _content(values: np.ndarray) -> bytes:
    numbers = np.asarray(values, float)
    return np.where(np.isnan(numbers), np.nan, numbers + 0.0).tobytes()  # no negative zero


def _contents(data: xr.Dataset, shape: tuple[int, ...]) -> Iterator[tuple[bytes, Place]]:
    """Yield content and place of every row or plane, or part of one, that has this shape."""
    for key, variable in data.variables.items():
        if variable.dtype.kind not in "fi":
            continue
        for axes in permutations(range(variable.ndim), len(shape)):
            if all(variable.shape[a] >= size for a, size in zip(axes, shape, strict=True)):
                for place, values in _slices(str(key), variable, axes):
                    finite = values if len(shape) > 1 else values[np.isfinite(values)]
                    candidates = [values, finite, values[: shape[0]], values[-shape[0] :]]
                    yield from (
                        (_content(candidate), place)
                        for candidate in candidates
                        if candidate.shape == shape
                    )


def _slices(
    key: str, variable: xr.Variable, axes: tuple[int, ...]
) -> Iterator[tuple[Place, np.ndarray]]:
    """Yield place and values of each row or plane along `axes` of a variable."""
    remaining = [axis for axis in range(variable.ndim) if axis not in axes]
    dimensions = [str(variable.dims[axis]) for axis in remaining]
    values = variable.values.transpose(*remaining, *axes)
    for indices in np.ndindex(values.shape[: len(remaining)]):
        yield Place(key, tuple(zip(dimensions, indices, strict=True))), values[indices]


def _label(dimension: str, index: int, data: xr.Dataset) -> str:
    """Return the coordinate at an index; if it is a number, the name of the dimension precedes it.

    A dimension without coordinates gets the index instead.
    """
    if dimension not in data.variables:
        return f"{dimension} {index}"
    label = data[dimension].values[index]
    return str(label) if isinstance(label, str) else f"{dimension} {label:.6g}"
