"""Lyapunov spectra and sections as datasets."""

from collections.abc import Mapping
from typing import Any

import numpy as np
import xarray as xr

from latticode.equations.graph import Node
from latticode.equations.model import Model
from latticode.integrators.families import pair_of
from latticode.localised.sections import find_crossings
from latticode.localised.spectra import measure_spectrum
from latticode.simulation.problem import Problem

from .checks import table, variable
from .stated import describe_run


def measure_exponents(problem: Problem, exponent_count: int, name: str = "lyapunov") -> xr.Dataset:
    """Return Lyapunov exponents and errors (number,), and tangent growth (number, growth_tau)."""
    spectrum = measure_spectrum(problem, exponent_count)
    axes = ("number", "growth_tau")
    coordinates = {"number": np.arange(1, len(spectrum.exponents) + 1), "growth_tau": spectrum.tau}
    of_exponents = "Lyapunov exponent, per unit of tau, from the second half of the run"
    of_errors = "standard error of the exponent, from consecutive parts of that time"
    of_growth = "logarithm of the growth of a tangent vector"
    contents = table(
        "Lyapunov exponents",
        coordinates,
        exponent=variable(spectrum.exponents, axes[:1], of_exponents),
        exponent_error=variable(spectrum.errors, axes[:1], of_errors),
        log_growth=variable(spectrum.log_growth, axes, of_growth),
    )
    return _described(contents, name, problem)


def section_at(
    problem: Problem, when: Node, direction: str, site: int, name: str = "section"
) -> xr.Dataset:
    """Return the times (crossing,) and states (part, component, site, crossing) of a section."""
    if problem.solver["name"] == "auto":  # the solver has two methods, but a section needs one
        method = pair_of(problem.equations.methods)[0]
        problem = problem.changed(solver={"name": method, "rtol": 1e-13, "atol": 1e-13})
    crossings = find_crossings(problem, when, site, direction)
    names, axes = problem.equations.names, ("part", "component", "site", "crossing")
    coordinates = {
        "part": list(names.parts),
        "component": list(names.components),
        "site": list(problem.site_numbers),
        "crossing": np.arange(1, crossings.tau.size + 1),
    }
    contents = table(
        "Crossings of a section",
        coordinates,
        crossing_tau=variable(crossings.tau, axes[-1:], "time of the crossing"),
        crossing_state=variable(crossings.states, axes, "state at the crossing"),
    )
    return _described(contents, name, problem)


def find_section(
    problem: Problem, when: Mapping[str, Any], direction: str, site: int, name: str
) -> xr.Dataset:
    """Return the section where a density crosses zero.

    `when` is a model, as plain values, with the density as its only conserved quantity.
    """
    ((function, density),) = Model.of_plain(when).conserved.items()
    return section_at(problem, density, direction, site, name).assign_attrs(when=function)


def _described(contents: dict, name: str, problem: Problem) -> xr.Dataset:
    dataset = xr.Dataset.from_dict(contents)
    return dataset.assign_attrs(describe_run(name, problem, problem.solver))
