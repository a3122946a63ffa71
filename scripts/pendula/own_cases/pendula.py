"""Checks of a user's case of the pendula: how far its run is true, and how far (3) and (4) hold.

The case is run again by another method, as one of the amplitudes is. Then the amplitude equations
(4) are solved from the same data, and what the expansion (3) makes of them at the end is set beside
the angles there. A pendulum that passes the top has left the range of (3) for good.
"""

import numpy as np
import xarray as xr

from pendula.datasets.checks import table, variable
from pendula.models.pendula import leading_angles
from pendula.numerics.elementary import modulus
from pendula.problem import AMPLITUDES, Problem
from pendula.simulation.simulate import IntegrationError, simulate

TITLE = "A case of the pendula beside the expansion (3)"


def over_the_top(run: xr.Dataset) -> float:
    """Return the first tau of the outputs at which an angle exceeds pi, infinite if none does."""
    beyond = (run["linf"] > np.pi).any("component").values
    return float(run["tau"][beyond.argmax()]) if beyond.any() else np.inf


def beside_expansion(problem: Problem, run: xr.Dataset) -> dict:
    """Return the largest angle, and how far the angles at the end are from those of (3)."""
    angles = run["final"].sel(part="angle").values
    solver = {"name": "taylor", "rtol": 1e-14, "atol": 1e-14}
    changed = problem.changed(model=AMPLITUDES, mu=None, solver=solver, snapshot_every=0)
    try:
        amplitudes = simulate(changed).final
        expected = leading_angles(amplitudes, problem.constants.omega, problem.mu, problem.end_time)
        apart = float(np.abs(angles - expected).max())
        scale = float(2.0 * problem.mu * modulus(amplitudes).max())
    except IntegrationError:  # data of (4) may be refused that pendula can be followed from
        apart = scale = np.nan
    swing = "largest 2 mu abs(A_n) or 2 mu abs(B_n) of (4) at the end"
    return {
        "largest_angle": variable(float(run["linf"].max()), (), "largest angle", "rad"),
        "over_the_top": variable(
            over_the_top(run),
            (),
            "first tau at which an angle exceeds pi, infinite: at no output",
        ),
        "expansion_error": variable(apart, (), "largest |x - x of (3)| at the end", "rad"),
        "expansion_swing": variable(scale, (), swing, "rad"),
    }


def check_sweep(name: str, swept: xr.Dataset) -> xr.Dataset:
    """Return the largest angle on each chain of a sweep, and on how many one goes over the top."""
    peaks = swept["linf"].sel(quantity="pair", statistic="max").max("window").values
    angles = variable(peaks, ("half_width",), "largest angle in the windows", "rad")
    over = variable(int(np.sum(peaks > np.pi)), (), "chains on which a pendulum goes over the top")
    coordinates = {"half_width": swept["half_width"].values}
    found = table(TITLE, coordinates, swept_angle=angles, swept_over=over)
    return xr.Dataset.from_dict(found).assign_attrs(case=name)


def check_pendula(problem: Problem, run: xr.Dataset) -> xr.Dataset:
    """Return what is checked of pendula beside a second run, without attributes."""
    return xr.Dataset.from_dict(table(TITLE, {}, **beside_expansion(problem, run)))
