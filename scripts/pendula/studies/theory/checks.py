"""The checks of the full reproduction: each name with its function and its arguments."""

import numpy as np

from pendula.problem import Constants

from .equations import check_conservation, check_gradient, check_symmetries
from .errata import (
    check_energy_drift,
    check_negative_depth,
    check_not_shown,
    check_opposite,
    check_theorem_2_case,
    check_theorem_3_constant,
)
from .estimates import check_balance, check_growth, check_inequalities
from .linear_stability import check_dispersion, check_windows
from .other_forms import check_expansion, check_pt_form
from .stability_chart import check_chart, check_measured_windows, check_threshold
from .worst_data import check_samples, check_worst

PAPER = {"gamma": 1.0, "epsilon": 1.0}
NEGATIVE, ZERO = Constants(**PAPER, omega=-4.0), Constants(**PAPER, omega=0.0)
POINTS = [(-4.0, 1.0), (-4.0, 2.0), (0.0, 1.0), (2.0, 0.01), (4.0, 0.5), (8.0, 1.0), (8.0, 2.0)]
ODE45 = {"name": "ode45", "rtol": 1e-7, "atol": 1e-9}
CHART = {
    "omegas": np.linspace(-6.0, 10.0, 33),
    "gammas": np.linspace(0.0, 3.0, 13),
    "epsilon": 1.0,
    "sites": 21,
    "boundary": "dirichlet",
    "end_time": 40.0,
}
SHORT_CHART = {
    "omegas": np.linspace(-0.5, 4.5, 41),
    "gammas": np.linspace(0.0, 0.4, 11),
    "epsilon": 1.0,
    "sites": 5,
    "boundary": "dirichlet",
    "end_time": 60.0,
    "foldings": 18.0,
}
WINDOWS = {
    "epsilon": 1.0,
    "boundary": "dirichlet",
    "half_widths": [2, 5, 10, 20, 30],
    "gammas": np.geomspace(0.001, 0.3, 26),
}
MEASURED_WINDOWS = {
    "gamma": 0.05,
    "epsilon": 1.0,
    "sites": 5,
    "boundary": "dirichlet",
    "end_time": 200.0,
}

CHECKS = {
    "gradient": (check_gradient, {"constants": NEGATIVE, "sites": 7}),
    "symmetries": (check_symmetries, {"constants": ZERO, "sites": 9, "end_time": 2.0}),
    "pt_form": (check_pt_form, {"constants": NEGATIVE, "sites": 7, "end_time": 2.0}),
    "conservation": (
        check_conservation,
        {**PAPER, "omegas": [8.0, -4.0, 0.0], "sites": 9, "end_time": 5.0},
    ),
    "dispersion": (check_dispersion, {"points": POINTS, "epsilon": 1.0, "sites": 9}),
    "chart": (check_chart, CHART),
    "short_chart": (check_chart, SHORT_CHART),
    "windows": (check_windows, WINDOWS),
    "measured_windows": (check_measured_windows, MEASURED_WINDOWS),
    "threshold": (check_threshold, {"epsilon": 1.0, "sites": 21}),
    "balance": (check_balance, {"constants": NEGATIVE, "sites": 9, "end_time": 4.0}),
    "growth": (check_growth, {"constants": ZERO, "sites": 9, "end_time": 3.0, "samples": 60}),
    "inequalities": (check_inequalities, {"count": 600}),
    "samples": (check_samples, {"count": 40, "end_time": 5.0}),
    "worst": (check_worst, {**PAPER, "sites": 3, "end_time": 3.0, "generations": 50}),
    "expansion": (check_expansion, {"constants": NEGATIVE, "sites": 5, "end": 1.0}),
    "theorem_3_constant": (check_theorem_3_constant, {"constants": NEGATIVE}),
    "theorem_2_case": (check_theorem_2_case, {"constants": NEGATIVE}),
    "negative_depth": (check_negative_depth, {"constants": NEGATIVE}),
    "energy_drift": (check_energy_drift, {"solver": ODE45}),
    "opposite": (check_opposite, {"constants": ZERO, "sites": 9, "end_time": 3.0}),
    "not_shown": (check_not_shown, {"half_widths": [5, 10, 15, 20, 30, 40, 60, 80, 100]}),
}


def run_check(name: str) -> dict:
    """Return the numbers of one check with the arguments of the full reproduction."""
    function, arguments = CHECKS[name]
    return function(**arguments)
