"""Lyapunov spectra and sections as datasets."""

import numpy as np
import xarray as xr

from latticode.localised.sections import Crossings
from latticode.localised.spectra import Spectrum
from latticode.simulation.problem import Problem

from .checks import table, variable
from .stated import describe_run


def spectrum_dataset(problem: Problem, spectrum: Spectrum) -> xr.Dataset:
    """Return exponents and their errors (number,), and the growth (number, growth_tau)."""
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
    return _described(contents, "lyapunov", problem)


def section_dataset(problem: Problem, crossings: Crossings) -> xr.Dataset:
    """Return the times (crossing,) and states (part, component, site, crossing) of a section."""
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
    return _described(contents, "section", problem)


def _described(contents: dict, name: str, problem: Problem) -> xr.Dataset:
    dataset = xr.Dataset.from_dict(contents)
    return dataset.assign_attrs(describe_run(name, problem, problem.solver))
