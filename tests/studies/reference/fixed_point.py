"""Equation (4) for even data by power series in fixed-point integers: slow, plain, exact.

A number x is the Python integer x 2^bits, rounded down. Only the sites from the middle on are held:
data on the middle site stay even. Nothing here uses the library or heyoka.
"""

from fractions import Fraction
from math import floor

import numpy as np


def product(x, y, bits):
    """Return the last coefficient of the product of two series (order + 1, ...)."""
    return np.sum(x * y[::-1], axis=0) >> bits


def laplacian(u):
    """Return u_{n+1} - 2 u_n + u_{n-1} with u_{-1} = u_1 and a zero beyond the end."""
    result = -2 * u
    result[:, 1:] += u[:, :-1]
    result[:, :-1] += u[:, 1:]
    result[:, 0] += u[:, 1]
    return result


def power_series(re, im, omega, order, bits):
    """Return the series (order + 1, 2, N) of Re and Im, at epsilon = gamma = 1, `omega` an int."""
    a, b, density = (np.zeros((order + 1, *re.shape), object) for _ in range(3))
    a[0], b[0] = re, im
    for k in range(order):
        x, y = a[: k + 1], b[: k + 1]
        density[k] = product(x, x, bits) + product(y, y, bits)
        cubic = [product(density[: k + 1], u, bits) // 2 for u in (x, y)]
        # conj(B - A) has the parts Re (B - A) and Im (A - B)
        field_re = laplacian(a[k]) + omega * a[k] + (a[k, ::-1] - a[k]) + cubic[0]
        field_im = laplacian(b[k]) + omega * b[k] + (b[k] - b[k, ::-1]) + cubic[1]
        a[k + 1], b[k + 1] = field_im // (k + 1), -field_re // (k + 1)
    return a, b


def integrate(pair, omega, end, *, steps_per_unit, order, half_width=14, bits=128):
    """Return complex amplitudes (2, 2M + 1) at time `end`, each rounded once to double.

    `pair` = (A_0, B_0) are decimal strings. To tau = 1 the sites -4..4 are those of a longer chain
    to 1e-22, the norms too: of small data by 20 steps of order 24, of large data by 40 of order 32.
    """
    re = np.zeros((2, half_width + 1), object)
    re[:, 0] = [floor(Fraction(x) * 2**bits) for x in pair]
    im = re * 0
    for _ in range(round(end * steps_per_unit)):
        totals = []
        for series in power_series(re, im, omega, order, bits):
            total = series[order]
            for coefficient in series[order - 1 :: -1]:
                total = total // steps_per_unit + coefficient
            totals.append(total)
        re, im = totals
    half = (re / 2**bits).astype(float) + 1j * (im / 2**bits).astype(float)
    return np.concatenate([half[:, :0:-1], half], axis=1)
