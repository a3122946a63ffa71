"""Growth and spreading of a small A + B on the chaotic chain with A = -B.

To first order in S = (A + B) / sqrt 2, D = (A - B) / sqrt 2 does not depend on S, and S obeys a
linear equation with D in its coefficients. At a site that moves at a velocity v, |S| grows as
exp(lambda(v) tau). Without noise S spreads at the velocity v_2 at which lambda vanishes, as errors
do in chaotic media (Cencini and Torcini, Phys. Rev. E 63 (2001) 056201), or with the first front
if lambda is positive up to its speed.

Noise of size sigma |D| starts the growth of S at every site that the first front has passed. S then
grows at all velocities. At d sites behind the front, which has the speed v_1, it has grown by
exp(kappa d), where kappa is the largest lambda(v) / (v_1 - v). If kappa > 0, S is of order one at
ln(1 / sigma) / kappa sites behind the first front, and the second front follows the first.

The equations are those of `sums`, with S so small that its squares are lost in rounding errors.
"""

from collections.abc import Mapping
from functools import partial
from typing import Any

import numpy as np
import xarray as xr
from latticode.measures.confidence import mean_limits
from latticode.measures.spreading import lay_line
from latticode.numerics.elementary import log
from latticode.simulation.active_sites import integrate_intervals
from latticode.simulation.runs import ManyRuns

from pendula.problem import PaperProblem
from pendula.varied import Estimate, NamedNumber, as_dataset, vary_several

from .bulk import SLICE_LENGTH
from .front import linear_front
from .long_runs import members_of
from .sums import in_sums

SMALL, LEAST = 1e-20, 1e-300
"""After each interval |S| is scaled down to SMALL; values below LEAST have too few digits."""

VELOCITIES = 64
"""Number of intervals of velocity from 0 to the speed of the first front."""

NEAR, LATE, SHORTER = (8, 16), (0.5, 0.25), (1.0, 0.5)
"""Number of sites to each side over which the largest |S| is taken, because |S| has zeros; fraction
of a run, at its end, over which growth is fitted; fraction of the run that is used. The second
value of each is a variation."""


def solve_transverse(
    problems: list[PaperProblem],
    rest_threshold: float,
    members: int,
    perturbations: list[float],
    tolerances: list[float],
    seed: int,
) -> ManyRuns:
    """Return the runs for predicted speeds of the second front, exponents, and kappa.

    The printed numbers have the first perturbation and tolerance; the others give variations.
    """
    settings = [(tolerances[0], perturbation) for perturbation in perturbations]
    settings += [(tolerance, perturbations[0]) for tolerance in tolerances[1:]]
    runs = []
    for tolerance, perturbation in settings:
        solver = {"name": "dop853", "rtol": tolerance, "atol": tolerance}
        repeated = [problem.changed(solver=solver) for problem in problems]
        runs += members_of(repeated, members, perturbation, seed)

    def conclude(retained: dict[str, np.ndarray]) -> xr.Dataset:
        exponents = retained["exponents"].reshape(len(settings), len(problems), members, -1)
        by_setting = dict(zip(settings, exponents, strict=True))
        return as_numbers(problems, by_setting, tolerances, perturbations)

    return ManyRuns(runs, partial(exponents_of, rest_threshold=rest_threshold), conclude)


def as_numbers(
    problems: list[PaperProblem],
    by_setting: Mapping[tuple[float, float], np.ndarray],
    tolerances: list[float],
    perturbations: list[float],
) -> xr.Dataset:
    """Return the dataset of MEANINGS.

    `by_setting` maps (tolerance, perturbation) to exponents (omega, member, ...).
    """

    def measure(tolerance: float, perturbation: float, **choices: Any) -> dict[str, Estimate]:
        shape = (len(problems), -1, *map(len, CHOICES.values()), VELOCITIES)
        exponents = by_setting[tolerance, perturbation].reshape(shape)
        place = tuple(CHOICES[name].index(value) for name, value in choices.items())
        spans = [
            choices["part of the run"] * choices["part fitted"] * problem.end_time
            for problem in problems
        ]
        return numbers_of(problems, exponents[:, :, *place, :], 1.0 / np.array(spans))

    choices = {"tolerance": tolerances, "perturbation": perturbations, **CHOICES}
    varied = vary_several(measure, choices)
    printed = {name: NamedNumber(("omega",), varied[name], MEANINGS[name]) for name in MEANINGS}
    omegas = ("omega", [problem.constants.omega for problem in problems], {"long_name": "detuning"})
    title = "Growth of a small A + B on the infinite chain with A = -B"
    return as_dataset(printed, {"omega": omegas}).assign_attrs(title=title)


CHOICES = {"part of the run": SHORTER, "part fitted": LATE, "sites near": NEAR}
MEANINGS = {
    "predicted_second_speed": "predicted speed of the second front, in sites per unit of tau",
    "exponent_at_rest": "exponent of |A + B| at a fixed site of the chain with A = -B",
    "growth_behind_front": "kappa, the growth of |A + B| per site behind the first front",
}


def exponents_of(problem: PaperProblem, rest_threshold: float) -> dict[str, np.ndarray]:
    """Return the exponents of a small |S| at each velocity and for all CHOICES, as a flat array.

    An exponent is NaN if |S| falls below LEAST.
    """
    start, speed = in_sums(problem), linear_front(problem.constants).speed
    d = start.initial[1]
    start = start.changed(initial=np.array([SMALL * d, d]))
    grown, tau, logs = 0.0, [], []
    for times, _, state, sites in integrate_intervals(start, rest_threshold, SLICE_LENGTH):
        sizes = np.abs(sites[:2]).max(axis=0)  # squares would underflow
        places = (velocities() * speed * times[-1]).astype(int)
        logs.append([_log_near(sizes, places, near) + grown for near in NEAR])
        largest = sizes.max()
        state[:2] *= SMALL / largest
        grown += float(log(largest / SMALL))
        tau.append(times[-1])
    return {"exponents": _slopes(np.array(tau), np.array(logs)).ravel()}


def velocities() -> np.ndarray:
    """Return the velocities of the exponents, relative to the speed of the first front."""
    return np.arange(VELOCITIES) / VELOCITIES


def _log_near(sizes: np.ndarray, places: np.ndarray, near: int) -> np.ndarray:
    """Return the logarithm of the largest |S| near each place, NaN below LEAST."""
    nearby = np.array([sizes[max(0, at - near) : at + near + 1].max(initial=0.0) for at in places])
    return np.where(nearby > LEAST, log(np.maximum(nearby, LEAST)), np.nan)


def _slopes(tau: np.ndarray, logs: np.ndarray) -> np.ndarray:
    """Return the slopes of `logs` (time, near, velocity), (SHORTER, LATE, near, velocity)."""
    return np.array(
        [
            [_slopes_within(tau, logs, fraction * tau[-1], late) for late in LATE]
            for fraction in SHORTER
        ]
    )


def _slopes_within(tau: np.ndarray, logs: np.ndarray, end: float, late: float) -> np.ndarray:
    """Return the slopes over the last fraction `late` of the time to `end`, (near, velocity)."""
    is_fitted = (tau > (1.0 - late) * end) & (tau <= end)
    curves = logs[is_fitted].reshape(is_fitted.sum(), -1).T
    return np.array([lay_line(tau[is_fitted], curve).slope for curve in curves]).reshape(
        logs.shape[1:]
    )


# --- Numbers of exponents -------------------------------------------------------------------------


def numbers_of(
    problems: list[PaperProblem], exponents: np.ndarray, least: np.ndarray
) -> dict[str, Estimate]:
    """Return the numbers of MEANINGS with their errors, from exponents (omega, member, velocity).

    Errors are half of the 95 % confidence interval of the mean over the members. If no exponent is
    above `least` (omega,), |S| grew by less than a factor of e. Such growth may be a power of tau,
    so no second front is predicted.
    """
    fronts = np.array([linear_front(problem.constants).speed for problem in problems])
    means = exponents.mean(axis=1)
    grows = np.nanmax(means, axis=1) > least
    second = np.array(
        [[crossing_of(spectrum) for spectrum in of_members] for of_members in exponents]
    )
    behind = np.array(
        [[largest_ratio(spectrum) for spectrum in of_members] for of_members in exponents]
    )
    crossing = np.array([crossing_of(spectrum) for spectrum in means])
    kappa = np.array([largest_ratio(spectrum) for spectrum in means])
    return {
        "predicted_second_speed": (
            np.where(grows, crossing * fronts, np.nan),
            mean_limits(second.T).half * fronts,
        ),
        "exponent_at_rest": (means[:, 0], mean_limits(exponents[:, :, 0].T).half),
        "growth_behind_front": (kappa / fronts, mean_limits(behind.T).half / fronts),
    }


def crossing_of(exponents: np.ndarray) -> float:
    """Return the relative velocity above which exponents (velocity,) are negative.

    The velocity is interpolated. It is 1 if the last exponent is positive, and 0 if no exponent is.
    NaN counts as negative.
    """
    positive = np.flatnonzero(exponents > 0.0)
    if not positive.size:
        return 0.0
    last = positive[-1]
    if last == exponents.size - 1:
        return 1.0
    high, low = exponents[last], exponents[last + 1]
    fraction = high / (high - low) if np.isfinite(low) else 0.5
    return float((last + fraction) / VELOCITIES)


def largest_ratio(exponents: np.ndarray) -> float:
    """Return the largest exponent / (1 - velocity), with velocities relative to the front's."""
    return float(np.nanmax(exponents / (1.0 - velocities())))
