"""Lemma 1: thresholds (12), windows of stability, and how fast tiny data grow under (4).

Rates are per unit of tau. A mode of curvature lambda has kappa = epsilon lambda - Omega; on the
infinite chain lambda covers [0, 4], on N sites it takes N values of its own.
"""

from itertools import product

import numpy as np
from latticode.datasets.checks import columns, table, tabulate, variable
from latticode.numerics.elementary import log

from pendula.models.linear_chain import (
    finite_rate,
    finite_threshold,
    gamma_0,
    infinite_rate,
    stable_windows,
    widest_gamma,
)
from pendula.problem import Constants

from .equations import random_amplitudes, run_powers

TINY = 1e-130
"""Norm of the initial data: e^{2 gamma tau} must not make it matter for the cubic terms."""
CURVE_POINTS = 1601  # resolves the teeth of the finite chain's threshold

ABOUT = {
    "measured": "growth rate of tiny data, per unit of tau",
    "finite_rate": "largest rate of the finite chain, per unit of tau",
    "infinite_rate": "largest rate of the infinite chain, per unit of tau",
    "infinite_threshold": "gamma_0 of (12)",
    "finite_threshold": "threshold of N sites",
    "infinite_curve": "gamma_0 of (12), finely",
    "finite_curve": "threshold of N sites, finely",
    "resolution": "growth that a bounded beat can feign, per unit of tau",
}


def measured_slopes(cells, boundary: str, data: np.ndarray, end_time: float) -> np.ndarray:
    """Return the growth rates of TINY * data over the second half of nonlinear runs, by cell."""
    count, tolerances = len(cells), {"rtol": 1e-9, "atol": 1e-9 * TINY}
    starts = [TINY * data] * count
    powers, _ = run_powers(cells, [boundary] * count, starts, end_time, 2, tolerances)
    return log(powers[:, 2] / powers[:, 1]) / end_time


def resolution(end_time):
    """Return what a bounded beat can add to the rate over the second half of a run.

    Over half the time it changes log l2 by a few units.
    """
    return 6.0 / np.asarray(end_time)


def check_chart(omegas, gammas, epsilon, sites, boundary, end_time, seed, foldings=np.inf) -> dict:
    """Measure growth rates on a grid of (Omega, gamma) and set them beside the predictions.

    From random data of norm 1e-130 the nonlinear equations run to `end_time`; the rate is the
    slope of log l2 over the second half, which tends to the finite chain's largest rate as modes
    separate. On a short chain a mode that grows alone leaves nothing but rounding on its nodes,
    where a solver with relative tolerances gets lost: there `foldings` must end the run before.
    """
    omegas, gammas = np.asarray(omegas, float), np.asarray(gammas, float)
    data = random_amplitudes(np.random.default_rng(seed), sites, 1.0)
    # until a mode can outgrow another, at 2 |gamma|, by e^foldings
    times = np.minimum(end_time, foldings / np.maximum(2.0 * np.abs(gammas), 1e-300))
    measured = np.empty((len(omegas), len(gammas)))
    for j, (gamma, end) in enumerate(zip(gammas, times, strict=True)):
        cells = [Constants(epsilon=epsilon, gamma=gamma, omega=omega) for omega in omegas]
        measured[:, j] = measured_slopes(cells, boundary, data, end)
    chain, grid = (epsilon, sites, boundary), (omegas[:, None], gammas[None, :])
    fine = np.linspace(omegas[0], omegas[-1], CURVE_POINTS)
    rates = {
        "measured": measured,
        "finite_rate": finite_rate(*grid, *chain),
        "infinite_rate": infinite_rate(*grid, epsilon),
    }
    thresholds = {
        "infinite_threshold": gamma_0(omegas, epsilon),
        "finite_threshold": finite_threshold(omegas, *chain),
    }
    curves = {
        "infinite_curve": gamma_0(fine, epsilon),
        "finite_curve": finite_threshold(fine, *chain),
    }
    return table(
        f"Growth rates on {sites} sites, {boundary} ends, measured and predicted",
        {"omega": omegas, "gamma": gammas, "curve_omega": fine},
        sites=variable(sites, (), "number of sites N"),
        **columns(("omega", "gamma"), ABOUT, rates),
        **columns(("omega",), ABOUT, thresholds),
        **columns(("curve_omega",), ABOUT, curves),
        **columns(("gamma",), ABOUT, {"resolution": resolution(times)}),
    )


def check_windows(epsilon: float, boundary: str, half_widths, gammas) -> dict:
    """Tabulate the windows of stability that finite chains keep inside [0, 4 epsilon].

    Lemma 1 says that the infinite chain has none for gamma not zero; the share of the band that
    is stable on 2M + 1 sites falls as M grows.
    """
    rows = []
    for half_width, gamma in product(half_widths, gammas):
        windows = stable_windows(gamma, epsilon, 2 * half_width + 1, boundary)
        share = np.sum(windows[:, 1] - windows[:, 0]) / (4.0 * epsilon)
        rows.append({"count": len(windows), "share": share})
    largest = [widest_gamma(epsilon, 2 * m + 1, boundary) for m in half_widths]
    about = {
        "count": "number of windows of stability",
        "share": "share of [0, 4 epsilon] that is stable",
    }
    title = "Windows of stability of finite chains inside [0, 4 epsilon]"
    closing = variable(largest, ("half_width",), "drive at which the last window closes")
    coords = {"half_width": half_widths, "gamma": gammas}
    return tabulate(title, coords, rows, about, largest_gamma=closing)


def check_measured_windows(
    gamma: float, epsilon: float, sites: int, boundary: str, end_time: float, seed: int
) -> dict:
    """Run tiny data in the middle of each window of stability in [0, 4 epsilon] and between them.

    In the middle of a window l2 must stay within the factor that the exact flow allows, between
    two windows it must grow at about 2 |gamma|.
    """
    windows = stable_windows(gamma, epsilon, sites, boundary)
    edges = windows.ravel()[1:-1].reshape(-1, 2)
    omegas = np.sort(np.concatenate([windows.mean(axis=1), edges.mean(axis=1)]))
    data = random_amplitudes(np.random.default_rng(seed), sites, 1.0)
    cells = [Constants(epsilon=epsilon, gamma=gamma, omega=omega) for omega in omegas]
    measured = measured_slopes(cells, boundary, data, end_time)
    finite = finite_rate(omegas, gamma, epsilon, sites, boundary)
    return table(
        f"Growth inside and between the windows of stability of {sites} sites",
        {"omega": omegas},
        **columns(("omega",), ABOUT, {"measured": measured, "finite_rate": finite}),
        **columns((), ABOUT, {"resolution": resolution(end_time)}),
    )
