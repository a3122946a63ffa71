"""The checks by name: config/theory.yaml has the arguments of each."""

from collections.abc import Mapping
from typing import Any

import numpy as np

from pendula.problem import Constants

from . import equations, errata, estimates, other_forms, stability_chart, worst_data

CHECKS = {
    name.removeprefix("check_"): function
    for module in (equations, errata, estimates, other_forms, stability_chart, worst_data)
    for name, function in vars(module).items()
    if name.startswith("check_")
}
CHECKS["short_chart"] = CHECKS["chart"]


def run_check(name: str, arguments: Mapping[str, Any]) -> dict:
    """Return the numbers of one check; `arguments` are plain values as in the configuration."""
    return CHECKS[name](**{key: _read(key, value) for key, value in arguments.items()})


def _read(key: str, value: Any) -> Any:
    if key == "constants":
        return Constants.of(value)
    if isinstance(value, Mapping) and "points" in value:
        spaced = {"linear": np.linspace, "logarithmic": np.geomspace}[value["spacing"]]
        return spaced(value["first"], value["last"], value["points"])
    return value
