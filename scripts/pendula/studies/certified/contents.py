"""Curves with their proven bounds as datasets."""

from collections.abc import Mapping

from latticode.datasets.netcdf import Variable
from latticode.datasets.stated import describe_run
from latticode.datasets.trajectories import Contents

from pendula.many_cases import COMPONENTS
from pendula.problem import Problem

from . import frames, regular
from .norm import NotDefiniteError, find_form
from .polynomials import find_curve

MEANT = {"parameters_mean": "the printed decimals"}


def curve_contents(name: str, problem: Problem, made_for: Mapping | None = None) -> Contents:
    """Return the contents of the dataset on a curve with the bound that `regular` proves.

    `made_for` are constants that the curve is made with in place of those of the problem, an error
    that the bound must then show. Where the linear flow conserves no norm, the bound is infinite
    and an attribute says why.
    """
    curve = find_curve(problem.changed(**(made_for or {})))
    about = {f"made_for_{key}": value for key, value in (made_for or {}).items()}
    try:
        form, proof = find_form(problem.constants), regular.prove(problem, curve)
        about |= {"least_form": float(form.m1), "largest_form": float(form.m2)}
    except NotDefiniteError as reason:
        proof = regular.leave_unproved(curve)
        about["not_certified"] = str(reason)
    solver = {"name": "polynomials", "order": len(curve.terms) - 1, "step": curve.step}
    about = describe_run(name, problem, solver) | MEANT | about
    return _contents(about, regular.norms_at(proof, problem.times))


def frame_contents(name: str, problem: Problem, proof: Mapping) -> Contents:
    """Return the same of a curve whose bound `frames` proves.

    `proof` are the arguments of `frames.certify` beside the problem.
    """
    about = describe_run(name, problem, {"name": "polynomials of integers", **proof}) | MEANT
    return _contents(about, frames.certify(problem, **proof))


def _contents(about: Mapping, found: regular.Certified) -> Contents:
    """Return norms, and the bound of their distance to the true ones."""
    norms, of_tau = ("component", "tau"), ("tau",)
    variables = {
        "tau": Variable(of_tau, found.tau),
        "component": COMPONENTS,
        "linf": Variable(norms, found.linf),
        "l2": Variable(norms, found.l2),
        "bound": Variable(
            of_tau,
            found.bound,
            "bound, as proved, of the l2 distance to the true state, and so of each norm's error",
        ),
    }
    title = f"Norms of {about['case']} against time, with a proven bound of their distance to "
    return variables, {"title": f"{title}the true ones", **about}
