"""netCDF-4 datasets: every variable has a name for people and units, every file is whole.

Writing needs netCDF4 alone, so that a simulation does not pay for importing xarray.

Each file ends with a digest, because storage can corrupt data silently. HDF5 can keep a checksum of
each array of numbers, and every reader then detects a changed number. It keeps none for text, for
single numbers, and for the tables of the places of an array's pieces; a damaged table can crash the
HDF5 library. So the last line of a file, which HDF5 ignores, holds the SHA-256 of all bytes before
it, which is verified before HDF5 opens the file.
"""

from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from hashlib import sha256
from pathlib import Path
from typing import Any, NamedTuple

import netCDF4
import numpy as np

from . import DatasetError, complete_or_absent, not_written
from .csv_tables import write_csv
from .registry import WAYS, complete, describe

MARK = b"\nSHA-256 of all bytes before this line: "
LENGTH = len(MARK) + 64 + 1
"""Bytes of the seal: the mark, 64 hexadecimal digits and the end of the line."""


class Variable(NamedTuple):
    """Values on named dimensions, with CF-style attributes."""

    dimensions: tuple[str, ...]
    values: Any
    long_name: str = ""  # that of the registry
    units: str = "1"
    attributes: Mapping[str, Any] = {}  # others, such as `significant_digits` of rounded values


def write(path: str | Path, variables: Mapping[str, Variable], attributes: Mapping) -> None:
    """Write a dataset; a fault (a full disk, say) leaves no file, and its message names it."""
    with (
        _sealed(path) as partial,
        netCDF4.Dataset(partial, "w", format="NETCDF4") as file,
    ):
        file.setncatts(complete(attributes, Path(path).stem))
        for name, variable in variables.items():
            _write_variable(file, name, variable)


@contextmanager
def _sealed(path: str | Path) -> Iterator[Path]:
    """Yield a path to write to; if that succeeds, add the seal, and rename the file to `path`."""
    try:
        with complete_or_absent(path) as partial:
            yield partial
            seal = _seal(partial.read_bytes())
            with open(partial, "ab") as file:
                file.write(seal)
    except DatasetError:
        raise
    except (OSError, RuntimeError) as error:
        raise not_written(path, error) from error


def _seal(content: bytes) -> bytes:
    return MARK + sha256(content).hexdigest().encode() + b"\n"


def as_xarray(variables: Mapping[str, Variable], attributes: Mapping):
    """Return the xarray.Dataset that `read` would return of what `write` writes."""
    import xarray  # here, so that writing does without it

    def as_variable(name: str, variable: Variable) -> xarray.Variable:
        values = np.asarray(variable.values)
        values = values.astype(object) if values.dtype.kind == "U" else values
        words = _attributes(name, variable)
        return xarray.Variable(variable.dimensions, values, words)

    all_of_them = {name: as_variable(name, variable) for name, variable in variables.items()}
    coordinates = {k: v for k, v in all_of_them.items() if v.dims == (k,)}
    values = {k: v for k, v in all_of_them.items() if k not in coordinates}
    return xarray.Dataset(values, coordinates, complete(attributes, "in memory"))


def _attributes(name: str, variable: Variable) -> dict[str, Any]:
    return describe(name, variable.long_name, variable.units) | dict(variable.attributes)


def save(path: str | Path, dataset) -> None:
    """Write an xarray.Dataset as `write` does, or as a table where the path ends in .csv.

    Raises DatasetError for any other ending than .csv and .nc.
    """
    if not hasattr(dataset, "data_vars"):
        way = "; data.to_dataset(name=...) makes one" if hasattr(dataset, "to_dataset") else ""
        raise DatasetError(f"this saves a dataset, and not a {type(dataset).__name__}{way}")
    ending = Path(path).suffix
    if ending == ".csv":
        return write_csv(path, dataset)
    if ending not in ("", ".nc"):
        raise DatasetError(f"{path}: datasets are saved as netCDF (.nc) or tables (.csv)")
    if of_complex := [
        str(name) for name, variable in dataset.items() if variable.dtype.kind == "c"
    ]:
        raise DatasetError(
            f"{path}: {of_complex[0]} is complex, and files hold real numbers: save its parts,"
            f" {of_complex[0]}.real and {of_complex[0]}.imag"
        )
    stated = dataset.assign_attrs(complete(dataset.attrs, Path(path).stem))
    for name, variable in stated.variables.items():
        attributes = {key: variable.attrs.get(key, "") for key in ("long_name", "units")}
        variable.attrs.update(
            describe(str(name), attributes["long_name"], attributes["units"] or "1")
        )
        # CF forbids a missing value in coordinates, and xarray would state one for every variable.
        # It stands beside the compression that the caller may have asked for.
        variable.encoding["_FillValue"] = None
        if _has_checksum(variable.values):
            variable.encoding |= {"fletcher32": True, "contiguous": False}
    with _sealed(path) as partial:
        stated.to_netcdf(partial, engine="netcdf4", format="NETCDF4")


def _has_checksum(values: np.ndarray) -> bool:
    """Return whether HDF5 can keep a checksum of the values: not of words and single numbers."""
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
        return xarray.load_dataset(path, engine="netcdf4")


@contextmanager
def readable(path: str | Path) -> Iterator[None]:
    """Check the file's seal, and raise DatasetError, which says the way out, for all that fails.

    A file without a seal is left to HDF5, since other programs write such files. A damaged file can
    hold an unreadable name or an impossible size, for which libraries have many kinds of errors.
    """
    try:
        content = Path(path).read_bytes()
        written, line = content[:-LENGTH], content[-LENGTH:]
        if line.startswith(MARK) and line != _seal(written):
            raise DatasetError("its content is not the one that was written")
        yield
    except FileNotFoundError:
        raise DatasetError(f"{path} is missing: {WAYS['make']} to make it") from None
    except Exception as error:
        raise DatasetError(
            f"{Path(path).absolute()} is damaged and cannot be read "
            f"({str(error) or type(error).__name__}): delete it and {WAYS['make']} to make it again"
        ) from error
