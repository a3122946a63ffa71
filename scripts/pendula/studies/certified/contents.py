"""Curves with their proven bounds as datasets."""

from collections.abc import Mapping, Sequence

import numpy as np

from pendula.datasets.netcdf import Variable
from pendula.datasets.trajectories import COMPONENTS, Contents, describe_run
from pendula.measures.difference import NORMS, PARAMETERS
from pendula.problem import Problem

from . import frames
from .norm import NotDefiniteError, find_form
from .polynomials import find_curve
from .regular import PARTS, Certified, leave_unproved, norms_at, prove

GROWN = "logarithm of how much the proof lets an error of the start grow"


def curve_contents(
    name: str, problem: Problem, made_for: Mapping | None = None, reference=None
) -> Contents:
    """Return the contents of the dataset on a certified curve.

    `made_for` are constants that the curve is made with in place of those of the problem, which
    the proof must then find out. Where the linear flow keeps no norm, the bound is infinite and an
    attribute says why. `reference` is an xarray.Dataset of the same case in multiprecision, or of
    another one, or None.
    """
    curve = find_curve(problem.changed(**(made_for or {})))
    try:
        form, proof = find_form(problem.constants), prove(problem, curve)
        about = {"least_form": float(form.m1), "largest_form": float(form.m2)}
    except NotDefiniteError as reason:
        proof, about = leave_unproved(problem, curve), {"not_certified": str(reason)}
    found = norms_at(proof, problem.times)
    solver = {"name": "polynomials", "order": len(curve.terms) - 1, "step": curve.step}
    attributes = {
        "title": f"Norms of {name} against time, with a proven bound of their distance to the "
        "true ones",
        **describe_run(name, problem, solver),
        "parameters_mean": "the printed decimals",
        **{f"made_for_{key}": value for key, value in (made_for or {}).items()},
        **about,
    }
    variables = curve_variables(found)
    if reference is not None:
        variables["reference_distance"] = _distance(found, reference, attributes)
    return variables, attributes


def frame_contents(name: str, problem: Problem, proof: Mapping, reference=None) -> Contents:
    """Return the contents of the dataset on a curve that is certified by frames.

    `proof` are the arguments of `frames.certify` beside the problem.
    """
    found = frames.certify(problem, **proof)
    solver = {"name": "polynomials of integers", **proof}
    attributes = {
        "title": f"Norms of {name} against time, with a proven bound of their distance to the "
        "true ones",
        **describe_run(name, problem, solver),
        "parameters_mean": "the printed decimals",
    }
    variables = curve_variables(found, frames.PARTS)
    variables["error_exponent"] = Variable(("tau",), found.exponent, GROWN)
    if reference is not None:
        variables["reference_distance"] = _distance(found, reference, attributes)
    return variables, attributes


def _distance(found: Certified, reference, attributes: Mapping) -> Variable:
    """Return the largest distance of a norm to the reference, NaN where it has another problem."""
    apart = np.full(found.tau.shape, np.nan)
    if all(reference.attrs[key] == attributes[key] for key in PARAMETERS):
        known = reference.reindex(tau=found.tau, method="nearest", tolerance=1e-9)
        off = [np.abs(known[name].values - getattr(found, name)) for name in NORMS]
        apart = np.max(off, axis=(0, 1))
    words = "largest distance of a norm to that of the multiprecision reference"
    return Variable(("tau",), apart, words)


def curve_variables(found: Certified, parts: Sequence[str] = PARTS) -> dict[str, Variable]:
    """Return norms, the bound of their distance to the true ones, and the parts of its sum."""
    norms = ("component", "tau")
    return {
        "tau": Variable(("tau",), found.tau),
        "component": COMPONENTS,
        "linf": Variable(norms, found.linf),
        "l2": Variable(norms, found.l2),
        "bound": Variable(
            ("tau",),
            found.bound,
            "bound, as proved, of the l2 distance to the true state, and so of each norm's error",
        ),
        "bound_part": Variable(("bound_part",), list(parts), "what a part of the bound is due to"),
        "bound_parts": Variable(
            ("bound_part", "tau"), found.parts, "part of the bound, which is their sum"
        ),
        "error_exponent": Variable(
            ("tau",),
            np.asarray(found.exponent),
            GROWN,
        ),
    }
