"""Perturbed breathers in the nonlinear flow: how fast they leave, or that they stay for long.

The flow is that of the solvers, and independent of the perturbations in `multipliers`. Two runs,
one from a breather and one from a slightly changed one, differ by d_k after k periods T. After a
while d_k has only a growing multiplier mu and its inverse, or two conjugate ones, so that
d_{k+1} = s d_k - p d_{k-1} with the sum s and the product p of two multipliers (the method of
Prony). Stable breathers are changed by more, and integrated for thousands of periods. Since the
phase drifts, the range of P on the central pair is compared, which oscillates within each period.
"""

import numpy as np

from pendula.numerics.elementary import log
from pendula.simulation.simulate import simulate

from .multipliers import growth
from .periodic import Breather, problem_from, unfolded

DECIMALS = 9
"""Of the data of runs: LAPACK finds breathers, and their last bits differ between processors."""
SMALLEST, LARGEST = 1e-8, 1e-4
"""Of the difference of two runs, relative to the breather, while its growth is measured."""
TOLERANCE = 1e-14
"""Of the runs whose difference is measured."""
SAMPLES = 400
"""Samples of each tenth of a long run: several in each period of a beat."""


def run_from(
    breather: Breather, change: float, end_time: float, step: float, tolerance: float,
    parity: str = "even",
):  # fmt: skip
    """Return moduli (component, site, time) from data whose central A is larger by `change`.

    An odd change is one of the two sites beside the centre, of opposite signs.
    """
    data, sizes = unfolded(np.round(breather.data, DECIMALS)), np.array([change, -0.7 * change])
    centre = data.shape[1] // 2
    if parity == "even":
        data[:, centre] *= 1.0 + sizes
    else:
        data[:, centre + 1] *= 1.0 + sizes
        data[:, centre - 1] *= 1.0 - sizes
    problem = problem_from(breather.constants, data, end_time, step, tolerance)
    return simulate(problem.changed(snapshot_every=1)).modulus


def measured_growth(breather: Breather, trace: complex, parity: str = "even") -> float:
    """Return the rate of growth in the flow of the perturbation of one parity that grows fastest.

    `trace` is its nu of `multipliers`: the expected rate sets the length of the runs, and
    a real nu means one growing multiplier, a complex one two.
    """
    period = 4.0 * breather.quarter
    rate = growth(breather.frequency, np.array([trace]))
    periods = int(np.ceil(log(LARGEST / SMALLEST) / (rate * period))) + 2
    given = periods * period, period, TOLERANCE, parity
    changed = run_from(breather, SMALLEST, *given)
    centre = changed.shape[1] // 2
    if parity == "even":
        parted = (changed - run_from(breather, 0.0, *given))[:, centre : centre + 2]
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


def range_of_power(
    breather: Breather, change: float, end_time: float, tolerance: float
) -> tuple[np.ndarray, np.ndarray]:
    """Return the least and the largest P on the central pair in the first and the last tenth.

    The run is a long one from a changed breather; both results are (span,).
    """
    moduli = run_from(breather, change, end_time, end_time / (10 * SAMPLES), tolerance)
    centre = (moduli[:, moduli.shape[1] // 2] ** 2).sum(axis=0)
    spans = np.stack([centre[:SAMPLES], centre[-SAMPLES:]])
    return spans.min(axis=1), spans.max(axis=1)
