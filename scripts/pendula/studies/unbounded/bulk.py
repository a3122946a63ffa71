"""The state behind the front: power and energy of its sites, their spectrum and distribution.

The energy (8) is zero at rest and conserved, so what the front leaves behind has no energy per
site, however much power it has: the drive and the bonds pay for the cubic term. The waves at the
front's edge carry none either, since they grow.

If the bulk is in equilibrium, its states are distributed as exp(-beta H): energy is the only
integral, and the front leaves none behind, which fixes beta. Nothing is fitted. The module
`thermal` solves these states.

`sites` are the rows Re A, Im A, Re B, Im B on the sites 0..W, (row, site).
"""

from itertools import pairwise

import numpy as np

from pendula.datasets.netcdf import Variable
from pendula.measures.confidence import CONFIDENCE, Limits
from pendula.measures.spreading import fit_line
from pendula.numerics.elementary import log, product, square_modulus, turn
from pendula.problem import Constants

TERMS = ("cubic", "detuning", "drive", "bonds")
SHARE = 0.9
"""The part of the way to the front that counts as the bulk."""

OLD, NEIGHBOURS = 0.5, 2 ** np.arange(7)
"""The part of the way to the front, and the sizes of the blocks, that a maximum is taken of."""

LENGTH = 64
"""Sites of the pieces that a spectrum is averaged over."""

POWER = "power P = |A_n|^2 + |B_n|^2 of a site, its mean"


def squares_of(rows: np.ndarray) -> np.ndarray:
    """Return |A_n|^2 and |B_n|^2, (component, site)."""
    squares = rows * rows
    return squares[0::2] + squares[1::2]


def energy_terms(sites: np.ndarray, constants: Constants) -> np.ndarray:
    """Return the terms of (8) on the sites 0..W, (term, site); a bond belongs to its left site.

    Beyond the last site is rest.
    """
    a, b = squares_of(sites)
    bonds = squares_of(np.diff(sites, append=0.0)).sum(axis=0)
    real, imaginary = sites[:2] - sites[2:]
    drive = real * real - imaginary * imaginary  # Re (A_n - B_n)^2
    terms = (
        0.25 * (a * a + b * b),
        constants.omega * (a + b),
        -constants.gamma * drive,
        -constants.epsilon * bonds,
    )
    return np.array(terms)


def bulk_of(front: float) -> slice:
    """Return the sites of the bulk: well behind the front, the centre left out."""
    return slice(1, max(2, int(SHARE * front)))


def bulk_means(sites: np.ndarray, constants: Constants, fronts: np.ndarray) -> np.ndarray:
    """Return the means of P and of the terms of (8) over the bulk behind each front, (front, 5)."""
    values = np.array([squares_of(sites).sum(axis=0), *energy_terms(sites, constants)])
    bulks = [values[:, bulk_of(front)] for front in fronts]
    return np.array([np.add.reduce(bulk, axis=1) / bulk.shape[1] for bulk in bulks])


def bulk_maxima(sites: np.ndarray, front: float) -> np.ndarray:
    """Return the largest modulus |A_n| or |B_n| of blocks of sites, its mean over blocks, (size,).

    Blocks of NEIGHBOURS sites lie side by side on the first half of the way to the front, the
    centre left out: what the front has just passed is not yet in equilibrium. The mean is NaN
    where no block fits in.
    """
    moduli = np.sqrt(squares_of(sites).max(axis=0))[1 : max(1, int(OLD * front))]
    found = np.full(len(NEIGHBOURS), np.nan)
    for i, size in enumerate(NEIGHBOURS[: np.searchsorted(NEIGHBOURS, moduli.size, "right")]):
        blocks = moduli[: moduli.size // size * size].reshape(-1, size)
        found[i] = np.add.reduce(blocks.max(axis=1)) / len(blocks)
    return found


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
    sites = np.arange(length)
    waves = turn(-2.0 * np.pi / length * (np.outer(sites, sites) % length))  # (site, wave)
    amplitudes = sum(product(pieces[:, n, None], waves[n]) for n in range(length))
    return square_modulus(amplitudes).mean(axis=0) / length


def statistics_of(spectra, densities, cells: np.ndarray, along: tuple = ()) -> dict[str, Variable]:
    """Return as variables spectra (..., wave) and densities of the modulus between `cells`."""
    waves = 2.0 * np.pi * np.arange(LENGTH) / LENGTH
    return {
        "wave_number": Variable(("wave",), waves, "wave number k", "rad"),
        "spectrum": Variable((*along, "wave"), spectra, "mean |A(k)|^2 over pieces of the chain"),
        "modulus": Variable(("modulus",), 0.5 * (cells[1:] + cells[:-1])),
        "density": Variable((*along, "modulus"), densities, "probability density of the modulus"),
    }


# --- Means over the late part of runs -------------------------------------------------------------

LATE = 0.5
"""The part of a run, at its end, that means over time are taken of."""

FIRST_OF_LINE = 0.25
"""The line through l2^2 starts at this part of a run."""


def late_means(values, run, spans: int = 1) -> np.ndarray:
    """Return means of values (..., piece_tau) over spans of a run's late part, (span, ...)."""
    tau = run["piece_tau"].values
    edges = np.linspace(1.0 - LATE, 1.0, spans + 1) * tau[-1]
    late = [(tau > first) & (tau <= last) for first, last in pairwise(edges)]
    return np.array([values[..., span].mean(axis=-1) for span in late])


def bulk_powers(run, level: float) -> np.ndarray:
    """Return P of the bulk behind a front at every look, (variant, member, piece_tau)."""
    powers = run["bulk_power"].sel(front_power=level)
    return powers.transpose("variant", "member", "piece_tau").values


def mean_powers(run, level: float = 1e-2) -> np.ndarray:
    """Return P of the bulk, mean over the late part of a run, (variant, member)."""
    return late_means(bulk_powers(run, level), run)[0]


def mean_terms(run, level: float) -> np.ndarray:
    """Return the terms of H a site of the bulk, late means, (variant, member, term)."""
    terms = run["bulk_terms"].sel(front_power=level)
    values = terms.transpose("variant", "member", "term", "piece_tau").values
    return late_means(values, run)[0]


def slope_powers(run, confidence: float = CONFIDENCE) -> list[Limits]:
    """Return P of each variant from the slope of l2^2, with limits over the members.

    A pulled front of the speed v has passed v tau - delay log tau + const sites on either side, so
    l2^2 is P times twice that and a constant. NaN where no front is pulled.
    """
    tau = run["tau"].values
    kept, found = tau >= FIRST_OF_LINE * tau[-1], []
    for variant in range(run.sizes["variant"]):
        one = run.isel(variant=variant)
        speed, delay = float(one["predicted_speed"]), float(one["predicted_delay"])
        if not delay > 0.0:
            found.append(Limits(np.nan, np.nan, np.nan))
            continue
        sites = 2.0 * (speed * tau[kept] - delay * log(tau[kept]))
        squares = one["l2"].transpose("member", "tau").values[:, kept] ** 2
        found.append(fit_line(sites, squares, sites[0], confidence).slope)
    return found


def thermal_powers(thermal, omegas: np.ndarray) -> np.ndarray:
    """Return P of the thermal states of no energy at each Omega, NaN where none was solved."""
    found = thermal["power"].reindex(omega=np.atleast_1d(omegas), method="nearest", tolerance=1e-9)
    return found.values.reshape(np.shape(omegas))
