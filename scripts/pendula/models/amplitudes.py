"""The coupled dNLS equations (4) of the paper, their energy (8), and the ends of the chain.

A state is a real array `y[row, 1 + site]` with the rows Re A, Im A, Re B, Im B, or only the first
two when A = B; its sites are -M..M, or 0..M where the data are even in n. The first and the last
column are ghosts: what the ends of the chain see beyond themselves. Neighbours are summed as
(right + left) - 2 centre, which rounds alike under reflection, so that an even solution stays
even to the last bit.
"""

from typing import NamedTuple

from pendula.compiled import kernel, merged

DIRICHLET, FREE, PERIODIC, MIRROR = range(4)
ENDS = {"dirichlet": DIRICHLET, "free": FREE, "periodic": PERIODIC}


class Chain(NamedTuple):
    """Parameters of the equations (coupling, drive, detuning) and the kinds of the two ends."""

    epsilon: float
    gamma: float
    omega: float
    left: int
    right: int


@kernel
def close(chain, y):
    """Fill the ghost columns of `y` with what the ends of the chain see."""
    n = y.shape[1] - 2
    for row in range(y.shape[0]):
        y[row, 0] = 0.0
        if chain.left == FREE:
            y[row, 0] = y[row, 1]
        elif chain.left == PERIODIC:
            y[row, 0] = y[row, n]
        elif chain.left == MIRROR:
            y[row, 0] = y[row, 2]
        y[row, n + 1] = 0.0
        if chain.right == FREE:
            y[row, n + 1] = y[row, n]
        elif chain.right == PERIODIC:
            y[row, n + 1] = y[row, 1]


@kernel
def may_cut(chain):
    """Return whether stretches of the chain can be integrated apart: those of a ring cannot."""
    return chain.left != PERIODIC


@kernel
def cut(chain, starts, ends):
    """Return the chain of a stretch that starts, or ends, where the whole does, or is cut off."""
    left = chain.left if starts else DIRICHLET
    right = chain.right if ends else DIRICHLET
    return Chain(chain.epsilon, chain.gamma, chain.omega, left, right)


@merged
def linear_field(chain, drive, left, u, right, partner):
    """Return the linear terms of one part of (4); `drive` is gamma for Re, -gamma for Im."""
    coupling = chain.epsilon * ((right + left) - 2.0 * u)
    return coupling + chain.omega * u + drive * (partner - u)


@merged
def field(chain, drive, left, u, right, partner, density):
    """Return one part of the right-hand side of (4)."""
    return linear_field(chain, drive, left, u, right, partner) + 0.5 * density * u


@merged
def site_rates(chain, y, re, j, density, dy):
    """Write i dA/dtau = F at column `j` of row pair `re`: Re A' = Im F and Im A' = -Re F.

    The states may be seen as `fours`: then it is four sites from `j` on.
    """
    im = re + 1
    partner = y.shape[0] - 2 - re  # the row itself when A = B: the drive then vanishes exactly
    gamma = chain.gamma
    dy[re, j] = field(
        chain, -gamma, y[im, j - 1], y[im, j], y[im, j + 1], y[partner + 1, j], density
    )
    dy[im, j] = -field(chain, gamma, y[re, j - 1], y[re, j], y[re, j + 1], y[partner, j], density)


@merged
def modulus2(y, re, j):
    """Return |A_n|^2 (or |B_n|^2) at column `j`; `re` is the row of the real parts."""
    return y[re, j] * y[re, j] + y[re + 1, j] * y[re + 1, j]
