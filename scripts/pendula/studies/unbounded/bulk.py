"""Where the fronts are on the sites of a state, and the powers of what they leave behind.

`sites` are four rows on the sites 0..W, (row, site): Re and Im of S and D (see `sums`).
"""

import numpy as np

POWER = "power P = |A_n|^2 + |B_n|^2 of a pair, its mean"
PREDICTED_SPEED = "speed of linear spreading, in sites per unit of tau; zero: no front is pulled"
"""What these quantities are called in every dataset of this study."""

SLICE_LENGTH = 2.0
"""Units of tau between two looks at a run, at most: a piece of it is a whole number of outputs."""

LEVEL = 1e-2
"""Power of a pair at which the fronts are found: of P the first, of its part |S|^2 the second."""

BEHIND, BETWEEN = REGIONS = ("behind the second front", "between the fronts")
KINDS = ("P", "|S|^2")
SHARE, EDGE, AHEAD = 0.9, 40, 10
"""The part of the way to a front that counts as behind it, and how many sites behind the first and
ahead of the second front do not count as between them: there the state is yet to settle. Behind the
first it does so over some hundred sites, so that long runs leave out more of them than EDGE."""


def site_powers(sites: np.ndarray) -> np.ndarray:
    """Return the sum of the squares of the rows, (site,)."""
    return (sites * sites).sum(axis=0)


def find_front(power: np.ndarray, level: float = LEVEL) -> float:
    """Return the last site where the power (site,) is above a level, -1 if none is."""
    above = np.flatnonzero(power > level)
    return float(above[-1]) if above.size else -1.0


def region_means(sites: np.ndarray, front: float, second: float, edge: int = EDGE) -> np.ndarray:
    """Return the means of KINDS over REGIONS, (region, kind), NaN where one has no sites.

    `sites` are rows of S and D. The centre is left out, and `edge` sites behind the first front.
    """
    values = np.array([site_powers(sites), site_powers(sites[:2])])
    ahead = max(1, int(second) + AHEAD) if second >= 0.0 else 1
    regions = slice(1, int(SHARE * second)), slice(ahead, int(front) - edge)
    means = np.full((len(REGIONS), len(KINDS)), np.nan)
    for mean, region in zip(means, regions, strict=True):
        if region.stop > region.start:
            mean[:] = np.add.reduce(values[:, region], axis=1) / (region.stop - region.start)
    return means
