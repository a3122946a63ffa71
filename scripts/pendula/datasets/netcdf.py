"""netCDF-4 datasets: every variable has a name for people and units, every file is whole.

Writing needs netCDF4 alone, so that a simulation does not pay for importing xarray.
"""

from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import Any, NamedTuple

import netCDF4
import numpy as np

from . import DatasetError, complete_or_absent, not_written
from .registry import complete, describe
from .seal import check, seal


class Variable(NamedTuple):
    """Values on named dimensions, with CF-style attributes."""

    dimensions: tuple[str, ...]
    values: Any
    long_name: str = ""  # that of the registry
    units: str = "1"
    attributes: Mapping[str, Any] = {}  # others, such as `significant_digits` of rounded values


def write(path: str | Path, variables: Mapping[str, Variable], attributes: Mapping) -> None:
    """Write a dataset; a fault (a full disk, say) leaves no file, and its message names it."""
    try:
        with complete_or_absent(path) as partial:
            with netCDF4.Dataset(partial, "w", format="NETCDF4") as file:
                file.setncatts(complete(attributes, Path(path).stem))
                for name, variable in variables.items():
                    _write_variable(file, name, variable)
            seal(partial)
    except DatasetError:
        raise
    except (OSError, RuntimeError) as error:
        raise not_written(path, error) from error


def as_xarray(variables: Mapping[str, Variable], attributes: Mapping):
    """Return the xarray.Dataset that `read` would return of what `write` writes."""
    import xarray  # here, so that writing does without it

    def one(name: str, variable: Variable) -> xarray.Variable:
        values = np.asarray(variable.values)
        values = values.astype(object) if values.dtype.kind == "U" else values
        words = _attributes(name, variable)
        return xarray.Variable(variable.dimensions, values, words)

    all_of_them = {name: one(name, variable) for name, variable in variables.items()}
    coordinates = {k: v for k, v in all_of_them.items() if v.dims == (k,)}
    values = {k: v for k, v in all_of_them.items() if k not in coordinates}
    return xarray.Dataset(values, coordinates, complete(attributes, "in memory"))


def _attributes(name: str, variable: Variable) -> dict[str, Any]:
    return describe(name, variable.long_name, variable.units) | dict(variable.attributes)


def save(path: str | Path, dataset) -> None:
    """Write an xarray.Dataset as `write` does."""
    stated = dataset.assign_attrs(complete(dataset.attrs, Path(path).stem))
    for name, variable in stated.variables.items():
        about = {key: variable.attrs.get(key, "") for key in ("long_name", "units")}
        variable.attrs.update(describe(str(name), about["long_name"], about["units"] or "1"))
        # CF forbids a missing value in coordinates, and xarray would state one for every variable.
        # It stands beside the compression that the caller may have asked for.
        variable.encoding["_FillValue"] = None
        if _has_checksum(variable.values):
            variable.encoding |= {"fletcher32": True, "contiguous": False}
    try:
        with complete_or_absent(path) as partial:
            stated.to_netcdf(partial, engine="netcdf4", format="NETCDF4")
            seal(partial)
    except DatasetError:
        raise
    except (OSError, RuntimeError) as error:
        raise not_written(path, error) from error


def _has_checksum(values: np.ndarray) -> bool:
    """Return whether HDF5 can keep a checksum of the values: of words and single numbers it cannot.

    These, and all else in a file, are covered by the line that `seal` adds.
    """
    return values.ndim > 0 and values.size > 0 and values.dtype.kind in "biuf"


def _write_variable(file: netCDF4.Dataset, name: str, variable: Variable) -> None:
    values = np.asarray(variable.values)
    for dimension, size in zip(variable.dimensions, values.shape, strict=True):
        if dimension not in file.dimensions:
            file.createDimension(dimension, size)
    if values.dtype.kind == "U":
        target = file.createVariable(name, str, variable.dimensions)
        values = values.astype(object)
    else:
        compression = "zlib" if values.size > 1_000 else None
        checksum = _has_checksum(values)
        target = file.createVariable(
            name, values.dtype, variable.dimensions, compression, fletcher32=checksum
        )
    target.setncatts(_attributes(name, variable))
    target[...] = values


def read(path: str | Path):
    """Return the dataset at `path` as an xarray.Dataset in memory, its file closed.

    Raises DatasetError where it is missing, damaged, or not what was written.
    """
    import xarray  # here, so that writing does without it

    if not isinstance(path, str | Path):
        raise DatasetError(f"this takes the path of a dataset, and not a {type(path).__name__}")
    if not path or Path(path).is_dir():
        raise DatasetError(f"{str(path) or 'an empty path'} is a folder: name a dataset in it")
    with readable(path):
        found = _read_plainly(path)
        return xarray.load_dataset(path, engine="netcdf4") if found is None else found


DECODED = (
    *("_FillValue", "missing_value", "scale_factor", "add_offset", "_Unsigned", "calendar"),
    *("coordinates", "bounds", "grid_mapping", "dtype", "_Encoding", "least_significant_digit"),
)
"""Attributes by which a file of another program says that its numbers stand for others."""
TIMES = (" since ", "day", "hour", "minute", "second")
"""Units of times: xarray makes dates or spans of time of some of them."""


def _read_plainly(path: str | Path):
    """Return the xarray.Dataset of a file whose variables are what they say, else None.

    So are all that `write` and `save` write. xarray's own way, which finds out how each variable is
    encoded and reads it when it is asked for, takes twice as long.
    """
    import xarray

    with netCDF4.Dataset(path) as file:
        file.set_auto_maskandscale(False)
        file.set_auto_chartostring(False)
        holders = [file, *file.variables.values()]
        attributes = [{name: one.getncattr(name) for name in one.ncattrs()} for one in holders]
        if any(_needs_decoding(one) for one in attributes) or any(map(_is_special, holders[1:])):
            return None
        pairs = zip(file.variables.items(), attributes[1:], strict=True)
        variables = {name: _variable(one, about) for (name, one), about in pairs}
    coordinates = {name: one for name, one in variables.items() if one.dims == (name,)}
    values = {name: one for name, one in variables.items() if name not in coordinates}
    return xarray.Dataset(values, coordinates, attributes[0])


def _needs_decoding(attributes: Mapping[str, Any]) -> bool:
    units = str(attributes.get("units", ""))
    return any(name in attributes for name in DECODED) or any(word in units for word in TIMES)


def _is_special(variable: netCDF4.Variable) -> bool:
    return variable.dtype is not str and variable.dtype.kind not in "biuf"


def _variable(found: netCDF4.Variable, attributes: dict[str, Any]):
    """Return an xarray.Variable with the compression of the file, with which it may be kept."""
    import xarray

    if found.dtype is str:
        words = np.asarray(found[...], object)
        words = words.astype(f"U{max(map(len, words.ravel()), default=1) or 1}")
        return xarray.Variable(found.dimensions, words, attributes, {"dtype": words.dtype})
    chunks = found.chunking()
    pieces = {"contiguous": True} if chunks == "contiguous" else {"chunksizes": tuple(chunks)}
    encoding = {**found.filters(), "contiguous": False, **pieces}
    encoding |= {"dtype": found.dtype, "original_shape": found.shape}
    values = np.asarray(found[...])
    return xarray.Variable(found.dimensions, values, attributes, encoding)


@contextmanager
def readable(path: str | Path) -> Iterator[None]:
    """Check the file's seal, and raise DatasetError, which says the way out, for all that fails.

    A damaged file can hold an unreadable name or an impossible size, for which libraries have many
    kinds of errors.
    """
    try:
        check(path)
        yield
    except FileNotFoundError:
        raise DatasetError(f"{path} is missing: run snakemake to make it") from None
    except Exception as error:
        raise DatasetError(
            f"{Path(path).absolute()} is damaged and cannot be read "
            f"({str(error) or type(error).__name__}): delete it and run snakemake to make it again"
        ) from error
