"""The largest modulus on N neighbouring sites of a thermal state, without sampling and without fit.

A thermal state is a Markov chain along n, since a bond couples neighbours alone. The probability
that no modulus on N neighbouring sites is above m is the mean of N - 1 powers of the transfer
operator (see `transfer`) restricted to |A|, |B| <= m, over those of the whole operator. With their
largest eigenvalues lambda_m and lambda and eigenvectors psi_m and psi it is

    P(N) = <psi, psi_m>^2 exp(-(N - 1) rate),  rate = ln(lambda / lambda_m),

up to what neighbouring sites forget within a few of them. Neighbours that are large together make
the rate smaller than -ln P(1): their ratio is the extremal index, one for independent sites.

Where m is large the rate falls as exp(-beta m^4 / 4), the weight of one large amplitude. The
largest of N moduli therefore rises without a bound, but only as (4 ln N / beta)^(1/4).

A bond is a product of one factor for A and one for B. On polar nodes |A| <= m the restriction is
smooth: Gauss' rule in the radius and the midpoint rule in the angle converge exponentially. H keeps
its value if both real parts or both imaginary parts change their signs. Therefore A stays in one
quadrant, and only B takes all signs.
"""

from typing import NamedTuple

import numpy as np

from pendula.datasets.netcdf import Variable
from pendula.numerics.elementary import exp, log, sine_and_cosine
from pendula.numerics.quadrature import gauss_legendre
from pendula.problem import Constants

from .thermal import ThermalState, widest
from .transfer import normalised, pass_through

RADII, ANGLES = 24, 4
"""Nodes in the radius, and in the angle of a quadrant."""

BOUNDS, PLACES = 60, 10
"""Values of the bound that are solved, and decimals of what is published."""

SETTLED = 1e-13
"""The power iteration ends when the eigenvalue changes by less than this part of it."""


class Disc(NamedTuple):
    """Nodes of one amplitude in a quadrant of the disc up to a modulus, (node,) each."""

    real: np.ndarray
    imaginary: np.ndarray
    area: np.ndarray


class Restricted(NamedTuple):
    """The operator with no modulus above that of the disc; arrays hold (sign, sign, A, B)."""

    disc: Disc
    bonds: np.ndarray  # (parity, parity, node, node)
    roots: np.ndarray  # square roots of the weights


def disc_below(bound: float) -> Disc:
    """Return the nodes with a modulus below `bound`."""
    nodes, weights = gauss_legendre(RADII)
    radius = 0.5 * bound * (nodes + 1.0)
    sine, cosine = sine_and_cosine(0.5 * np.pi * (np.arange(ANGLES) + 0.5) / ANGLES)
    area = np.repeat(0.5 * bound * weights * radius, ANGLES) * (0.5 * np.pi / ANGLES)
    return Disc(np.outer(radius, cosine).ravel(), np.outer(radius, sine).ravel(), area)


def bonds_between(beta: float, epsilon: float, to: Disc, nodes: Disc) -> np.ndarray:
    """Return a bond of one amplitude on functions of both parities, (real, imaginary, to, node)."""

    def of_part(to: np.ndarray, nodes: np.ndarray) -> np.ndarray:
        apart, across = to[:, None] - nodes, to[:, None] + nodes
        near, far = (exp(-beta * epsilon * d * d) for d in (apart, across))
        return np.array([near + far, near - far])

    real, imaginary = (of_part(to[part], nodes[part]) for part in (0, 1))
    return real[:, None] * imaginary


def restricted(constants: Constants, beta: float, bound: float) -> Restricted:
    """Return the operator on the states whose moduli are below `bound`."""
    epsilon, gamma, omega = constants
    disc = disc_below(bound)
    x, y, area = disc
    square = x * x + y * y
    own = 0.25 * square * square + (omega - 4.0 * epsilon) * square - gamma * (x * x - y * y)
    both = 2.0 * gamma * np.array([np.outer(x, x), np.outer(y, y)])
    signs = np.array([1.0, -1.0])[:, None, None]
    energy = (own[:, None] + own) + ((signs * both[0])[:, None] - signs * both[1])
    roots = exp(-0.5 * beta * energy) * np.sqrt(np.outer(area, area))
    return Restricted(disc, bonds_between(beta, epsilon, disc, disc), roots)


def smoothed(bonds: np.ndarray, values: np.ndarray) -> np.ndarray:
    """Return the integral of the bonds of A and B times a function over a site."""
    parts = 0.25 * _folded(values)
    done = np.empty((2, 2, bonds.shape[2], bonds.shape[2]))
    for parity in np.ndindex(2, 2):
        bond, row = bonds[parity], np.empty(parts.shape[3])
        half = np.empty((parts.shape[3], len(bond)))
        pass_through(bond, parts[parity], row, half)
        pass_through(bond, half, np.empty(len(bond)), done[parity])
    return _folded(done)


def _folded(values: np.ndarray) -> np.ndarray:
    """Return sums and differences over both signs: parities of signs, and signs of parities."""
    first = np.array([values[0] + values[1], values[0] - values[1]])
    return np.stack([first[:, 0] + first[:, 1], first[:, 0] - first[:, 1]], axis=1)


def leading(operator: Restricted, most: int = 5000) -> tuple[float, np.ndarray]:
    """Return the largest eigenvalue and its eigenvector.

    Raises ArithmeticError if `most` iterations are not enough.
    """
    vector, before = normalised(operator.roots), 0.0
    for _ in range(most):
        following = operator.roots * smoothed(operator.bonds, operator.roots * vector)
        value = float(np.sum(vector * following))
        vector = normalised(following)
        if abs(value - before) < SETTLED * value:
            return value, vector
        before = value
    raise ArithmeticError("the restricted operator has no gap that an iteration can use")


def law_of_maxima(
    constants: Constants, beta: float, bounds: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Return the rate and the overlap <psi, psi_m>^2 at each of the `bounds` m, both (bound,).

    No modulus may be above the last bound: it stands for the whole operator.
    """
    whole = restricted(constants, beta, float(bounds[-1]))
    largest, psi = leading(whole)
    rates, overlaps = np.zeros(len(bounds)), np.ones(len(bounds))
    for i, bound in enumerate(bounds[:-1]):
        operator = restricted(constants, beta, float(bound))
        value, vector = leading(operator)
        bonds = bonds_between(beta, constants.epsilon, operator.disc, whole.disc)
        inside = operator.roots * smoothed(bonds, whole.roots * psi) / largest
        rates[i], overlaps[i] = log(largest / value), np.sum(vector * inside) ** 2
    return rates, overlaps


def maximum_variables(state: ThermalState) -> dict[str, Variable]:
    """Return the law of the largest modulus in a thermal state, at BOUNDS values of m.

    The last of them is a bound on one modulus: at a given power that of one amplitude alone has
    twice the quartic energy of `widest`, so that it ends at a 2^(1/4) of that reach.
    """
    constants = state.operator.constants
    reach = float(widest(constants, state.beta)[0]) / np.sqrt(np.sqrt(2.0))
    bounds = reach * np.arange(1, BOUNDS + 1) / BOUNDS
    rates, overlaps = law_of_maxima(constants, state.beta, bounds)
    chance = "the chance c exp(-r (N - 1)) that no modulus on N neighbouring sites is above it"

    def over_bounds(values: np.ndarray, long_name: str) -> Variable:
        values = values.round(PLACES) + 0.0
        return Variable(("bound",), values, long_name, attributes={"decimal_places": PLACES})

    return {
        "bound": over_bounds(bounds, "bound on the moduli |A_n| and |B_n|"),
        "bound_rate": over_bounds(rates, f"r in {chance}"),
        "bound_overlap": over_bounds(overlaps, f"c in {chance}"),
        "bound_omega": Variable((), constants.omega, "detuning Omega of this thermal state"),
    }


def mean_maximum(law, sites) -> np.ndarray:
    """Return the mean of the largest modulus on so many neighbouring `sites`, an array or a number.

    `law` is a dataset with `bound`, `bound_rate` and `bound_overlap` of one thermal state.
    """
    bound, rate, overlap = (law[name].values for name in ("bound", "bound_rate", "bound_overlap"))
    below = overlap * exp(-(np.asarray(sites, float)[..., None] - 1.0) * rate)
    above = 1.0 - np.insert(below, 0, 0.0, axis=-1)
    return (0.5 * (above[..., 1:] + above[..., :-1]) * np.diff(bound, prepend=0.0)).sum(axis=-1)
