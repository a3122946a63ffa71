"""How fast small changes of a solution grow, and what that leaves of double precision.

One random change, even where the data are even, is carried along by the tangent equations
(pendula.chaos.tangents). Its growth is set against that of the solution itself.
"""

import numpy as np
import xarray as xr

from pendula.measures.growth import is_chaotic, mean_rate, mean_rate_error
from pendula.problem import Problem
from pendula.simulation.lattice import find_reduction
from pendula.simulation.simulate import IntegrationError
from pendula.studies.chaos.changes import random_change
from pendula.studies.chaos.divergence import ROUNDING, amplification, predict
from pendula.studies.chaos.lyapunov import SEED
from pendula.studies.chaos.tangents import STEP, Growth, grow

FEWEST_STEPS = 64


def follow(problem: Problem) -> Growth:
    """Return the growth of a random change along a case."""
    even = bool(find_reduction(problem.amplitudes).even)
    rng = np.random.default_rng(SEED)
    change = random_change(problem.sites, "even" if even else None, rng)
    step = min(STEP, problem.end_time / FEWEST_STEPS)
    return grow(problem, change[None], problem.end_time, even, step)


def measure(problem: Problem) -> xr.Dataset:
    """Return the rate at which small changes grow, whether that is chaos, and when digits end."""
    try:
        growth = follow(problem)
    except IntegrationError as error:
        return xr.Dataset(attrs={"sensitivity_refusal": str(error)})
    middle = growth.tau[-1] / 2
    with np.errstate(divide="ignore", invalid="ignore"):  # a chain at rest has no relative errors
        relative = growth.stretch[0] - np.log(growth.size)
        late = relative[-1] - relative[np.searchsorted(growth.tau, middle)]
        amplified = amplification(growth.tau, growth.stretch[0], growth.size)
    rate = mean_rate(growth.tau, growth.stretch[0], middle)
    error = mean_rate_error(growth.tau, growth.stretch[0], middle)
    chaotic = is_chaotic(growth.tau, growth.stretch[0], growth.size)
    times = {"long_name": "slow time", "units": "1"}
    named = {
        "stretch": (
            ("growth_tau", growth.stretch[0]), "logarithm of the growth of a small change", "1"
        ),
        "exponent": (rate, "rate of that growth, second half", "tau-1"),
        "exponent_error": (error, "standard error of the rate", "tau-1"),
        "late_growth": (late, "growth relative to the solution's, second half, logarithm", "1"),
        "chaotic": (int(chaotic), "one where that growth is exponential", "1"),
        "divergence_rounding": (
            predict(growth.tau, amplified, ROUNDING),
            "tau at which one rounding a unit of tau has grown to 1 %", "1",
        ),
    }  # fmt: skip
    data = xr.Dataset(coords={"growth_tau": ("growth_tau", growth.tau, times)})
    for name, (value, long_name, units) in named.items():
        dims, values = value if isinstance(value, tuple) else ((), value)
        data[name] = (dims, values, {"long_name": long_name, "units": units})
    return data
