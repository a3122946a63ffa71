"""The checks by name: config/theory.yaml has the arguments of each."""

from collections.abc import Mapping
from typing import Any

import numpy as np

from pendula.problem import Constants

from .equations import check_conservation, check_dispersion, check_gradient
from .errata import (
    check_energy_drift,
    check_negative_depth,
    check_not_shown,
    check_opposite,
    check_theorem_2_case,
    check_theorem_3_constant,
)
from .estimates import check_balance, check_growth, check_inequalities
from .other_forms import check_expansion, check_pt_form, check_symmetries
from .stability_chart import check_chart, check_measured_windows, check_threshold, check_windows
from .worst_data import check_samples, check_worst

CHECKS = {
    "gradient": check_gradient,
    "symmetries": check_symmetries,
    "opposite": check_opposite,
    "pt_form": check_pt_form,
    "conservation": check_conservation,
    "expansion": check_expansion,
    "theorem_3_constant": check_theorem_3_constant,
    "theorem_2_case": check_theorem_2_case,
    "negative_depth": check_negative_depth,
    "energy_drift": check_energy_drift,
    "not_shown": check_not_shown,
    "dispersion": check_dispersion,
    "chart": check_chart,
    "short_chart": check_chart,
    "windows": check_windows,
    "measured_windows": check_measured_windows,
    "threshold": check_threshold,
    "balance": check_balance,
    "growth": check_growth,
    "inequalities": check_inequalities,
    "samples": check_samples,
    "worst": check_worst,
}


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
