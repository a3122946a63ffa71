"""What a check returns: coordinates, variables, and the tolerances of those that decide."""

from collections.abc import Iterable, Mapping

import numpy as np

from .registry import NAMES


def table(title: str, coords: dict, **variables: dict) -> dict:
    """Return a check's numbers in the form that `xarray.Dataset.from_dict` takes.

    Coordinates have the long names of the registry, or their own names in words.
    """
    described = {
        name: variable(values, (name,), NAMES.get(name, name.replace("_", " ")))
        for name, values in coords.items()
    }
    return {"coords": described, "data_vars": variables, "attrs": {"title": title}}


def variable(
    values, dims: Iterable[str], long_name: str, units: str = "1", tolerance=None, digits=None
) -> dict:
    """Return one variable; if it has a `tolerance`, a sound check keeps the values below that.

    Where a library decides the last bits of the values, they are `rounded` to so many `digits`.
    """
    attrs = {"long_name": long_name, "units": units}
    if digits is not None:
        values, attrs["significant_digits"] = rounded(values, digits), digits
    if tolerance is not None:
        attrs["tolerance"] = float(tolerance)
    return {"dims": tuple(dims), "data": np.asarray(values), "attrs": attrs}


def rounded(values, digits: int) -> np.ndarray:
    """Return the values rounded to so many significant digits."""
    values = np.asarray(values, dtype=float)
    texts = [f"{value:.{digits}g}" for value in values.ravel()]
    return np.array(texts, dtype=float).reshape(values.shape)


def columns(dims: Iterable[str], descriptions: Mapping, numbers: Mapping) -> dict[str, dict]:
    """Return variables of the same dimensions: the `numbers` by their names.

    `descriptions` has the long name of each, or a pair of that and its tolerance.
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
    """Return the table of `rows`: the numbers at each point of `coords`, whose last one runs first.

    Only the numbers of a row that `descriptions` describes are stored, as by `columns`; `more` are
    variables of other dimensions.
    """
    rows, shape = list(rows), tuple(len(points) for points in coords.values())
    numbers = {name: np.reshape([row[name] for row in rows], shape) for name in descriptions}
    return table(title, coords, **columns(coords, descriptions, numbers), **more)


def deciding(check: dict) -> dict[str, tuple[float, float]]:
    """Return (largest value, tolerance) of each deciding variable of a check.

    Takes a check, or what `xarray.Dataset.to_dict` makes of its dataset.
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
    """Return the deciding variables of a check above their tolerance, with their largest value.

    A value that is not a number counts as broken.
    """
    return {name: worst for name, (worst, limit) in deciding(check).items() if not worst <= limit}


def describe(name: str, check: dict) -> str:
    """Return a line for each deciding variable above its tolerance, or that the check holds."""
    faults = [
        f"CHECK VIOLATED: {name}: {variable} is {worst:.6g}, tolerance {limit:.6g}"
        for variable, (worst, limit) in deciding(check).items()
        if not worst <= limit
    ]
    return "\n".join(faults) or f"{name} holds"
