"""Checks of Lemma 1: instability of the chain at rest, and growth of tiny data under (4)."""

import numpy as np
from latticode.datasets.checks import columns, table, variable
from latticode.numerics.elementary import log
from replication.variables import FEW_CHOICES

from pendula.models.linear_chain import (
    curvatures,
    finite_rate,
    finite_threshold,
    gamma_0,
    growth_rate,
    modes,
)
from pendula.problem import Constants

from .equations import ENDS, constants_at, controls_of, random_amplitudes, run, squared_norm

TINY = 1e-130
"""Norm of the initial data: even after growth by e^{2 gamma tau}, cubic terms are negligible."""
SOLVER = {"name": "taylor", "rtol": 1e-9, "atol": 1e-9 * TINY}
OMEGAS, GAMMAS, SITES = np.linspace(-6.0, 10.0, 33), np.linspace(0.0, 3.0, 13), 21
END_TIME, LONG, SEED = 40.0, 100.0, 5
CURVE = np.linspace(-6.0, 10.0, 1601)  # resolves the spikes of the finite chain's threshold


def late_growth(constants: Constants, data: np.ndarray, end_time: float) -> float:
    """Return the growth of log l2 over the second half of a run from TINY * `data`."""
    powers = squared_norm(run(constants, ENDS, TINY * data, end_time, 2, solver=SOLVER).l2)
    return 0.5 * float(log(powers[2] / powers[1]))


def check_chart() -> dict:
    """Return measured and predicted growth rates on a grid of (Omega, gamma).

    Runs start from tiny random data. The slope of log l2 over their second half tends to the
    largest rate of the finite chain, because the fastest mode outgrows all others.
    """
    data, half = random_amplitudes(SEED, SITES), 0.5 * END_TIME
    measured = [
        [late_growth(constants_at(omega, gamma), data, END_TIME) / half for gamma in GAMMAS]
        for omega in OMEGAS
    ]
    chain, grid = (1.0, SITES, ENDS), ("omega", "gamma")
    rates = finite_rate(OMEGAS[:, None], GAMMAS, *chain)
    curves = {
        "infinite_curve": gamma_0(CURVE, 1.0),
        "finite_curve": finite_threshold(CURVE, *chain),
    }
    labels = {"infinite_curve": "gamma_0 of (12)", "finite_curve": "threshold of N sites"}
    chart = table(
        f"Growth rates on {SITES} sites, {ENDS} ends, measured and predicted",
        {"omega": OMEGAS, "gamma": GAMMAS, "curve_omega": CURVE},
        sites=variable(SITES, (), "number of sites N"),
        measured=variable(measured, grid, "growth rate of tiny data, per unit of tau"),
        finite_rate=variable(rates, grid, "largest rate of N sites, per unit of tau"),
        gamma_0=variable(gamma_0(OMEGAS, 1.0), ("omega",), "gamma_0 of (12)"),
        **columns(("curve_omega",), labels, curves),
    )
    chart["attrs"] |= {**controls_of(SOLVER), "end_time": END_TIME, "seed": SEED}
    return chart


def edge_wave(omega: float, sites: int) -> np.ndarray:
    """Return the wave A = -B nearest to the edge of the band, at the phase of its least P.

    A is real if Omega is below the band, where kappa > 0, and imaginary above the band.
    """
    shape = modes(sites, ENDS)[0] if omega < 0.0 else 1j * modes(sites, ENDS)[-1]
    return np.stack([shape, -shape]).astype(complex)


def check_threshold() -> dict:
    """Return thresholds of finite chains minus gamma_0, and the growth at and above a threshold.

    The threshold of a finite chain exceeds gamma_0 by an amount of order 1 / N^2. At this threshold
    the wave at the edge of the band must grow in proportion to tau, by (14) as 4 gamma tau.
    """
    rows, sizes, omegas = [], (SITES, 81, 601), np.array([-4.0, 8.0])
    thresholds = np.transpose([finite_threshold(omegas, 1.0, n, ENDS) for n in sizes])
    for omega, threshold in zip(omegas, thresholds[:, 0], strict=True):
        wave, above = edge_wave(omega, SITES), threshold + 0.2
        grown = [
            late_growth(constants_at(omega, gamma), wave, LONG) for gamma in (threshold, above)
        ]
        fastest = np.argmax(growth_rate(curvatures(SITES, ENDS) - omega, above))
        rows.append([*(np.array(grown) / log(2.0)), np.pi * (fastest + 1) / (SITES + 1)])
    labels = {
        "wave_exponent": "exponent of tau in l2 of a wave at the threshold of its chain",
        "exponent_above": "the same exponent above the threshold",
        "leading_wave": "wave number of the fastest growth above the threshold",
    }
    excess = thresholds - gamma_0(omegas, 1.0)[:, None]
    data = table(
        "Growth of tiny data at the threshold of Lemma 1 and above it",
        {"omega": omegas, "sites": list(sizes)},
        excess=variable(excess, ("omega", "sites"), "threshold of N sites minus gamma_0"),
        **columns(("omega",), labels, dict(zip(labels, np.transpose(rows), strict=True))),
    )
    data["coords"]["omega"]["attrs"] |= FEW_CHOICES
    data["attrs"] |= {**controls_of(SOLVER), "end_time": LONG}
    return data
