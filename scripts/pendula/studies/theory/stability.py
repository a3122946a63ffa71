"""Lemma 1: where the chain at rest is unstable, and how tiny data grow there under (4)."""

import numpy as np
from latticode.datasets.checks import columns, table, variable
from latticode.numerics.elementary import log, modulus
from latticode.numerics.matrices import times as multiplied

from pendula.models.linear_chain import finite_rate, finite_threshold, gamma_0, modes
from pendula.problem import Constants

from .equations import ENDS, constants_at, one_pair, random_amplitudes, run, squared_norm

TINY = 1e-130
"""Norm of the initial data: e^{2 gamma tau} must not make it matter for the cubic terms."""
SOLVER = {"name": "taylor", "rtol": 1e-9, "atol": 1e-9 * TINY}
CURVE_POINTS = 1601  # resolves the teeth of the finite chain's threshold


def late_growth(constants: Constants, data: np.ndarray, end_time: float) -> float:
    """Return by what log l2 grows over the second half of a run from TINY * `data`."""
    powers = squared_norm(run(constants, ENDS, TINY * data, end_time, 2, solver=SOLVER).l2)
    return 0.5 * float(log(powers[2] / powers[1]))


def check_chart(omegas, gammas, sites: int, end_time: float, seed: int) -> dict:
    """Measure growth rates on a grid of (Omega, gamma) and set them beside the predictions.

    The equations run from tiny random data to `end_time`; the slope of log l2 over the second half
    tends to the finite chain's largest rate as modes separate.
    """
    data, half = random_amplitudes(seed, sites), 0.5 * end_time
    measured = [
        [late_growth(constants_at(omega, gamma), data, end_time) / half for gamma in gammas]
        for omega in omegas
    ]
    chain, fine = (1.0, sites, ENDS), np.linspace(omegas[0], omegas[-1], CURVE_POINTS)
    rates, grid = finite_rate(omegas[:, None], gammas, *chain), ("omega", "gamma")
    curves = {"infinite_curve": gamma_0(fine, 1.0), "finite_curve": finite_threshold(fine, *chain)}
    about = {"infinite_curve": "gamma_0 of (12)", "finite_curve": "threshold of N sites"}
    return table(
        f"Growth rates on {sites} sites, {ENDS} ends, measured and predicted",
        {"omega": omegas, "gamma": gammas, "curve_omega": fine},
        sites=variable(sites, (), "number of sites N"),
        measured=variable(measured, grid, "growth rate of tiny data, per unit of tau"),
        finite_rate=variable(rates, grid, "largest rate of N sites, per unit of tau"),
        gamma_0=variable(gamma_0(omegas, 1.0), ("omega",), "gamma_0 of (12)"),
        **columns(("curve_omega",), about, curves),
    )


def edge_wave(omega: float, sites: int) -> np.ndarray:
    """Return A = -B in the wave nearest to the edge of the band, where its P is least in a period.

    D = A - B is real if kappa > 0, for Omega below the band, and else imaginary.
    """
    shape = modes(sites, ENDS)[0] if omega < 0.0 else 1j * modes(sites, ENDS)[-1]
    return np.stack([shape, -shape]).astype(complex)


def leading_wave(constants: Constants, sites: int, end_time: float, seed: int) -> float:
    """Return the wave number that leads the growth of tiny random data of A - B."""
    data = TINY * random_amplitudes(seed, sites)
    final = run(constants, ENDS, data, end_time, solver=SOLVER).final
    parts = modulus(multiplied(modes(sites, ENDS), final[0] - final[1]))
    return np.pi * (int(np.argmax(parts)) + 1) / (sites + 1)


def check_threshold(sizes, above: float, end_time: float, seed: int) -> dict:
    """Measure near gamma_0 and at it what Lemma 1 and its proof say, on chains of `sizes`.

    The shortest chain has its own threshold, above gamma_0 by a square of 1 / N. There the wave at
    the edge of the band must grow as tau: by (14) as 4 gamma tau. The longest is so long that
    one pair at gamma_0 spreads on it as on the infinite one, where D = A - B obeys a wave equation:
    its l2 norm must grow as tau^(1/2).
    """
    rows, short, long, omegas = [], sizes[0], sizes[-1], np.array([-4.0, 8.0])
    thresholds = np.transpose([finite_threshold(omegas, 1.0, n, ENDS) for n in sizes])
    for omega, own in zip(omegas, thresholds[:, 0], strict=True):
        wave, pair = edge_wave(omega, short), one_pair(long, (1 + 1j, -1 - 1j))
        runs = (own, wave), (gamma_0(omega, 1.0), pair), (own + above, wave)
        grown = [late_growth(constants_at(omega, gamma), z, end_time) for gamma, z in runs]
        leads = leading_wave(constants_at(omega, own + above), short, end_time, seed)
        rows.append([*(np.array(grown) / log(2.0)), leads])
    about = {
        "wave_exponent": "exponent of tau in l2 of a wave at the threshold of its chain",
        "pair_exponent": "exponent of tau in l2 of one pair at gamma_0",
        "exponent_above": "the same of the wave above the threshold",
        "leading_wave": "wave number that leads the growth above the threshold",
    }
    excess = thresholds - gamma_0(omegas, 1.0)[:, None]
    return table(
        "Growth of tiny data at the threshold of Lemma 1 and above it",
        {"omega": omegas, "sites": sizes},
        excess=variable(excess, ("omega", "sites"), "threshold of N sites minus gamma_0"),
        **columns(("omega",), about, dict(zip(about, np.transpose(rows), strict=True))),
    )
