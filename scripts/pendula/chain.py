"""The coupled dNLS equations (4) of the paper, their energy (8), and the ends of the chain.

A state is a real array `y[row, 1 + site]` with the rows Re A, Im A, Re B, Im B, or only the first
two when A = B; its sites are -M..M, or 0..M where the data are even in n. The first and the last
column are ghosts: what the ends of the chain see beyond themselves. Neighbours are summed as
(right + left) - 2 centre, which rounds alike under reflection, so that an even solution stays
even to the last bit.
"""

from math import cos, sin
from typing import NamedTuple

from .compiled import kernel

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


@kernel
def linear_field(chain, drive, left, u, right, partner):
    """Return the linear terms of one part of (4); `drive` is gamma for Re, -gamma for Im."""
    coupling = chain.epsilon * ((right + left) - 2.0 * u)
    return coupling + chain.omega * u + drive * (partner - u)


@kernel
def field(chain, drive, left, u, right, partner, density):
    """Return one part of the right-hand side of (4)."""
    return linear_field(chain, drive, left, u, right, partner) + 0.5 * density * u


@kernel
def site_rates(chain, y, re, j, density, dy):
    """Write i dA/dtau = F at column `j` of row pair `re`: Re A' = Im F and Im A' = -Re F."""
    im = re + 1
    partner = y.shape[0] - 2 - re  # the row itself when A = B: the drive then vanishes exactly
    gamma = chain.gamma
    dy[re, j] = field(
        chain, -gamma, y[im, j - 1], y[im, j], y[im, j + 1], y[partner + 1, j], density
    )
    dy[im, j] = -field(chain, gamma, y[re, j - 1], y[re, j], y[re, j + 1], y[partner, j], density)


@kernel
def modulus2(y, re, j):
    """Return |A_n|^2 (or |B_n|^2) at column `j`; `re` is the row of the real parts."""
    return y[re, j] * y[re, j] + y[re + 1, j] * y[re + 1, j]


@kernel
def rates(chain, y, dy):
    """Write the right-hand side of equations (4) at `y` into `dy` (same shape)."""
    close(chain, y)
    for re in range(0, y.shape[0], 2):
        for j in range(1, y.shape[1] - 1):
            site_rates(chain, y, re, j, modulus2(y, re, j), dy)


@kernel
def linear_rates(chain, y, dy):
    """Write the linear terms of the right-hand side at `y` into `dy`."""
    close(chain, y)
    for re in range(0, y.shape[0], 2):
        for j in range(1, y.shape[1] - 1):
            site_rates(chain, y, re, j, 0.0, dy)


@kernel
def linear_radius(chain):
    """Return a bound of the linear terms at a state whose largest modulus is one."""
    return 4.0 * abs(chain.epsilon) + abs(chain.omega) + 2.0 * abs(chain.gamma)


@kernel
def turn(y, h):
    """Carry `y` along the cubic terms alone, which turn each amplitude at a rate of its own.

    Sine and cosine are the C library's: their last bits may differ from machine to machine.

    Return whether none turned by a radian or more: no splitting could follow that.
    """
    resolved = True
    for re in range(0, y.shape[0], 2):
        for j in range(1, y.shape[1] - 1):
            angle = 0.5 * h * modulus2(y, re, j)
            resolved &= abs(angle) < 1.0
            c, s = cos(angle), sin(angle)
            u, v = y[re, j], y[re + 1, j]
            y[re, j] = c * u + s * v
            y[re + 1, j] = c * v - s * u
    return resolved


@kernel
def midpoint_rates(chain, old, new, middle, dy):
    """Write the energy-conserving mean of the right-hand side between `old` and `new` into `dy`.

    The linear terms act on the mean state (left in `middle`), the cubic one is the mean of |A|^2
    times the mean of A: then H(new) = H(old) exactly (Delfour, Fortin and Payre 1981).
    """
    for row in range(old.shape[0]):
        for j in range(old.shape[1]):
            middle[row, j] = 0.5 * (old[row, j] + new[row, j])
    close(chain, middle)
    for re in range(0, old.shape[0], 2):
        for j in range(1, old.shape[1] - 1):
            density = 0.5 * (modulus2(old, re, j) + modulus2(new, re, j))
            site_rates(chain, middle, re, j, density, dy)
