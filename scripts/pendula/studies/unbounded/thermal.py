"""The thermal state of zero energy per site, with which the sea behind the front is compared.

If the sea is in equilibrium, its states are distributed as exp(-beta H): energy is the only
integral, and the front leaves none behind, which fixes beta. Nothing is fitted. Sampled by
Metropolis' algorithm on a ring, site by site.
"""

from dataclasses import astuple
from math import exp
from typing import NamedTuple

import numpy as np

from pendula.compiled import kernel
from pendula.problem import Constants

SITES, SETTLING, KEPT = 128, 400, 1200
"""Sites of the ring, sweeps that are thrown away, and sweeps that are averaged over."""


class Thermal(NamedTuple):
    """Samples of exp(-beta H): states (sample, row, site) and their energies per site."""

    beta: float
    states: np.ndarray
    energies: np.ndarray  # (sample,)

    def at_zero_energy(self, values: np.ndarray) -> float:
        """Return the mean of values (sample,) at zero energy, off which the samples scatter.

        Their covariance with the energy tells how they would change with it.
        """
        slope = np.cov(values, self.energies)[0, 1] / self.energies.var(ddof=1)
        return float(values.mean() - slope * self.energies.mean())


@kernel
def site_energy(constants, a, b, c, d, left, right):
    """Return the terms of (8) that the values a + ib, c + id of one site take part in.

    `constants` are (epsilon, gamma, Omega), as plain numbers for the compiler.
    """
    epsilon, gamma, omega = constants
    first, second = a * a + b * b, c * c + d * d
    real, imaginary = a - c, b - d
    bonds = 0.0
    for side in (left, right):
        bonds += (a - side[0]) ** 2 + (b - side[1]) ** 2
        bonds += (c - side[2]) ** 2 + (d - side[3]) ** 2
    local = 0.25 * (first * first + second * second) + omega * (first + second)
    return local - gamma * (real * real - imaginary * imaginary) - epsilon * bonds


@kernel
def sweep_ring(constants, beta, y, moves, chances):
    """Offer each site of `y` (site, row) its move in turn; return how many were taken."""
    sites = y.shape[0]
    taken = 0
    for n in range(sites):
        left, right = y[n - 1], y[(n + 1) % sites]
        u, v = y[n], moves[n]
        before = site_energy(constants, u[0], u[1], u[2], u[3], left, right)
        after = site_energy(
            constants, u[0] + v[0], u[1] + v[1], u[2] + v[2], u[3] + v[3], left, right
        )
        if chances[n] < exp(min(0.0, -beta * (after - before))):
            for row in range(4):
                u[row] += v[row]
            taken += 1
    return taken


def sample(constants: Constants, beta: float, seed: int = 2017) -> Thermal:
    """Return samples of exp(-beta H) on a ring, one after each kept sweep."""
    rng = np.random.default_rng(seed)
    y = rng.normal(size=(SITES, 4))
    step, states = 1.0, np.empty((KEPT, 4, SITES))
    for count in range(SETTLING + KEPT):
        moves = step * rng.normal(size=(SITES, 4))
        taken = sweep_ring(astuple(constants), beta, y, moves, rng.random(SITES))
        if count < SETTLING:  # half of the moves should be taken
            step *= 1.05 if taken > SITES / 2 else 0.95
        else:
            states[count - SETTLING] = y.T
    return Thermal(beta, states, ring_energies(states, constants))


def ring_energies(states: np.ndarray, constants: Constants) -> np.ndarray:
    """Return H per site of each of the states (sample, row, site) on a ring."""
    epsilon, gamma, omega = astuple(constants)
    a, b = states[:, 0] + 1j * states[:, 1], states[:, 2] + 1j * states[:, 3]
    density = np.abs([a, b]) ** 2
    bonds = np.abs(np.array([a - np.roll(a, 1, axis=1), b - np.roll(b, 1, axis=1)])) ** 2
    on_sites = (0.25 * density**2 + omega * density - epsilon * bonds).sum(axis=0)
    return (on_sites - gamma * ((a - b) ** 2).real).mean(axis=1)


def zero_energy(constants: Constants, halvings: int = 9) -> Thermal:
    """Return the thermal state without energy; raises ValueError where there is none.

    The same random numbers at every beta make the energy a smooth, falling function of it.
    """
    hot, cold = 3e-3, 30.0
    if sample(constants, cold).energies.mean() > 0.0:
        raise ValueError("no thermal state between these temperatures is without energy")
    for _ in range(halvings):
        beta = float(np.sqrt(hot * cold))
        found = sample(constants, beta)
        hot, cold = (beta, cold) if found.energies.mean() > 0.0 else (hot, beta)
    return found
