"""The state behind the front: power and energy of its sites, their spectrum and distribution.

The energy (8) is zero at rest and conserved, so what the front leaves behind has no energy per
site, however much power it has: the drive and the bonds pay for the cubic term. The waves at the
front's edge carry none either, since they grow.

If the bulk is in equilibrium, its states are distributed as exp(-beta H): energy is the only
integral, and the front leaves none behind, which fixes beta. Nothing is fitted. The module
`thermal` solves these states.
"""

from dataclasses import astuple

import numpy as np

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


def statistics_of(spectra, densities, cells: np.ndarray, along: tuple = ()) -> dict[str, Variable]:
    """Return as variables spectra (..., wave) and densities of the modulus between `cells`."""
    waves = 2.0 * np.pi * np.arange(LENGTH) / LENGTH
    return {
        "wave_number": Variable(("wave",), waves, "wave number k", "rad"),
        "spectrum": Variable((*along, "wave"), spectra, "mean |A(k)|^2 over pieces of the chain"),
        "modulus": Variable(("modulus",), 0.5 * (cells[1:] + cells[:-1])),
        "density": Variable((*along, "modulus"), densities, "probability density of the modulus"),
    }
