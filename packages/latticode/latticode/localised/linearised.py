"""The linear equations of a small perturbation of a state, as a matrix."""

from functools import cache

import numpy as np

from latticode.equations.ends import ends_of
from latticode.equations.graph import derivative, evaluate, leaves_in, number
from latticode.equations.model import Model
from latticode.simulation.problem import Problem
from latticode.simulation.systems import PADDING, moved, parameters_of


def linearise(
    problem: Problem, state: np.ndarray, coupling: float = 1.0
) -> tuple[np.ndarray, np.ndarray]:
    """Return the rates of a state at time 0, and the matrix of their derivatives.

    `state` and rates are flat: by row, which are the real and imaginary parts of each field or its
    value and its rate, and then by site. A `coupling` below 1 replaces a neighbour's value by its
    mean with the site's own, where it has this weight: at 0 sites are independent.
    """
    model, values = problem.model, parameters_of(problem)
    parts = state.reshape(-1, problem.sites)
    sites = problem.sites
    own, mode = np.arange(sites), PADDING[ends_of(problem.boundary).sees]
    seen = np.pad(own + 1, model.reach, mode) - 1  # a site at rest is -1

    def places(by):
        return seen[model.reach + by : model.reach + by + sites]

    def value(one):
        if one.operation in ("number", "time"):
            return one.operands[0] if one.operands else 0.0
        by = one.operands[-1]
        if one.operation == "parameter":
            found = values[one.operands[0]]
            return found if np.ndim(found) == 0 else moved(found, by, problem.boundary)
        row, at = parts[2 * one.operands[0] + one.operands[1]], places(by)
        return coupling * np.where(at >= 0, row[at], 0.0) + (1.0 - coupling) * row

    rates = [np.broadcast_to(rate, sites) for rate in evaluate(model.rates, value)]
    matrix = np.zeros((len(parts), sites, len(parts), sites))
    for leaf, slopes in _slopes(model):
        component, part, by = leaf.operands
        at = places(by)
        inside = np.flatnonzero(at >= 0)
        for row, slope in enumerate(evaluate(slopes, value)):
            slope, column = np.broadcast_to(slope, sites), 2 * component + part
            matrix[row, inside, column, at[inside]] += coupling * slope[inside]
            matrix[row, own, column, own] += (1.0 - coupling) * slope
    return np.concatenate(rates), matrix.reshape(len(parts) * sites, -1)


@cache
def _slopes(model: Model) -> list[tuple]:
    """Return each field of the equations, at each shift, with the derivatives by it."""
    return [
        (leaf, derivative(model.rates, lambda one, leaf=leaf: number(one is leaf)))
        for leaf in leaves_in(model.rates, "field")
    ]
