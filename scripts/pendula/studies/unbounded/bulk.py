"""The state behind the front: power and energy of its sites, their spectrum and distribution.

The energy (8) is zero at rest and conserved, so what the front leaves behind has no energy per
site, however much power it has: the drive and the bonds pay for the cubic term. The waves at the
front's edge carry none either, since they grow.

If the bulk is in equilibrium, its states are distributed as exp(-beta H): energy is the only
integral, and the front leaves none behind, which fixes beta. Nothing is fitted. Metropolis'
algorithm samples these states on a ring, site by site.
"""

from dataclasses import astuple
from math import exp
from typing import NamedTuple

import numpy as np

from pendula.compiled import kernel
from pendula.datasets.netcdf import Variable
from pendula.problem import Constants

TERMS = ("cubic", "detuning", "drive", "bonds")
SHARE = 0.9
"""The part of the way to the front that counts as the bulk."""

LENGTH = 64
"""Sites of the pieces that a spectrum is averaged over."""

POWER = "mean power P = |A_n|^2 + |B_n|^2 of a site"


def energy_terms(state: np.ndarray, constants: Constants) -> np.ndarray:
    """Return the terms of (8) on the sites 0..W, (term, site); a bond belongs to its left site."""
    epsilon, gamma, omega = astuple(constants)
    a, b = complex_pair(state)
    squares = np.abs([a, b]) ** 2
    difference = a - b
    bonds = np.abs(np.diff([[*a, 0.0], [*b, 0.0]], axis=1)) ** 2
    return np.array(
        [
            0.25 * (squares**2).sum(axis=0),
            omega * squares.sum(axis=0),
            -gamma * (difference.real**2 - difference.imag**2),
            -epsilon * bonds.sum(axis=0),
        ]
    )


def complex_pair(state: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return A and B on the sites 0..W of a state with ghost columns."""
    inner = state[:, 1:-1]
    a = inner[0] + 1j * inner[1]
    return a, (inner[2] + 1j * inner[3] if len(inner) == 4 else a)


def with_ghosts(sites: np.ndarray) -> np.ndarray:
    """Return the state with ghost columns of (row, site) as a dataset keeps it."""
    return np.pad(sites, ((0, 0), (1, 1)))


def bulk_of(state: np.ndarray, front: int) -> slice:
    """Return the sites of the bulk: well behind the front, the centre left out."""
    return slice(1, max(2, int(SHARE * front)))


def end_of_bulk(sites: np.ndarray, level: float = 1.0) -> int:
    """Return the last site of (row, site) whose power is above `level`."""
    return int(np.flatnonzero((sites**2).sum(axis=0) > level).max(initial=0))


def tail_scale(sites: np.ndarray, front: int, share: float = 0.1) -> float:
    """Return the mean excess of |A_n|^4, |B_n|^4 in the bulk over what a `share` of them exceed.

    Where the moduli are distributed as exp(-|A|^4 / scale), the largest of N of them to the fourth
    power grows as scale log N.
    """
    inside = bulk_of(with_ghosts(sites), front)
    fourth = np.concatenate([np.abs(z[inside]) ** 4 for z in complex_pair(with_ghosts(sites))])
    level = np.quantile(fourth, 1.0 - share)
    return float((fourth[fourth > level] - level).mean())


def profile(values: np.ndarray, edges: np.ndarray) -> np.ndarray:
    """Return the means of values (..., site) between consecutive sites `edges`."""
    totals = np.concatenate([np.zeros((*values.shape[:-1], 1)), values.cumsum(axis=-1)], axis=-1)
    picked = totals[..., np.clip(edges, 0, values.shape[-1])]
    return np.diff(picked, axis=-1) / np.diff(edges)


def spectrum(amplitudes: np.ndarray, length: int) -> np.ndarray:
    """Return the mean of |A(k)|^2 over pieces of `length` sites, k = 2 pi j / length, j < length.

    Its mean over k is the mean of |A_n|^2. Sites beyond the last whole piece are left out.
    """
    pieces = amplitudes[: len(amplitudes) // length * length].reshape(-1, length)
    return (np.abs(np.fft.fft(pieces, axis=1)) ** 2).mean(axis=0) / length


def distribution(moduli: np.ndarray, edges: np.ndarray) -> np.ndarray:
    """Return the probability density of the moduli between `edges`; its integral is one."""
    return np.histogram(moduli, edges, density=True)[0]


def mean_powers(runs, level: float = 1e-2) -> np.ndarray:
    """Return the mean power in the bulk at the end of runs (a dataset), (variant, member)."""
    fronts = runs["front"].isel(piece_tau=-1).sel(front_power=level).transpose("variant", "member")
    states = runs["state"].transpose("variant", "member", "row", "site").values
    return np.array(
        [
            [
                (state[:, bulk_of(state, int(front))] ** 2).sum(axis=0).mean()
                for state, front in zip(*pair, strict=True)
            ]
            for pair in zip(states, fronts.values, strict=True)
        ]
    )


# --- The thermal states without energy ------------------------------------------------------------

SITES, SETTLING, KEPT, SEED = 128, 400, 1200, 2017
"""Sites of the ring, sweeps that are thrown away, sweeps that are averaged over, and the seed."""


class Thermal(NamedTuple):
    """Samples of exp(-beta H): states (sample, row, site) and their energies per site."""

    beta: float
    states: np.ndarray
    energies: np.ndarray  # (sample,)

    def at_zero_energy(self, values: np.ndarray) -> float:
        """Return the mean of values (sample,) at zero energy, off which the samples scatter.

        Their covariance with the energy tells how they would change with it.
        """
        return _at_zero_energy(values, self.energies)

    def error_at_zero_energy(self, values: np.ndarray, blocks: int = 20) -> float:
        """Return the standard error of that mean, by a jackknife over consecutive samples.

        Blocks of samples are left out in turn, since neighbouring samples are alike.
        """
        left_out = np.array_split(np.arange(len(values)), blocks)
        without = [
            _at_zero_energy(np.delete(values, block), np.delete(self.energies, block))
            for block in left_out
        ]
        return float(np.sqrt((blocks - 1) * np.var(without)))


def _at_zero_energy(values: np.ndarray, energies: np.ndarray) -> float:
    slope = np.cov(values, energies)[0, 1] / energies.var(ddof=1)
    return float(values.mean() - slope * energies.mean())


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


def sample(constants: Constants, beta: float, seed: int = SEED) -> Thermal:
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
    squares = np.abs([a, b]) ** 2
    bonds = np.abs(np.array([a - np.roll(a, 1, axis=1), b - np.roll(b, 1, axis=1)])) ** 2
    on_sites = (0.25 * squares**2 + omega * squares - epsilon * bonds).sum(axis=0)
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


HIGHEST_MODULUS, CELLS = 12.0, 80


def thermal_variables(omegas: list[float], found: list[Thermal]) -> dict[str, Variable]:
    """Return the statistics of the thermal states without energy, one for each Omega."""
    amplitudes = [thermal.states[:, 0::2] + 1j * thermal.states[:, 1::2] for thermal in found]
    cells = np.linspace(0.0, HIGHEST_MODULUS, CELLS + 1)
    sampled = [(thermal.states**2).sum(axis=1).mean(axis=1) for thermal in found]
    powers = [thermal.at_zero_energy(p) for thermal, p in zip(found, sampled, strict=True)]
    errors = [thermal.error_at_zero_energy(p) for thermal, p in zip(found, sampled, strict=True)]
    energies, along = [thermal.energies.mean() for thermal in found], ("omega",)
    return {
        "omega": Variable(along, np.array(omegas, float)),
        "beta": Variable(along, [t.beta for t in found], "inverse temperature"),
        "mean_energy": Variable(along, energies, "energy per site, mean of the samples"),
        "power": Variable(along, powers, POWER),
        "power_error": Variable(along, errors, f"standard error of the {POWER}"),
        **statistics_of(
            [spectrum(z.ravel(), LENGTH) for z in amplitudes],
            [distribution(np.abs(z), cells) for z in amplitudes],
            cells,
            along,
        ),
    }


def statistics_of(spectra, densities, cells: np.ndarray, along: tuple = ()) -> dict[str, Variable]:
    """Return as variables spectra (..., wave) and densities of the modulus between `cells`."""
    waves = 2.0 * np.pi * np.arange(LENGTH) / LENGTH
    return {
        "wave_number": Variable(("wave",), waves, "wave number k", "rad"),
        "spectrum": Variable((*along, "wave"), spectra, "mean |A(k)|^2 over pieces of the chain"),
        "modulus": Variable(("modulus",), 0.5 * (cells[1:] + cells[:-1])),
        "density": Variable((*along, "modulus"), densities, "probability density of the modulus"),
    }
