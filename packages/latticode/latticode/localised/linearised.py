"""The linearised equations of small perturbations of a state, as a matrix."""

from functools import cache, lru_cache

import numpy as np

from latticode.equations.ends import ends_of
from latticode.equations.graph import ZERO, Node, derivative, evaluate, leaves_in, number
from latticode.equations.model import Model
from latticode.simulation.problem import Problem
from latticode.simulation.traced import PADDING, moved

EVEN, ODD = 1, -1


def linearise(
    problem: Problem, state: np.ndarray, coupling: float = 1.0, parity: int | None = None
) -> tuple[np.ndarray, np.ndarray]:
    """Return the rates of a state at time 0, and their Jacobian matrix.

    `state` and rates are (row, site), flattened: the rows are the real and imaginary parts of each
    field, or its value and its rate. With a `parity` the state is even and has the sites 0..M; the
    matrix then describes EVEN perturbations on the sites 0..M, or ODD ones on the sites 1..M.
    `coupling` is the fraction c of the full coupling: each neighbour's value v is replaced by
    c v + (1 - c) u, where u is the value at the site itself.
    """
    model, values = problem.model, problem.parameter_values
    places = places_seen(model.reach, problem.boundary, problem.sites, parity)
    state_rows = state.reshape(len(model.rates), -1)
    rows, sites = state_rows.shape

    def value(leaf: Node) -> float | np.ndarray:
        if leaf.operation in ("number", "time"):
            return leaf.operands[0] if leaf.operands else 0.0
        by = leaf.operands[-1]
        if leaf.operation == "parameter":
            constant = values[leaf.operands[0]]
            return constant if np.ndim(constant) == 0 else moved(constant, by, problem.boundary)
        row = state_rows[2 * leaf.operands[0] + leaf.operands[1]]
        if by == 0:
            return row
        seen, factor, _ = places[:, model.reach + by :][:, :sites]
        return coupling * factor * row[seen.astype(int)] + (1.0 - coupling) * row

    (row, column, by), nodes = _slopes(model)
    rates_and_slopes = np.empty((len(nodes), sites))
    for k, entries in enumerate(evaluate(nodes, value)):
        rates_and_slopes[k] = entries
    rates, slopes = rates_and_slopes[:rows], rates_and_slopes[rows:]
    sites_of_rows = np.arange(sites)
    seen, _, sign = places[:, model.reach + by[:, None] + sites_of_rows]
    line = (row[:, None] * sites + sites_of_rows) * rows + column[:, None]

    def placed(at: np.ndarray, slopes: np.ndarray) -> np.ndarray:
        index = (line * sites + at).astype(int)
        return np.bincount(index.ravel(), slopes.ravel(), minlength=(rows * sites) ** 2)

    matrix = placed(seen, coupling * sign * slopes)
    matrix += placed(sites_of_rows, (1.0 - coupling) * slopes)
    first = int(parity == ODD)
    matrix = matrix.reshape(rows, sites, rows, sites)[:, first:, :, first:]
    return rates.ravel(), matrix.reshape(rows * (sites - first), -1)


@lru_cache
def places_seen(reach: int, boundary: str, sites: int, parity: int | None) -> np.ndarray:
    """Return (3, place): for each place the index of the site with its value, and two factors.

    The places are the sites and `reach` places beyond each end. The factors multiply the value in
    the state and in a perturbation; they are 0 at places that the boundary keeps at rest.
    """
    ends, half_width = ends_of(boundary), sites // 2
    seen = np.pad(np.arange(sites) + 1, reach, PADDING[ends.sees]) - 1
    factor = np.full(seen.size, ends.factor)
    factor[reach:-reach] = 1.0
    factor[seen < 0] = 0.0
    seen = np.maximum(seen, 0)
    if parity is None:
        return np.array([seen, factor, factor])
    site, factor = seen[half_width:] - half_width, factor[half_width:]
    return np.array([np.abs(site), factor, np.where(site < 0, parity, 1) * factor])


@cache
def _slopes(model: Model) -> tuple[np.ndarray, tuple[Node, ...]]:
    """Return the indices of all derivatives, (3, derivative), and the expressions to evaluate.

    The indices are the row of the rate, the row of the field, and the shift of the field in sites.
    The expressions are the rates, followed by the derivatives.
    """
    entries, nodes = [], [*model.rates]
    for leaf in leaves_in(model.rates, "field"):
        component, re_im, by = leaf.operands
        changes = derivative(model.rates, lambda entry, leaf=leaf: number(entry is leaf))
        for row, change in enumerate(changes):
            if change is not ZERO:
                entries.append((row, 2 * component + re_im, by))
                nodes.append(change)
    return np.array(entries, int).reshape(-1, 3).T, tuple(nodes)
