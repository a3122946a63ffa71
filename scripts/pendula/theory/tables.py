"""The shape of what a check returns: coordinates, variables, and which of them decide."""

import numpy as np


def table(title: str, coords: dict, **variables: dict) -> dict:
    """Return a check's numbers in the form that `xarray.Dataset.from_dict` takes."""
    described = {name: variable(values, (name,), name) for name, values in coords.items()}
    return {"coords": described, "data_vars": variables, "attrs": {"title": title}}


def variable(values, dims: tuple, long_name: str, units: str = "1", tolerance=None) -> dict:
    """Return one variable; with a `tolerance` it is an error that a sound check keeps below."""
    attrs = {"long_name": long_name, "units": units}
    if tolerance is not None:
        attrs["tolerance"] = float(tolerance)
    return {"dims": tuple(dims), "data": np.asarray(values), "attrs": attrs}


def broken(check: dict) -> dict[str, float]:
    """Return the deciding variables of a check above their tolerance, with their largest value.

    A value that is not a number counts as broken.
    """
    faults = {}
    for name, entry in check["data_vars"].items():
        if "tolerance" in entry["attrs"]:
            worst = float(np.max(np.asarray(entry["data"], dtype=float), initial=-np.inf))
            if not worst <= entry["attrs"]["tolerance"]:
                faults[name] = worst
    return faults


def values(check: dict, name: str) -> np.ndarray:
    """Return the numbers of one variable of a check."""
    return check["data_vars"][name]["data"]
