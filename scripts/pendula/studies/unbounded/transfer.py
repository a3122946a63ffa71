"""The transfer operator of a bond of the infinite chain at a given temperature.

Only neighbours are coupled, so the partition function of a ring is the trace of a power of one
operator. This operator multiplies by the weight w of a site and smooths over the site's four
coordinates y. With A_n -> (-1)^n A_n and B_n -> (-1)^n B_n the operator's kernel is positive,
sqrt(w(y)) exp(-beta epsilon |y - y'|^2) sqrt(w(y')), so the largest eigenvalue is simple. The
square of its eigenvector psi is the distribution of a site of the infinite chain.

The coordinates are y = (s, t, p, q), with (A + B) / sqrt 2 = s + i p and (A - B) / sqrt 2 =
t + i q. The power P is |y|^2. The energy has the quartic term (P^2 + 4 (st + pq)^2) / 8 and the
drive's term -2 gamma (t^2 - q^2). A bond is a product of four factors, one per coordinate. So an
integral over a site consists of four small sums, by the midpoint rule. H is invariant under changes
of signs that preserve the sign of s t p q. The nodes with s, t, p, q > 0 therefore suffice, with
two values at each: for (s, t, p, q), and for (s, t, p, -q). On the chain with A = -B, s and p have
a single node at zero.
"""

from typing import NamedTuple

import numpy as np
from latticode.kernels.compiled import kernel
from latticode.numerics.elementary import exp

from pendula.problem import Constants

TAIL = 1e-9
"""A grid ends where the density of a coordinate is below this fraction of its largest value."""

REACH = 25.0
"""The first grid ends where the weight of a site is below exp(-REACH) of its largest value."""

SETTLED = 1e-9
"""The power iteration ends if the mean quartic energy changes by less than this relative amount."""


class Operator(NamedTuple):
    """The operator at one beta on m^4 nodes; arrays (2, m, m, m, m) have both signs of q.

    With A = -B there are m^2 nodes, (2, 1, m, 1, m).
    """

    constants: Constants
    beta: float
    nodes: tuple[np.ndarray, ...]  # positive nodes of each coordinate, (m,)
    bonds: tuple[np.ndarray, ...]  # by coordinate, on even and odd functions, (parity, m, m)
    roots: np.ndarray  # square roots of the weights
    quartic: np.ndarray  # quartic energy of a site
    power: np.ndarray  # (m, m, m, m): |y|^2

    @property
    def freedom(self) -> int:
        """The number of coordinates of a site that are not fixed at zero."""
        return sum(nodes.size > 1 for nodes in self.nodes)


def widest(constants: Constants, beta: float) -> np.ndarray:
    """Return a bound on the coordinates beyond which a site's weight is below exp(-REACH).

    The energy of a site is above P^2 / 8 - c P with c as below.
    """
    epsilon, gamma, omega = constants
    c = 4.0 * epsilon + 2.0 * gamma - omega
    least = 16.0 * min(c, 0.0) * min(c, 0.0)
    return np.full(4, np.sqrt(4.0 * c + np.sqrt(least + 8.0 * REACH / beta)))


def half_nodes(reach: np.ndarray, count: int, antisymmetric: bool) -> tuple[np.ndarray, ...]:
    """Return `count` midpoints from 0 to each of `reach`; s and p are zero if `antisymmetric`."""
    nodes = [length * (np.arange(count) + 0.5) / count for length in reach]
    if antisymmetric:
        nodes[0] = nodes[2] = np.zeros(1)
    return tuple(nodes)


def bonds_on(nodes: np.ndarray, beta: float, epsilon: float) -> np.ndarray:
    """Return the factor of a bond on even and odd functions of a coordinate, (parity, to, node)."""
    step = 2.0 * nodes[0] if nodes.size > 1 else 1.0  # the midpoint rule
    difference, total = nodes[:, None] - nodes, nodes[:, None] + nodes
    near, far = (step * exp(-beta * epsilon * d * d) for d in (difference, total))
    return np.array([near + far, near - far])


def make_operator(constants: Constants, beta: float, nodes: tuple[np.ndarray, ...]) -> Operator:
    """Return the operator on these nodes."""
    epsilon, gamma, omega = constants
    s, t, p, q = np.ix_(*nodes)
    power = s * s + t * t + p * p + q * q
    products = np.array([s * t + p * q, s * t - p * q])
    quartic = (power * power + 4.0 * products * products) / 8.0
    site_energy = quartic + (omega - 4.0 * epsilon) * power - 2.0 * gamma * (t * t - q * q)
    roots = exp(-0.5 * beta * (site_energy - site_energy.min()))
    bonds = tuple(bonds_on(axis_nodes, beta, epsilon) for axis_nodes in nodes)
    return Operator(constants, beta, nodes, bonds, roots, quartic, power)


@kernel
def pass_through(bond: np.ndarray, values: np.ndarray, row: np.ndarray, result: np.ndarray) -> None:
    """Write the sum over j of bond[i, j] values[j, r] to result[r, i]; the first axis becomes last.

    `row` is workspace for a row of `values`.
    """
    for i in range(bond.shape[0]):
        row[:] = 0.0
        for j in range(bond.shape[1]):
            factor = bond[i, j]
            for r in range(row.size):
                row[r] += factor * values[j, r]
        for r in range(row.size):
            result[r, i] = row[r]


def smoothed(bonds: tuple[np.ndarray, ...], values: np.ndarray) -> np.ndarray:
    """Return the integral of a bond times a function over a site.

    The part of the function that is even in q is even in all coordinates, and the part that is odd
    in q is odd in all.
    """
    even_and_odd = 0.5 * (values[0] + values[1]), 0.5 * (values[0] - values[1])
    done = []
    for odd, half in enumerate(even_and_odd):
        for of_axis in bonds:
            bond = of_axis[odd]
            result = np.empty((half.size // half.shape[0], len(bond)))
            flat = np.ascontiguousarray(half).reshape(len(half), -1)
            pass_through(bond, flat, np.empty(flat.shape[1]), result)
            half = result.reshape(*half.shape[1:], len(bond))
        done.append(half)
    return np.array([done[0] + done[1], done[0] - done[1]])


def applied(operator: Operator, values: np.ndarray) -> np.ndarray:
    """Return the operator applied to a function with the parities of psi."""
    return operator.roots * smoothed(operator.bonds, operator.roots * values)


def normalised(vector: np.ndarray) -> np.ndarray:
    """Return the vector divided by its l2 norm."""
    return vector / np.sqrt(np.sum(vector * vector))


def leading(operator: Operator, vector: np.ndarray | None = None, most: int = 2000) -> np.ndarray:
    """Return the eigenvector of the largest eigenvalue, by power iteration from `vector`.

    Raises ArithmeticError if `most` iterations are not enough.
    """
    vector, before = normalised(operator.roots if vector is None else vector), 0.0
    for _ in range(most):
        vector = normalised(applied(operator, vector))
        quartic = float(np.sum(vector * vector * operator.quartic))
        if abs(quartic - before) < SETTLED * quartic:
            return vector
        before = quartic
    raise ArithmeticError(f"the power iteration has not converged after {most} iterations")


def reach_of(operator: Operator, vector: np.ndarray) -> np.ndarray:
    """Return, by coordinate, the node beyond which the density is below TAIL times its maximum."""
    chance = (vector * vector).sum(axis=0)
    lengths = []
    for axis, nodes in enumerate(operator.nodes):
        along = chance.sum(axis=tuple(summed for summed in range(4) if summed != axis))
        last = np.flatnonzero(along > TAIL * along.max()).max()
        lengths.append(nodes[min(last + 1, len(nodes) - 1)])
    return np.array(lengths)
