"""Trajectories compared with the bounds of Theorems 1 to 3 on P = |A|^2 + |B|^2 in l2."""

from collections.abc import Mapping

import numpy as np
import xarray as xr
from latticode.datasets.checks import describe, tabulate, variable
from latticode.measures.norms import total_power
from replication.variables import REGULAR, mark

from pendula.models.bounds import find_bounds, proven_region
from pendula.problem import Constants

NUMBERS = {
    "region": ("region of the theorem that covers the case", None),
    "ratio": ("largest P divided by its smallest bound", 1.0),
    "start": ("initial P, delta", None),
    "observed": ("largest P", None),
    "theorem_1": ("C of Theorem 1", None),
    "theorem_2": ("bound on P from the barrier of (25)", None),
    "widened": ("the same bound with the coupling energy kept", None),
    "theorem_3": ("C_N of Theorem 3", None),
}
"""The long name of each number of a trajectory, and its tolerance if the check depends on it."""
PRINTED_NUMBERS = ("start", "theorem_1", "theorem_2", "widened", "theorem_3")
"""Numbers that follow from the initial conditions."""


def case_numbers(trajectory: xr.Dataset) -> dict[str, float | str]:
    """Return the numbers of one trajectory, as NUMBERS lists them."""
    constants, boundary = Constants.of(trajectory.attrs), str(trajectory.attrs["boundary"])
    sites = 2 * int(trajectory.attrs["half_width"]) + 1
    energy, power = float(trajectory["energy"][0]), total_power(trajectory)
    start, observed = float(power[0]), np.float64(power.max())
    bounds = find_bounds(energy, start, sites, constants, boundary)
    ratio = float(observed / min(bounds.values()))
    region = proven_region(energy, start, constants, boundary)
    numbers = {"region": region, "start": start, "observed": float(observed), "ratio": ratio}
    return numbers | bounds


def check_cases(trajectories: Mapping[str, xr.Dataset]) -> dict:
    """Return the table of the paper's trajectories, by case, with the bounds on each."""
    attributes = [trajectory.attrs for trajectory in trajectories.values()]
    return tabulate(
        "The paper's cases, and the bounds of its theorems on them",
        {"case": list(trajectories)},
        map(case_numbers, trajectories.values()),
        NUMBERS,
        omega=variable([float(case["omega"]) for case in attributes], ("case",), "detuning Omega"),
        initial=variable(
            [str(case["initial"]) for case in attributes], ("case",), "initial {site: [A, B]}"
        ),
    )


def check_observed(trajectories: Mapping[str, xr.Dataset]) -> xr.Dataset:
    """Return the dataset of `check_cases`, and print whether the check holds."""
    check = check_cases(trajectories)
    print(describe("cases", check))
    return mark(xr.Dataset.from_dict(check), REGULAR, "omega", *PRINTED_NUMBERS)
