"""The sites of both fronts in a state, and the mean powers in the regions behind them.

`sites` is an array (row, site) from the site 0 to the last one in motion. Its four rows are Re S,
Im S, Re D and Im D (see `sums`).
"""

import numpy as np

POWER = "power P = |A_n|^2 + |B_n|^2 of a pair, mean"
PREDICTED_SPEED = "speed of linear spreading, in sites per unit of tau; zero without a front"
"""Long names of these quantities in all datasets of this study."""

SLICE_LENGTH = 2.0
"""Largest interval in tau between two states that are measured; it is a multiple of the output
step."""

LEVEL = 1e-2
"""Power of a pair that a front has passed: P for the first front, |S|^2 for the second."""

BEHIND, BETWEEN = REGIONS = ("behind the second front", "between the fronts")
KINDS = ("P", "|S|^2")
SHARE, EDGE, AHEAD = 0.9, 40, 10
"""Sites up to the fraction SHARE of the second front's site count as behind it. EDGE sites behind
the first front and AHEAD sites ahead of the second do not count as between the fronts, because the
state still relaxes there. Behind the first front it relaxes over some hundred sites, so long runs
leave out more than EDGE sites."""


def site_powers(sites: np.ndarray) -> np.ndarray:
    """Return the sum of the squares of the rows, (site,)."""
    return (sites * sites).sum(axis=0)


def find_front(power: np.ndarray, level: float = LEVEL) -> float:
    """Return the last site at which the power (site,) exceeds a level, -1 if none does."""
    above = np.flatnonzero(power > level)
    return float(above[-1]) if above.size else -1.0


def region_means(sites: np.ndarray, front: float, second: float, edge: int = EDGE) -> np.ndarray:
    """Return the means of KINDS over REGIONS, (region, kind), NaN if a region has no sites.

    `sites` are rows of S and D. The centre is left out, and so are `edge` sites behind the first
    front.
    """
    values = np.array([site_powers(sites), site_powers(sites[:2])])
    ahead = max(1, int(second) + AHEAD) if second >= 0.0 else 1
    regions = slice(1, int(SHARE * second)), slice(ahead, int(front) - edge)
    means = np.full((len(REGIONS), len(KINDS)), np.nan)
    for mean, region in zip(means, regions, strict=True):
        if region.stop > region.start:
            mean[:] = np.add.reduce(values[:, region], axis=1) / (region.stop - region.start)
    return means
