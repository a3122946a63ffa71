"""What the paper states of any case: Lemma 1 at rest, Lemma 2 and Theorems 1 to 3 on the way."""

from dataclasses import astuple

import numpy as np
import xarray as xr

from pendula.datasets.checks import table, variable
from pendula.problem import Problem
from pendula.studies.theory.bounds import NUMBERS, case_numbers
from pendula.studies.theory.estimates import integrated_balance
from pendula.studies.theory.linear_stability import (
    finite_rate,
    finite_threshold,
    gamma_0,
    infinite_rate,
)

RADIANS, PANELS = 40.0, 24
"""The balance of Lemma 2 is integrated while the data turn by so much, on so many panels."""


def beside_bounds(run: xr.Dataset) -> dict:
    """Return the numbers of theory.bounds for a trajectory, and the theorem that covers it."""
    with np.errstate(divide="ignore", invalid="ignore"):  # a chain at rest has no ratios
        numbers, region = case_numbers(run)
        ratio = np.float64(numbers["observed"]) / numbers["best"]
    described = {name: variable(numbers[name], (), text) for name, text in NUMBERS.items()}
    described["region"] = variable(region, (), "theorem that covers the case")
    described["ratio"] = variable(ratio, (), "largest P over its smallest bound")
    drift = float(np.abs(run["energy"] - run["energy"][0]).max())
    return described | {"energy_drift": variable(drift, (), "largest |H - H(0)|")}


def at_rest(problem: Problem) -> dict:
    """Return thresholds and growth rates of the chain at rest: infinite, and as long as it is."""
    epsilon, gamma, omega = astuple(problem.constants)
    chain = (epsilon, problem.sites, problem.boundary)
    return {
        "gamma_0": variable(gamma_0(omega, epsilon), (), "threshold (12) of the infinite chain"),
        "finite_threshold": variable(finite_threshold(omega, *chain), (), "threshold on N sites"),
        "infinite_rate": variable(
            infinite_rate(omega, gamma, epsilon), (), "growth rate of the infinite chain", "tau-1"
        ),
        "finite_rate": variable(
            finite_rate(omega, gamma, *chain), (), "growth rate on N sites", "tau-1"
        ),
    }


def balance(problem: Problem, run: xr.Dataset, solver: dict) -> dict:
    """Return how well the balance of P in Lemma 2 holds from the initial data on.

    The state is carried by `solver` from node to node, and the balance integrated over them.
    """
    constants, amplitudes = problem.constants, problem.amplitudes
    start, largest = float(np.sum(np.abs(amplitudes) ** 2)), float(run["linf"].max()) ** 2
    linear = 4 * abs(constants.epsilon) + 2 * abs(constants.gamma) + abs(constants.omega)
    rate = linear + largest
    span = min(problem.end_time, RADIANS / rate) if rate else problem.end_time
    change, integral = integrated_balance(
        constants, problem.boundary, amplitudes, span, PANELS, solver
    )
    error = abs(change - integral) / max(start, start + change) if start else np.nan
    return {
        "balance_error": variable(error, (), "change of P minus its balance (Lemma 2), over P"),
        "balance_span": variable(span, (), "tau to which the balance is followed"),
    }


def gather(problem: Problem, run: xr.Dataset, solver: dict) -> xr.Dataset:
    """Return all of it for a case and its trajectory."""
    numbers = beside_bounds(run) | at_rest(problem) | balance(problem, run, solver)
    return xr.Dataset.from_dict(table("A case beside the paper's statements", {}, **numbers))
