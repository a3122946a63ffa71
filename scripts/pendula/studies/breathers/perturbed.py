"""Perturbed breathers in the nonlinear flow: how fast they leave.

The flow is that of the solvers, and independent of the perturbations in `multipliers`. Two runs,
one from a breather and one from a slightly changed one, differ by d_k after k periods T. After a
while d_k has only a growing multiplier mu and its inverse, or two conjugate ones, so that
d_{k+1} = s d_k - p d_{k-1} with the sum s and the product p of two multipliers (the method of
Prony).
"""

import numpy as np

from pendula.numerics.elementary import log
from pendula.simulation.simulate import simulate

from .multipliers import growth
from .periodic import DECIMALS, Breather, problem_from, unfolded

SMALLEST, LARGEST = 1e-8, 1e-4
"""Of the difference of two runs, relative to the breather, while its growth is measured."""
TOLERANCE = 1e-14
"""Of the runs whose difference is measured."""


def run_from(breather: Breather, change: float, periods: int, parity: str) -> np.ndarray:
    """Return moduli (component, site, period) from data whose central A is larger by `change`.

    An odd change is one of the two sites beside the centre, of opposite signs.
    """
    data, sizes = unfolded(np.round(breather.data, DECIMALS)), np.array([change, -0.7 * change])
    centre = data.shape[1] // 2
    if parity == "even":
        data[:, centre] *= 1.0 + sizes
    else:
        data[:, centre + 1] *= 1.0 + sizes
        data[:, centre - 1] *= 1.0 - sizes
    period = 4.0 * breather.quarter
    problem = problem_from(breather.constants, data, periods * period, period, TOLERANCE)
    return simulate(problem.changed(snapshot_every=1)).modulus


def measured_growth(breather: Breather, trace: complex, parity: str) -> float:
    """Return the rate of growth in the flow of the perturbation of one parity that grows fastest.

    `trace` is its nu of `multipliers`: the expected rate sets the length of the runs, and
    a real nu means one growing multiplier, a complex one two.
    """
    period = 4.0 * breather.quarter
    rate = growth(breather.frequency, np.array([trace]))
    periods = int(np.ceil(log(LARGEST / SMALLEST) / (rate * period))) + 2
    changed = run_from(breather, SMALLEST, periods, parity)
    centre = changed.shape[1] // 2
    if parity == "even":
        parted = (changed - run_from(breather, 0.0, periods, parity))[:, centre : centre + 2]
    else:  # a run without a change stays even: the mirror image stands for it
        parted = changed[:, centre + 1 : centre + 3] - changed[:, centre - 2 : centre][:, ::-1]
    parted = parted.reshape(-1, periods + 1)  # (component and site, period)
    before, here, after = (parted[:, (periods + 1) // 2 :][:, k : k - 2 or None] for k in range(3))
    if not trace.imag:
        return float(log(np.sum(after * here) / np.sum(here * here))) / period
    # the smallest sum of squares of after - s here + p before
    squares = [[np.sum(one * two) for two in (here, before)] for one in (here, before)]
    sums = [np.sum(one * after) for one in (here, before)]
    determinant = squares[0][0] * squares[1][1] - squares[0][1] * squares[1][0]
    product = -(squares[0][0] * sums[1] - squares[1][0] * sums[0]) / determinant
    return float(log(product)) / (2.0 * period)
