"""The checks by name: config/theory.yaml has the arguments of each."""

from collections.abc import Iterator, Mapping
from typing import Any

import numpy as np
import xarray as xr
from latticode.datasets.checks import describe

from . import errata, sharpness, stability
from .equations import constants_at

CHECKS = {
    name.removeprefix("check_"): function
    for module in (errata, stability, sharpness)
    for name, function in vars(module).items()
    if name.startswith("check_")
}


def run_checks(checks: Mapping[str, Mapping[str, Any]]) -> Iterator[xr.Dataset]:
    """Yield the numbers of each of `checks`, which have their arguments by name."""
    for name, arguments in checks.items():
        check = run_check(name, arguments)
        print(f"Check of the theory: {describe(name, check)}")
        yield xr.Dataset.from_dict(check)


def run_check(name: str, arguments: Mapping[str, Any]) -> dict:
    """Return the numbers of one check; `arguments` are plain values as in the configuration."""
    given = dict(arguments)
    for key, value in arguments.items():
        if isinstance(value, Mapping) and "points" in value:
            given[key] = np.linspace(value["first"], value["last"], value["points"])
    found = CHECKS[name](**given)
    return {**found, "attrs": {"epsilon": constants_at(0.0).epsilon, **found["attrs"]}}
