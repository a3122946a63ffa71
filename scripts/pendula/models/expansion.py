"""The expansion (3) of the pendula's angles in powers of mu, and its next order.

With E = exp(i omega t), omega^2 = 1 + mu^2 Omega, and amplitudes A, B that depend on the slow time
tau = mu^2 t / 2, Newton's equations (1) are solved by

    x_n = mu (A_n E + conj) + mu^3 (P_n E^3 + conj) + O(mu^5),
    P = -(A^3 / 6 + gamma (B - A)) / 8,                           Q = P with A and B exchanged,
    i dA/dtau = F + mu^2 G + O(mu^4),
    G = -Omega F / 2 - A'' / 4 + conj(A)^2 P / 2 - |A|^4 A / 12 + gamma (Q - P).

P is what the sine and the drive make at three times the frequency. F is the right-hand side of (4),
and A'' the second derivative of A along (4). Without the terms in P and G this is (3). The coupling
of neighbours acts on P by mu^5 only, so that neighbours enter G through F and A'' alone. With a
term that is wrong the orders of tests/studies/pendula/test_remainder.py would be lower.

Data. Angles x = 2 mu Re a and velocities dx/dt = -2 mu omega Im a, with given complex a, are those
of the amplitudes A = a + mu^2 d + O(mu^4) at tau = 0,

    d = -Re P + i (Im F / 2 - 3 Im P),

since x holds 2 mu^3 Re P, and dx/dt holds mu^3 (Re dA/dtau - 6 Im P) with dA/dtau = -i F. So the
pendula need no data of their own to be followed to the next order.
"""

from typing import NamedTuple

import numpy as np
from latticode.generation.chain import at_every_site
from latticode.kernels.compiled import inlined_by_llvm, kernel

from . import amplitudes
from .amplitudes import Chain, modulus2, tangent_rates


class Expansion(NamedTuple):
    """The chain of (4), mu^2 (zero for the leading order), and room for A' and A''."""

    chain: Chain
    squared_mu: float
    first: np.ndarray  # of the shape of a state
    second: np.ndarray


@inlined_by_llvm
def rates_at_site(expansion, states, re, j, dy):
    """Write A' = -i (F + mu^2 G) at column `j`, where F = i A' of the leading order.

    With P and Q put in, and d = B - A, the terms of G beside those in F and A'' are

        gamma^2 d / 4 - gamma conj(A)^2 d / 16 - gamma (B^3 - A^3) / 48 - 3 |A|^4 A / 32.
    """
    y, first, second = states
    im, other = re + 1, y.shape[0] - 2 - re
    u, v, s, t = y[re, j], y[im, j], y[other, j], y[other + 1, j]
    p, q, square = s - u, t - v, modulus2(y, re, j)
    gamma, fifth = expansion.chain.gamma, 0.09375 * (square * square)
    turned_re, turned_im = (
        (u * u - v * v) * p + 2.0 * (u * v) * q,
        (u * u - v * v) * q - 2.0 * (u * v) * p,
    )
    cubes_re = s * (s * s - 3.0 * (t * t)) - u * (u * u - 3.0 * (v * v))
    cubes_im = t * (3.0 * (s * s) - t * t) - v * (3.0 * (u * u) - v * v)
    linear, mixed, cubic = 0.25 * gamma * gamma, 0.0625 * gamma, gamma / 48.0
    g_re = linear * p - mixed * turned_re - cubic * cubes_re - fifth * u - 0.25 * second[re, j]
    g_im = linear * q - mixed * turned_im - cubic * cubes_im - fifth * v - 0.25 * second[im, j]
    half_omega = 0.5 * expansion.chain.omega
    dy[re, j] = first[re, j] + expansion.squared_mu * (g_im - half_omega * first[re, j])
    dy[im, j] = first[im, j] - expansion.squared_mu * (g_re + half_omega * first[im, j])


write_rates = at_every_site(rates_at_site)


@kernel
def rates(expansion, y, dy):
    """Write the rates of the amplitudes `y` to the order of `expansion` into `dy` (same shape)."""
    amplitudes.rates(expansion.chain, y, expansion.first)
    tangent_rates(expansion.chain, y, expansion.first, expansion.second)
    write_rates(expansion, (y, expansion.first, expansion.second), dy)


@inlined_by_llvm
def third_harmonic(gamma, u, v, s, t):
    """Return Re P and Im P where A = u + i v and B = s + i t; all are numbers, or arrays alike."""
    square_re, square_im = u * u - v * v, 2.0 * (u * v)
    cube_re, cube_im = u * square_re - v * square_im, u * square_im + v * square_re
    sixth = 1.0 / 6.0
    re = -0.125 * (sixth * cube_re + gamma * (s - u))
    return re, -0.125 * (sixth * cube_im + gamma * (t - v))


def corrected_start(chain: Chain, squared_mu: float, y: np.ndarray) -> np.ndarray:
    """Return the state of A = a + mu^2 d, which has the angles and velocities of a in `y`."""
    slope, found = np.zeros_like(y), y.copy()
    amplitudes.rates(chain, y.copy(), slope)
    re, im, partners = y[0::2], y[1::2], y[::-1]
    third = third_harmonic.py_func(chain.gamma, re, im, partners[1::2], partners[0::2])
    found[0::2] -= squared_mu * third[0]
    found[1::2] += squared_mu * (0.5 * slope[0::2] - 3.0 * third[1])
    return found


@inlined_by_llvm
def angle(mu, gamma, third, turn, u, v, s, t):
    """Return the angle of a pendulum, whose A = u + i v and whose partner's is B = s + i t.

    `turn` holds Re E, Im E, Re E^3 and Im E^3, and `third` is a factor of the third
    harmonic, which (3) leaves out.
    """
    re, im = third_harmonic(gamma, u, v, s, t)
    small = 2.0 * third * mu * mu * mu
    return 2.0 * mu * (u * turn[0] - v * turn[1]) + small * (re * turn[2] - im * turn[3])
