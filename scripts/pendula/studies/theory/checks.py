"""The checks by name: config/theory.yaml has the arguments of each."""

from collections.abc import Iterator, Mapping
from typing import Any

import numpy as np
import xarray as xr
from latticode.datasets.checks import describe
from latticode.numerics import elementary

from pendula.problem import Constants

from . import errata, estimates, samples, sharpness, stability_chart, threshold

MODULES = (errata, stability_chart, threshold, estimates, samples, sharpness)

CHECKS = {
    name.removeprefix("check_"): function
    for module in MODULES
    for name, function in vars(module).items()
    if name.startswith("check_")
}
CHECKS["short_chart"] = CHECKS["chart"]


def run_checks(checks: Mapping[str, Mapping[str, Any]]) -> Iterator[xr.Dataset]:
    """Yield the numbers of each of `checks`, which have their arguments by name.

    A check that does not hold does not stop the run: it is reported here and in the table of
    claims, and it changes the verdicts that rest on it.
    """
    for name, arguments in checks.items():
        check = run_check(name, arguments)
        print(f"Check of the theory: {describe(name, check)}")
        yield xr.Dataset.from_dict(check)


def run_check(name: str, arguments: Mapping[str, Any]) -> dict:
    """Return the numbers of one check; `arguments` are plain values as in the configuration."""
    spacings = {"linear": np.linspace, "logarithmic": elementary.geometric}
    given = dict(arguments)
    for key, value in arguments.items():
        if key == "constants":
            given[key] = Constants.of(value)
        elif isinstance(value, Mapping) and "points" in value:
            spaced = spacings[value["spacing"]]
            given[key] = spaced(value["first"], value["last"], value["points"])
    return CHECKS[name](**given)
