"""netCDF-4 datasets: each variable has a long name and units, and each file a checksum.

Writing uses only netCDF4, so that a simulation does not import xarray.

Storage can corrupt data silently. HDF5 stores checksums of numeric arrays only: not of text, single
numbers, or the index of the chunks of an array, and a damaged index can crash the HDF5 library. So
each file ends with a seal, a line that HDF5 ignores. It has the SHA-256 of all bytes before it, and
is verified before HDF5 opens the file.
"""

from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from hashlib import sha256
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

import netCDF4
import numpy as np

from . import DatasetError, complete_or_absent, not_written
from .csv_tables import write_csv
from .registry import WAYS, complete, describe

if TYPE_CHECKING:
    from xarray import Dataset

MARK = b"\nSHA-256 of all bytes before this line: "
LENGTH = len(MARK) + 64 + 1
"""Bytes of the seal: the mark, 64 hexadecimal digits and the end of the line."""


class Variable(NamedTuple):
    """Values on named dimensions, with CF attributes."""

    dimensions: tuple[str, ...]
    values: Any
    long_name: str = ""  # if empty, the registry has the long name
    units: str = "1"
    attributes: Mapping[str, Any] = {}  # further attributes, such as `significant_digits`


def write(path: str | Path, variables: Mapping[str, Variable], attributes: Mapping) -> None:
    """Write a dataset; raises DatasetError, and leaves no file, if this fails."""
    with (
        _sealed(path) as partial,
        netCDF4.Dataset(partial, "w", format="NETCDF4") as file,
    ):
        file.setncatts(complete(attributes, Path(path).stem))
        for name, variable in variables.items():
            _write_variable(file, name, variable)


@contextmanager
def _sealed(path: str | Path) -> Iterator[Path]:
    """Yield a path to write to; if the block succeeds, add the seal and rename to `path`."""
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


def as_xarray(variables: Mapping[str, Variable], attributes: Mapping) -> "Dataset":
    """Return the dataset that `write` and then `read` would give."""
    import xarray  # imported here, so that writing does not import xarray

    def as_variable(name: str, variable: Variable) -> xarray.Variable:
        values = np.asarray(variable.values)
        values = values.astype(object) if values.dtype.kind == "U" else values
        words = _attributes(name, variable)
        return xarray.Variable(variable.dimensions, values, words)

    converted = {name: as_variable(name, variable) for name, variable in variables.items()}
    coordinates = {k: v for k, v in converted.items() if v.dims == (k,)}
    values = {k: v for k, v in converted.items() if k not in coordinates}
    return xarray.Dataset(values, coordinates, complete(attributes, "in memory"))


def _attributes(name: str, variable: Variable) -> dict[str, Any]:
    return describe(name, variable.long_name, variable.units) | dict(variable.attributes)


def save(path: str | Path, dataset: "Dataset") -> None:
    """Write a dataset as netCDF, or as a CSV table if the path ends in .csv.

    Raises DatasetError if the suffix is not .nc or .csv, if values are complex, or if the file
    cannot be written.
    """
    if not hasattr(dataset, "data_vars"):
        way = "; convert it by data.to_dataset(name=...)" if hasattr(dataset, "to_dataset") else ""
        raise DatasetError(f"save needs a dataset, not a {type(dataset).__name__}{way}")
    ending = Path(path).suffix
    if ending == ".csv":
        return write_csv(path, dataset)
    if ending not in ("", ".nc"):
        raise DatasetError(f"{path}: datasets are saved as netCDF (.nc) or tables (.csv)")
    if of_complex := [
        str(name) for name, variable in dataset.items() if variable.dtype.kind == "c"
    ]:
        raise DatasetError(
            f"{path}: {of_complex[0]} is complex, but files contain real numbers only: save"
            f" {of_complex[0]}.real and {of_complex[0]}.imag"
        )
    stated = dataset.assign_attrs(complete(dataset.attrs, Path(path).stem))
    for name, variable in stated.variables.items():
        attributes = {key: variable.attrs.get(key, "") for key in ("long_name", "units")}
        variable.attrs.update(
            describe(str(name), attributes["long_name"], attributes["units"] or "1")
        )
        # CF forbids a fill value of coordinates, but xarray would add one to every variable. Other
        # entries of the encoding, such as compression, are kept.
        variable.encoding["_FillValue"] = None
        if _has_checksum(variable.values):
            variable.encoding |= {"fletcher32": True, "contiguous": False}
    with _sealed(path) as partial:
        stated.to_netcdf(partial, engine="netcdf4", format="NETCDF4")


def _has_checksum(values: np.ndarray) -> bool:
    """Return whether HDF5 can store a checksum of the values: only of arrays of numbers."""
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


def read(path: str | Path) -> "Dataset":
    """Read the dataset in a file into memory, close the file, and return the dataset.

    Raises DatasetError if the file is missing, damaged or edited.
    """
    import xarray  # imported here, so that writing does not import xarray

    if not isinstance(path, str | Path):
        raise DatasetError(f"give the path of a dataset, not a {type(path).__name__}")
    if not path or Path(path).is_dir():
        raise DatasetError(f"{str(path) or 'an empty path'} is a folder: give a file in it")
    with readable(path):
        return xarray.load_dataset(path, engine="netcdf4")


@contextmanager
def readable(path: str | Path) -> Iterator[None]:
    """Verify the seal of a file, and turn any error of the block into a DatasetError with a remedy.

    Files without a seal are accepted, since other programs write them. All errors are caught:
    libraries raise many types for damage, such as unreadable names or impossible sizes.
    """
    try:
        content = Path(path).read_bytes()
        written, line = content[:-LENGTH], content[-LENGTH:]
        if line.startswith(MARK) and line != _seal(written):
            raise DatasetError("its content does not match its checksum")
        yield
    except FileNotFoundError:
        raise DatasetError(f"{path} is missing: {WAYS['make']} to make it") from None
    except Exception as error:
        raise DatasetError(
            f"{Path(path).absolute()} is damaged and cannot be read "
            f"({str(error) or type(error).__name__}): delete it and {WAYS['make']} to make it again"
        ) from error
