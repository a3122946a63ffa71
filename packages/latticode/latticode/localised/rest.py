"""Detection of sites that stay at rest at an unstable point, such as unexcited, uncoupled sites.

Perturbations of such a site grow although nothing moves there. The Lyapunov exponent of the chain
is the largest growth rate, so it may describe such a site and not the motion.
"""

import numpy as np

from latticode.simulation.problem import Problem

from .breathers import MOST_UNKNOWNS, flat
from .linearised import linearise

MOST_NAMED = 4
"""Number of sites that a message lists at most."""
PRESENT = 1e-6
"""A site is part of a growing mode if its amplitude exceeds this fraction of the largest."""


def growth_at_rest(problem: Problem, is_constant: np.ndarray) -> tuple[np.ndarray, float]:
    """Return the sites at rest where perturbations grow, and the largest growth rate.

    A site is at rest if it `is_constant` (site,) during the run and its rates vanish at the start.
    Perturbations of all sites at rest are linearised with the moving sites fixed. Perturbations
    that grow by less than a factor of e during the run are ignored. The array of sites is empty if
    the equations have no derivative at rest.
    """
    with np.errstate(all="ignore"):
        rates, matrix = linearise(problem, flat(problem.amplitudes))
    resting = is_constant & (rates.reshape(-1, problem.sites) == 0.0).all(axis=0)
    rows = np.tile(resting, len(problem.model.rates))
    matrix = matrix[np.ix_(rows, rows)]
    if not (resting.any() and np.isfinite(matrix).all()):
        return np.array([], int), 0.0
    exponents, modes = np.linalg.eig(matrix)
    growing = exponents.real * problem.end_time > 1.0
    sizes = np.abs(modes[:, growing]).reshape(len(problem.model.rates), resting.sum(), -1)
    sizes = sizes.max(axis=0)  # (site, mode)
    present = (sizes > PRESENT * sizes.max(axis=0)).any(axis=1)
    sites = np.array(problem.site_numbers)[resting][present]
    return sites, float(exponents.real.max())


def describe_unstable_rest(problem: Problem, moduli: np.ndarray) -> str:
    """Return a warning about sites that stay at rest at an unstable point; "" if there are none.

    `moduli` (component, site, snapshot) are the snapshots of a run; they are constant at rest. The
    test skips equations that depend on time, models with a coupling matrix, and chains with more
    than MOST_UNKNOWNS unknowns.
    """
    unknowns = len(problem.model.rates) * problem.sites
    is_constant = (moduli == moduli[:, :, :1]).all(axis=(0, 2))
    if (
        problem.model.driven
        or problem.model.matrices
        or unknowns > MOST_UNKNOWNS
        or not is_constant.any()
    ):
        return ""
    unstable, rate = growth_at_rest(problem, is_constant)
    if not unstable.size:
        return ""
    more = unstable.size - MOST_NAMED
    names = ", ".join(map(str, unstable[:MOST_NAMED])) + (f" and {more} more" if more > 0 else "")
    subject = f"sites {names} rest" if unstable.size > 1 else f"site {names} rests"
    way_out = "give such sites initial values"
    if problem.model.farthest == 0:
        way_out += ", or omit them with half_width: 0, because the equations have no coupling"
    return (
        f"{subject} at an unstable point, where a perturbation grows at the rate {rate:.4g}; the "
        f"Lyapunov exponent may be that of these sites and not of the motion: {way_out}"
    )
