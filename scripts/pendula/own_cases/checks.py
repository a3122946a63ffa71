"""Checks of a user's case: the library's checks of any run, and the paper's statements about it.

For amplitudes these are Lemma 1 for the chain at rest, and the growth of Lemma 2 and Theorems 1 to
3 for the trajectory. For pendula, the amplitude equations (4) are solved from the same data, and
the angles of the expansion (3) at the end are compared with the run's. The expansion no longer
applies once a pendulum has passed the top.
"""

from collections.abc import Mapping

import numpy as np
import xarray as xr
from latticode import checks
from latticode.checks import measure_sensitivity, merged, run_again
from latticode.datasets.checks import table, variable
from latticode.simulation.simulate import IntegrationError, simulate

from pendula.models.bounds import growth_margin
from pendula.models.linear_chain import finite_rate, gamma_0, infinite_rate
from pendula.models.pendula import leading_angles
from pendula.problem import AMPLITUDES, PENDULA, PaperProblem
from pendula.studies.theory.bounds import NUMBERS, case_numbers

TITLE = "A case compared with the paper's statements"
READ_VARIABLES: Mapping[str, tuple[str, ...]] = {AMPLITUDES: ("energy",), PENDULA: ("final",)}
"""Variables of a run that the checks read, in addition to its norms."""


def compare_with_bounds(run: xr.Dataset) -> dict:
    """Return ratios of the trajectory to its bounds, and the theorem that applies to it."""
    with np.errstate(divide="ignore", invalid="ignore"):  # a chain at rest has no ratios
        numbers = case_numbers(run)
        margin = growth_margin(run["tau"].values, run["l2"].values, float(run.attrs["gamma"]))
    described = {name: variable(numbers[name], (), text) for name, (text, _) in NUMBERS.items()}
    drift = float(np.abs(run["energy"] - run["energy"][0]).max())
    return described | {
        "from_start": variable(margin["from_start"], (), "largest P over its bound (19)"),
        "energy_drift": variable(drift, (), "largest |H - H(0)|"),
    }


def measure_rest(problem: PaperProblem) -> dict:
    """Return the threshold and growth rates at rest, of the infinite and of this finite chain."""
    epsilon, gamma, omega = problem.constants
    rate, unit = infinite_rate(omega, gamma, epsilon), "per unit of tau"
    finite = finite_rate(omega, gamma, epsilon, problem.sites, problem.boundary)
    return {
        "gamma_0": variable(gamma_0(omega, epsilon), (), "threshold (12) of the infinite chain"),
        "infinite_rate": variable(rate, (), f"largest rate of the infinite chain, {unit}"),
        "finite_rate": variable(finite, (), f"largest rate of the finite chain, {unit}"),
    }


def compare_with_statements(problem: PaperProblem, run: xr.Dataset) -> xr.Dataset:
    """Return the paper's statements about a case, compared with its trajectory."""
    return xr.Dataset.from_dict(
        table(TITLE, {}, **compare_with_bounds(run), **measure_rest(problem))
    )


# --- The pendula ----------------------------------------------------------------------------------

TITLE_OF_PENDULA = "A case of the pendula compared with the expansion (3)"


def find_time_over_the_top(run: xr.Dataset) -> float:
    """Return the tau of the first output at which an angle exceeds pi, or infinity."""
    beyond = (run["linf"] > np.pi).any("component").values
    return float(run["tau"][beyond.argmax()]) if beyond.any() else np.inf


def compare_with_expansion(problem: PaperProblem, run: xr.Dataset) -> xr.Dataset:
    """Return the largest angle, the time over the top, and the distance from (3) at the end."""
    angles = run["final"].sel(part="angle").values
    solver = {"name": "taylor", "rtol": 1e-14, "atol": 1e-14}
    changed = problem.changed(model=AMPLITUDES, solver=solver, snapshot_every=0)
    try:
        amplitudes = simulate(changed).final
        expected = leading_angles(amplitudes, problem.constants.omega, problem.mu, problem.end_time)
        distance = float(np.abs(angles - expected).max())
    except IntegrationError:  # (4) may fail for data from which pendula can be integrated
        distance = np.nan
    top = "first tau at which an angle exceeds pi, infinite: at no output"
    numbers = {
        "largest_angle": variable(float(run["linf"].max()), (), "largest angle", "rad"),
        "over_the_top": variable(find_time_over_the_top(run), (), top),
        "expansion_error": variable(distance, (), "largest |x - x of (3)| at the end", "rad"),
    }
    return xr.Dataset.from_dict(table(TITLE_OF_PENDULA, {}, **numbers))


# --- All checks -----------------------------------------------------------------------------------


def check_run(problem: PaperProblem, run: xr.Dataset) -> xr.Dataset:
    """Return all checks of a case as one dataset; `run` is the trajectory of `problem`."""
    if problem.model.name == PENDULA:
        return merged(run, run_again(problem, run), compare_with_expansion(problem, run))
    if problem.model.name != AMPLITUDES:
        return checks.check_run(problem, run)
    statements = measure_sensitivity(problem), compare_with_statements(problem, run)
    return merged(run, run_again(problem, run), *statements)
