"""Initial data in all accepted forms: by site, an array, a function, a run, or a file with one.

All of them become {site: [a complex number for each field]}. For second-order equations, the real
part is the value and the imaginary part the velocity.
"""

from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from latticode.equations.model_file import call_on_sites, run_file
from latticode.equations.symbols import ModelError

from .files import PATHS
from .values import as_complex, as_whole, excerpt_of, fault

if TYPE_CHECKING:
    from xarray import DataArray, Dataset

FORMS = (
    "data by site such as {0: [1, 0.1]}, an array of numbers by site, a function of the sites,"
    " a run, or a file of one of these (.nc, .npy, .py)"
)
BySite = Mapping[int, tuple[complex, ...]]


class LabelledFields(NamedTuple):
    """Complex values (field, site) with the names of their fields and the numbers of their sites.

    `fields` is empty if the fields have no names, and `sites` if the sites have no numbers.
    """

    values: np.ndarray
    fields: tuple[str, ...]
    sites: tuple[int, ...]


def read_initial(data: Any) -> Any:
    """Return initial data of any accepted form as a mapping, array, function or `LabelledFields`.

    Raises a validation error for anything else.
    """
    if isinstance(data, str | Path) and Path(data).suffix in PATHS["initial"]:
        data = _read_file(Path(data))
    if isinstance(data, Mapping) and not hasattr(data, "data_vars"):
        return _by_number(data)
    if hasattr(data, "data_vars"):
        data = final_of(data)
    if hasattr(data, "dims"):
        return _labelled(data)
    if callable(data) or isinstance(data, LabelledFields):
        return data
    if isinstance(data, np.ndarray | list | tuple):
        return _as_numbers(data)
    raise fault(f"is {excerpt_of(data)}, not {FORMS}")


def end_of_run(data: Any) -> float | None:
    """Return the end time of a run, or of the run in a file; None for other initial data."""
    if isinstance(data, str | Path) and Path(data).suffix == ".nc" and Path(data).exists():
        data = _read_file(Path(data))
    end = getattr(data, "attrs", {}).get("end_time") if hasattr(data, "data_vars") else None
    return None if end is None else float(end)


def _by_number(data: Mapping) -> dict[int, list]:
    """Return initial data with integer sites as keys; rejects duplicate sites."""
    by_site: dict = {}
    for key, values in data.items():
        site = as_whole(key)
        if site in by_site and len(by_site) < len(data):
            raise fault(f'site {site} is given twice ({site} and "{site}")')
        values = values.tolist() if isinstance(values, np.ndarray) else values
        if not isinstance(values, list | tuple):
            raise fault(
                f"site {site} has {excerpt_of(values)}; give a list with a value for each field"
            )
        by_site[site] = values
    return by_site


def _read_file(path: Path) -> Any:
    """Return the dataset or array in a file, or the variable `initial` of a Python file."""
    from latticode.datasets import DatasetError, netcdf  # imported here: few cases read a file

    try:
        if path.suffix == ".nc":
            return netcdf.read(path)
        if path.suffix == ".npy":
            return np.load(path, allow_pickle=False)
        names = run_file(path, path.read_text(encoding="utf-8"))
    except (DatasetError, ModelError) as error:
        raise fault(str(error)) from None
    except (OSError, ValueError) as error:
        raise fault(f"{path} cannot be read: {error}") from None
    if "initial" not in names:
        text = "does not define the variable initial, a function of the sites or an array"
        raise fault(f"{path.name} {text}")
    return names["initial"]


def final_of(run: "Dataset") -> Any:
    """Return the fields at the end of a run: its `final`, or the last snapshot of its `state`."""
    if "final" in run:
        return run["final"]
    if "state" in run and float(run["snapshot_tau"][-1]) == float(run.attrs["end_time"]):
        return run["state"].isel(snapshot=-1)
    raise fault("is a dataset without the fields at the end of a run: it has no variable final")


def _labelled(array: "DataArray") -> LabelledFields:
    """Return a DataArray over `site`, optionally `component` and `part`, as `LabelledFields`."""
    known = ("component", "part", "site")
    if more := [str(name) for name in array.dims if name not in known]:
        raise fault(f"has the dimension {more[0]}; select one value, as by .sel({more[0]}=...)")
    if "site" not in array.dims:
        raise fault("has no dimension site")
    values = array.transpose(*(name for name in known if name in array.dims)).values
    if "part" in array.dims:
        re_im = np.moveaxis(values, values.ndim - 2, 0)
        values = re_im[0] + 1j * re_im[1] if len(re_im) > 1 else re_im[0]
    if "component" not in array.dims:
        values = values[None]
    names = array["component"].values if "component" in array.dims else []
    sites = array["site"].values if "site" in array.coords else []
    return LabelledFields(
        _as_numbers(values), tuple(map(str, names)), tuple(int(site) for site in sites)
    )


def _as_numbers(raw_value: Any) -> np.ndarray:
    """Return an array of complex numbers; rejects everything else."""
    try:
        values = np.asarray(raw_value)
    except ValueError:
        raise fault(f"is {excerpt_of(raw_value)}, with rows of different lengths") from None
    if values.dtype.kind == "U":  # complex numbers as Python writes them
        values = np.reshape([as_complex(text) for text in values.flat], values.shape)
    if values.dtype.kind not in "iufc" or not values.size:
        raise fault(f"is {excerpt_of(raw_value)}, not {FORMS}")
    return values.astype(complex) + 0.0


def fields_on(data: Any, names: Sequence[str], sites: Sequence[int]) -> BySite:
    """Return initial data {site: [a value for each of the named fields]} on the sites of a chain.

    Raises ValueError if data do not fit the chain; the message completes "initial ...".
    """
    if isinstance(data, Mapping):
        return data
    if isinstance(data, LabelledFields):
        values, sites = _of_labels(data, names, sites)
    else:
        values = _called(data, len(names), np.array(sites)) if callable(data) else data
        values = _of_shape(values, len(names), len(sites))
    wrong = np.argwhere(~np.isfinite(values))
    if wrong.size:
        field, place = wrong[0]
        value = values[field, place]
        number = value if value.imag else value.real
        raise ValueError(f"is {number:g} at site {sites[place]}, which is not finite")
    moving = np.flatnonzero((values != 0).any(axis=0))
    columns = moving if moving.size else [len(sites) // 2]
    return {int(sites[j]): tuple(map(complex, values[:, j])) for j in columns}


def _of_labels(
    data: LabelledFields, names: Sequence[str], sites: Sequence[int]
) -> tuple[np.ndarray, Sequence[int]]:
    values = data.values
    if data.fields:
        if absent := [name for name in names if name not in data.fields]:
            raise ValueError(f"has no field {absent[0]}; it has {', '.join(data.fields)}")
        values = values[[data.fields.index(name) for name in names]]
    if data.sites:
        return _of_shape(values, len(names), len(data.sites)), data.sites
    return _of_shape(values, len(names), len(sites)), sites


def _called(function: Callable, fields: int, sites: np.ndarray) -> Any:
    """Return the values of a function of the sites; it may return an array for each field."""

    def on_sites(sites: np.ndarray) -> Any:
        values = function(sites)
        if isinstance(values, tuple | list) and len(values) == fields != 1:
            return np.array([np.broadcast_to(of_field, sites.shape) for of_field in values])
        number = np.ndim(values) == 0 and not isinstance(values, str)
        return np.broadcast_to(values, sites.shape) if number else values

    return call_on_sites(on_sites, sites)


def _of_shape(data: Any, fields: int, sites: int) -> np.ndarray:
    """Return values as a complex array (field, site)."""
    values = np.asarray(data)
    if values.dtype.kind not in "iufc":
        raise ValueError(f"is {excerpt_of(data)}, not numbers")
    if values.ndim == 1 and fields == 1:
        values = values[None]
    if values.shape != (fields, sites):
        size = " x ".join(map(str, values.shape[fields == 1 == len(values) < values.ndim :]))
        needed = f"{sites} sites" if fields == 1 else f"{fields} fields on {sites} sites"
        raise ValueError(f"has {size} values for {needed}")
    return values.astype(complex) + 0.0
