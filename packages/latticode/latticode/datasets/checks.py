"""Checks as datasets: coordinates and variables, some of them with a tolerance."""

from collections.abc import Iterable, Mapping

import numpy as np
from numpy.typing import ArrayLike

from .registry import NAMES


def table(title: str, coords: dict, **variables: dict) -> dict:
    """Return the numbers of a check as a dictionary for `xarray.Dataset.from_dict`.

    The long name of a coordinate is from the registry, or is its name with spaces for underscores.
    """
    described = {
        name: variable(values, (name,), NAMES.get(name, name.replace("_", " ")))
        for name, values in coords.items()
    }
    return {"coords": described, "data_vars": variables, "attrs": {"title": title}}


def variable(
    values: ArrayLike,
    dims: Iterable[str],
    long_name: str,
    units: str = "1",
    tolerance: float | None = None,
    digits: int | None = None,
) -> dict:
    """Return a variable of a check. The check fails if a value exceeds the `tolerance`.

    Pass `digits`, the number of significant digits to round to, if last bits depend on a library.
    """
    attrs = {"long_name": long_name, "units": units}
    if digits is not None:
        values, attrs["significant_digits"] = rounded(values, digits), digits
    if tolerance is not None:
        attrs["tolerance"] = float(tolerance)
    return {"dims": tuple(dims), "data": np.asarray(values), "attrs": attrs}


def rounded(values: ArrayLike, digits: int) -> np.ndarray:
    """Return the values rounded to this number of significant `digits`."""
    values = np.asarray(values, dtype=float)
    texts = [f"{value:.{digits}g}" for value in values.ravel()]
    return np.array(texts, dtype=float).reshape(values.shape)


def columns(dims: Iterable[str], descriptions: Mapping, numbers: Mapping) -> dict[str, dict]:
    """Return variables of the same dimensions from arrays of `numbers` by name.

    `descriptions` has, by name, a long name or a pair (long name, tolerance).
    """
    pairs = {
        name: (description, None) if isinstance(description, str) else description
        for name, description in descriptions.items()
    }
    return {
        name: variable(values, dims, pairs[name][0], tolerance=pairs[name][1])
        for name, values in numbers.items()
    }


def tabulate(
    title: str, coords: dict, rows: Iterable[Mapping], descriptions: Mapping, **more: dict
) -> dict:
    """Return the table of `rows`, one row for each point of `coords`, the last coordinate fastest.

    A row has numbers by name. Only numbers named in `descriptions` (see `columns`) are stored.
    `more` are variables of other dimensions.
    """
    rows, shape = list(rows), tuple(len(points) for points in coords.values())
    numbers = {name: np.reshape([row[name] for row in rows], shape) for name in descriptions}
    return table(title, coords, **columns(coords, descriptions, numbers), **more)


def deciding(check: dict) -> dict[str, tuple[float, float]]:
    """Return (largest value, tolerance) for each variable of a check with a tolerance, by name.

    `check` is from `table`, or from `xarray.Dataset.to_dict`.
    """
    return {
        name: (
            float(np.max(np.asarray(entry["data"], dtype=float), initial=-np.inf)),
            float(entry["attrs"]["tolerance"]),
        )
        for name, entry in check["data_vars"].items()
        if "tolerance" in entry["attrs"]
    }


def broken(check: dict) -> dict[str, float]:
    """Return the largest values of the variables that exceed their tolerance, by name.

    NaN counts as exceeding it.
    """
    return {name: worst for name, (worst, limit) in deciding(check).items() if not worst <= limit}


def describe(name: str, check: dict) -> str:
    """Return a line for each variable that exceeds its tolerance, or "NAME holds" if none does."""
    faults = [
        f"CHECK VIOLATED: {name}: {variable} is {worst:.6g}, tolerance {limit:.6g}"
        for variable, (worst, limit) in deciding(check).items()
        if not worst <= limit
    ]
    return "\n".join(faults) or f"{name} holds"
