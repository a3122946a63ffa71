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

import numpy as np
from latticode.numerics.elementary import exp, log, sine_and_cosine
from latticode.numerics.quadrature import gauss_legendre

from pendula.problem import Constants

from .transfer import normalised, pass_through

RADII, ANGLES = 24, 4
"""Nodes in the radius, and in the angle of a quadrant."""

SETTLED = 1e-13
"""The power iteration ends when the eigenvalue changes by less than this part of it."""


def disc_below(bound: float) -> np.ndarray:
    """Return the nodes of one amplitude in a quadrant of the disc up to a modulus, (3, node).

    The rows are the real part, the imaginary part, and the area of each node.
    """
    nodes, weights = gauss_legendre(RADII)
    radius = 0.5 * bound * (nodes + 1.0)
    sine, cosine = sine_and_cosine(0.5 * np.pi * (np.arange(ANGLES) + 0.5) / ANGLES)
    area = np.repeat(0.5 * bound * weights * radius, ANGLES) * (0.5 * np.pi / ANGLES)
    return np.array([np.outer(radius, cosine).ravel(), np.outer(radius, sine).ravel(), area])


def bonds_between(beta: float, epsilon: float, to: np.ndarray, disc: np.ndarray) -> np.ndarray:
    """Return a bond of one amplitude on functions of both parities, (real, imaginary, to, node)."""
    parts = []
    for end, start in zip(to[:2], disc[:2], strict=True):
        apart, across = end[:, None] - start, end[:, None] + start
        near, far = (exp(-beta * epsilon * d * d) for d in (apart, across))
        parts.append(np.array([near + far, near - far]))
    return parts[0][:, None] * parts[1]


def roots_on(constants: Constants, beta: float, disc: np.ndarray) -> np.ndarray:
    """Return the square roots of the weights of a site, (sign, sign, A, B)."""
    epsilon, gamma, omega = constants
    x, y, area = disc
    square = x * x + y * y
    own = 0.25 * square * square + (omega - 4.0 * epsilon) * square - gamma * (x * x - y * y)
    both = 2.0 * gamma * np.array([np.outer(x, x), np.outer(y, y)])
    signs = np.array([1.0, -1.0])[:, None, None]
    energy = (own[:, None] + own) + ((signs * both[0])[:, None] - signs * both[1])
    return exp(-0.5 * beta * energy) * np.sqrt(np.outer(area, area))


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


def leading(bonds: np.ndarray, roots: np.ndarray, most: int = 5000) -> tuple[float, np.ndarray]:
    """Return the largest eigenvalue of the operator and its eigenvector.

    Raises ArithmeticError if `most` iterations are not enough.
    """
    vector, before = normalised(roots), 0.0
    for _ in range(most):
        following = roots * smoothed(bonds, roots * vector)
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

    def solved(disc: np.ndarray) -> tuple[np.ndarray, float, np.ndarray]:
        roots = roots_on(constants, beta, disc)
        return roots, *leading(bonds_between(beta, constants.epsilon, disc, disc), roots)

    whole = disc_below(float(bounds[-1]))
    whole_roots, largest, psi = solved(whole)
    rates, overlaps = np.zeros(len(bounds)), np.ones(len(bounds))
    for i, bound in enumerate(bounds[:-1]):
        disc = disc_below(float(bound))
        roots, value, vector = solved(disc)
        bonds = bonds_between(beta, constants.epsilon, disc, whole)
        inside = roots * smoothed(bonds, whole_roots * psi) / largest
        rates[i], overlaps[i] = log(largest / value), np.sum(vector * inside) ** 2
    return rates, overlaps


def mean_maximum(law, sites) -> np.ndarray:
    """Return the mean of the largest modulus on so many neighbouring `sites`, an array or a number.

    `law` is a dataset with `bound`, `bound_rate` and `bound_overlap` of one thermal state.
    """
    bound, rate, overlap = (law[name].values for name in ("bound", "bound_rate", "bound_overlap"))
    below = overlap * exp(-(np.asarray(sites, float)[..., None] - 1.0) * rate)
    above = 1.0 - np.insert(below, 0, 0.0, axis=-1)
    return (0.5 * (above[..., 1:] + above[..., :-1]) * np.diff(bound, prepend=0.0)).sum(axis=-1)
