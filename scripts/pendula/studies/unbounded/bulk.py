"""The state behind the fronts: power and energy of its sites, and means over time.

The energy (8) is zero at rest and conserved, so what the fronts leave behind has no energy per
site on average, however much power it has: the drive and the bonds pay for the cubic term.

Behind the first front A = -B, up to a second one behind which both fields move. If these states are
in equilibrium, they are distributed as exp(-beta H): energy is the only integral, and it is zero,
which fixes beta. Nothing is fitted. The module `thermal` solves these states.

`sites` are four rows on the sites 0..W, (row, site): Re and Im of A and B, or of S and D (`sums`).
"""

from itertools import pairwise

import numpy as np
from latticode.measures.confidence import CONFIDENCE, Limits
from latticode.measures.spreading import fit_line
from latticode.numerics.elementary import log

from pendula.problem import Constants

from .sums import halves, turned

BEHIND, BETWEEN = REGIONS = ("behind the second front", "between the fronts")
KINDS = ("P", "|S|^2", "H")
SHARE, EDGE, AHEAD = 0.9, 40, 10
"""The part of the way to a front that counts as behind it, and how many sites behind the first and
ahead of the second front do not count as between them: there the state is yet to settle."""

OLD, NEIGHBOURS = 0.5, 2 ** np.arange(7)
"""The part of the way to the front, and the sizes of the blocks, that a maximum is taken of."""

CELL = 10
"""Sites of a cell of the profiles."""

POWER = "power P = |A_n|^2 + |B_n|^2 of a pair, its mean"


def site_powers(sites: np.ndarray) -> np.ndarray:
    """Return the sum of the squares of the rows, (site,)."""
    return (sites * sites).sum(axis=0)


def energies(sites: np.ndarray, constants: Constants) -> np.ndarray:
    """Return the energy (8) of each site, (site,), of rows of S and D.

    A bond belongs to its left site; beyond the last site is rest.
    """
    ab = turned(sites)
    a, b = (site_powers(part) for part in halves(ab))
    drive = 2.0 * (sites[2] * sites[2] - sites[3] * sites[3])  # Re (A_n - B_n)^2
    bonds = site_powers(np.diff(sites, append=0.0))
    own = 0.25 * (a * a + b * b) + constants.omega * (a + b) - constants.gamma * drive
    return own - constants.epsilon * bonds


def region_means(
    sites: np.ndarray, constants: Constants, front: float, second: float
) -> np.ndarray:
    """Return the means of KINDS over REGIONS, (region, kind), NaN where one has no sites.

    `sites` are rows of S and D. The centre is left out.
    """
    values = np.array([
        site_powers(sites), site_powers(sites[:2]), energies(sites, constants)
    ])  # fmt: skip
    ahead = max(1, int(second) + AHEAD) if second >= 0.0 else 1
    regions = slice(1, int(SHARE * second)), slice(ahead, int(front) - EDGE)
    found = np.full((len(REGIONS), len(KINDS)), np.nan)
    for mean, region in zip(found, regions, strict=True):
        if region.stop > region.start:
            mean[:] = np.add.reduce(values[:, region], axis=1) / (region.stop - region.start)
    return found


def bulk_maxima(sites: np.ndarray, front: float) -> np.ndarray:
    """Return the largest modulus |A_n| or |B_n| of blocks of sites, its mean over blocks, (size,).

    `sites` are rows of A and B. Blocks of NEIGHBOURS sites lie side by side on the first half of
    the way to the front, the centre left out: what the front has just passed is not yet in
    equilibrium. The mean is NaN where no block fits in.
    """
    squares = np.maximum(*(site_powers(part) for part in halves(sites)))
    moduli = np.sqrt(squares)[1 : max(1, int(OLD * front))]
    found = np.full(len(NEIGHBOURS), np.nan)
    for i, size in enumerate(NEIGHBOURS[: np.searchsorted(NEIGHBOURS, moduli.size, "right")]):
        blocks = moduli[: moduli.size // size * size].reshape(-1, size)
        found[i] = np.add.reduce(blocks.max(axis=1)) / len(blocks)
    return found


def cell_means(sites: np.ndarray) -> np.ndarray:
    """Return means of |S|^2 and |D|^2 over cells of CELL sites from the centre on, (2, cell)."""
    count = sites.shape[1] // CELL
    parts = np.array([site_powers(part) for part in halves(sites)])
    cells = parts[:, : count * CELL].reshape(2, count, CELL)
    return np.add.reduce(cells, axis=2) / CELL


# --- Means over the late part of runs -------------------------------------------------------------

LATE = 0.5
"""The part of a run, at its end, that means over time are taken of."""

FIRST_OF_LINE = 0.25
"""The line through l2^2 starts at this part of a run."""


def late_means(values, run, spans: int = 1) -> np.ndarray:
    """Return means of values (..., piece_tau) over spans of a run's late part, (span, ...).

    Looks without a value are left out; a mean is NaN where there is none.
    """
    tau = run["piece_tau"].values
    edges = np.linspace(1.0 - LATE, 1.0, spans + 1) * tau[-1]
    late = [(tau > first) & (tau <= last) for first, last in pairwise(edges)]
    return np.array([_mean_of_known(values[..., span]) for span in late])


def _mean_of_known(values: np.ndarray) -> np.ndarray:
    known = np.isfinite(values)
    counts = known.sum(axis=-1)
    sums = np.where(known, values, 0.0).sum(axis=-1)
    return np.where(counts > 0, sums / np.maximum(counts, 1), np.nan)


def powers_of(run, region: str, kind: str = "P") -> np.ndarray:
    """Return a mean over a region at every look, (variant, member, piece_tau)."""
    found = run["region_mean"].sel(region=region, kind=kind)
    return found.transpose("variant", "member", "piece_tau").values


def mean_powers(run, region: str, kind: str = "P") -> np.ndarray:
    """Return the same, mean over the late part of a run, (variant, member)."""
    return late_means(powers_of(run, region, kind), run)[0]


# --- The law of l2^2 ------------------------------------------------------------------------------


def thermal_powers(thermal, omegas: np.ndarray, name: str = "power") -> np.ndarray:
    """Return P of the thermal states of no energy at each Omega, NaN where none was solved.

    That of A = -B has the name "antisymmetric_power".
    """
    found = thermal[name].reindex(omega=np.atleast_1d(omegas), method="nearest", tolerance=1e-9)
    return found.values.reshape(np.shape(omegas))


def law_of(run, thermal, transverse) -> np.ndarray:
    """Return l2^2 as thermal states and predicted speeds have it, (variant, tau); no constant fits.

    It is 2 (v_2 P + (v_1 - v_2) P') tau less 2 P' delay ln tau, which a pulled front loses on its
    way; P' is that of A = -B. NaN where no front is pulled or no state was solved.
    """
    omegas, delay = run["omega"].values, run["predicted_delay"].values
    known = transverse.reindex(omega=omegas, method="nearest", tolerance=1e-9)
    first, second = run["predicted_speed"].values, known["second_speed"].values
    both = thermal_powers(thermal, omegas)
    alone = thermal_powers(thermal, omegas, "antisymmetric_power")
    rates = 2.0 * (second * both + (first - second) * alone)
    lost, tau = 2.0 * alone * delay, np.maximum(run["tau"].values, 1.0)
    law = rates[:, None] * tau - lost[:, None] * log(tau)
    return np.where(delay[:, None] > 0.0, law, np.nan)


def slope_ratios(run, laws: np.ndarray, confidence: float = CONFIDENCE) -> list[Limits]:
    """Return the slope of l2^2 over its law (variant, tau) of each variant, with limits.

    The limits are over the members. Where the law begins is not known: an offset is fitted.
    """
    tau, found = run["tau"].values, []
    kept = tau >= FIRST_OF_LINE * tau[-1]
    for variant, law in enumerate(laws[:, kept]):
        if not np.isfinite(law).all():
            found.append(Limits(np.nan, np.nan, np.nan))
            continue
        squares = run["l2"].isel(variant=variant).transpose("member", "tau").values[:, kept] ** 2
        found.append(fit_line(law, squares, law[0], confidence).slope)
    return found
