"""The checks by name: config/theory.yaml has the arguments of each."""

from collections.abc import Mapping
from typing import Any

import numpy as np

from pendula.numerics import elementary
from pendula.problem import Constants

from . import (
    dispersion,
    equations,
    errata,
    estimates,
    inequalities,
    newton,
    other_forms,
    sharpness,
    stability_chart,
    threshold,
    well_posed,
    worst_data,
)

MODULES = (
    *(equations, other_forms, newton, errata),
    *(dispersion, stability_chart, threshold),
    *(estimates, inequalities, well_posed, worst_data, sharpness),
)

CHECKS = {
    name.removeprefix("check_"): function
    for module in MODULES
    for name, function in vars(module).items()
    if name.startswith("check_")
}
CHECKS["short_chart"] = CHECKS["chart"]


def run_check(name: str, arguments: Mapping[str, Any]) -> dict:
    """Return the numbers of one check; `arguments` are plain values as in the configuration.

    A wrong statement names its `check` among them.
    """
    given = {key: _read(key, value) for key, value in arguments.items()}
    return CHECKS[given.pop("check", name)](**given)


def _read(key: str, value: Any) -> Any:
    if key == "constants":
        return Constants.of(value)
    if isinstance(value, Mapping) and "points" in value:
        spaced = {"linear": np.linspace, "logarithmic": elementary.geometric}[value["spacing"]]
        return spaced(value["first"], value["last"], value["points"])
    return value
