"""Functions that turn datasets into wrong cases, for the controls of claims and for tests.

Each returns a function from a dataset to the changed dataset. `names` are one or more variables.
`at` restricts the change to labels of coordinates: one label, a list of labels, or a slice that
includes both ends. A dimension without labels has the labels 0, 1, ...
"""

from collections.abc import Callable, Mapping
from typing import Any

import numpy as np
import xarray as xr

from .criterion import UndecidableError

Change = Callable[[xr.Dataset], xr.Dataset]
Names = str | tuple[str, ...]
NEAR = 1e-6
"""Relative tolerance of labels, because accepted files have them in single precision."""


def scale(names: Names, by: float | xr.DataArray, **at: Any) -> Change:
    """Multiply variables."""
    return _in_place(names, lambda values: values * by, at)


def shift(names: Names, by: float, **at: Any) -> Change:
    """Add a number to variables."""
    return _in_place(names, lambda values: values + by, at)


def put(names: Names, to: float, **at: Any) -> Change:
    """Set all values of variables to one number."""
    return _in_place(names, lambda values: xr.full_like(values, to), at)


def roll(names: Names, places: Mapping[str, int], **at: Any) -> Change:
    """Shift values cyclically by some places along dimensions; labels do not change."""
    return _in_place(names, lambda values: values.roll(places, roll_coords=False), at)


def exchange(along: str, *labels: Any, names: Names = ()) -> Change:
    """Exchange the values of `names` (default: all variables) at two labels, or reverse them."""

    def changed(data: xr.Dataset) -> xr.Dataset:
        order = np.arange(data.sizes[along])
        places = [_place(data, along, label) for label in labels] or order
        order[places] = order[places][::-1]
        return _ordered(data, along, order, names)

    return changed


def repeat(along: str, label: Any, at: Any, names: Names = ()) -> Change:
    """Copy the values of `names` (default: all variables) at one label to the labels `at`."""

    def changed(data: xr.Dataset) -> xr.Dataset:
        is_replaced = _is_at(data, along, at)
        order = np.where(is_replaced, _place(data, along, label), np.arange(data.sizes[along]))
        return _ordered(data, along, order, names)

    return changed


def take(**replacements: str) -> Change:
    """Replace the values of variables by values of other variables; attributes do not change."""
    return lambda data: data.assign(
        {
            name: data[replacement].assign_attrs(data[name].attrs)
            for name, replacement in replacements.items()
        }
    )


def take_from(*names: str, **at: Any) -> Callable[[xr.Dataset, xr.Dataset], xr.Dataset]:
    """Return a function of two datasets that copies variables of the second into the first."""
    return lambda data, source: _in_place(names, lambda values: source[values.name], at)(data)


def keep(**at: Any) -> Change:
    """Drop all but these labels."""

    def changed(data: xr.Dataset) -> xr.Dataset:
        return data.isel({along: np.flatnonzero(_is_at(data, along, at[along])) for along in at})

    return changed


def _in_place(names: Names, change: Callable, at: Mapping) -> Change:
    def changed(data: xr.Dataset) -> xr.Dataset:
        is_changed = xr.DataArray(True)
        for along, requested in at.items():
            is_changed = is_changed & _is_at(data, along, requested)
        with xr.set_options(keep_attrs=True):
            return data.assign(
                {name: data[name].where(~is_changed, change(data[name])) for name in _each(names)}
            )

    return changed


def _ordered(data: xr.Dataset, along: str, order: np.ndarray, names: Names) -> xr.Dataset:
    """Return the variables with values in this order along a coordinate; its labels stay."""
    chosen = {name: data.variables[name] for name in _each(names) or data}
    return data.assign(
        {
            n: variable.isel({along: order})
            for n, variable in chosen.items()
            if along in variable.dims
        }
    )


def _each(names: Names) -> tuple[str, ...]:
    return (names,) if isinstance(names, str) else names


def _place(data: xr.Dataset, along: str, label: Any) -> int:
    return int(np.flatnonzero(_is_at(data, along, label))[0])


def _is_at(data: xr.Dataset, along: str, requested: Any) -> xr.DataArray:
    """Return a mask of the requested labels; raise UndecidableError if none of them exists."""
    labels = data[along]
    if isinstance(requested, slice):
        low = -np.inf if requested.start is None else requested.start
        high = np.inf if requested.stop is None else requested.stop
        is_requested = (labels >= low) & (labels <= high)
    elif labels.dtype.kind == "f":
        is_requested = labels.copy(
            data=np.isclose(labels.values[:, None], np.atleast_1d(requested), NEAR, 0.0).any(axis=1)
        )
    else:
        is_requested = labels.isin(np.atleast_1d(requested))
    if not is_requested.any():
        described = (
            f"from {low:g} to {high:g}" if isinstance(requested, slice) else f"= {requested}"
        )
        raise UndecidableError(f"there is no {along} {described}")
    return is_requested
