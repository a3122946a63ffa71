"""The second front if noise starts the growth of A + B behind the first front.

Noise of size sigma |D| is added to S, with new draws for every site and every stored state. Runs in
the unknowns A and B have their own rounding errors as noise, about 1e-16 |D|.
"""

from functools import partial
from typing import Any

import numpy as np
import xarray as xr
from latticode.measures.confidence import mean_limits
from latticode.measures.spreading import lay_line
from latticode.numerics.draws import normal
from latticode.simulation.active_sites import integrate_intervals
from latticode.simulation.runs import ManyRuns

from pendula.problem import PaperProblem
from pendula.varied import Estimate, NamedNumber, as_dataset, vary_several

from .bulk import LEVEL, SLICE_LENGTH, find_front, site_powers
from .long_runs import members_of
from .sums import in_sums, turned

ROUNDING = "A and B in doubles"
"""In place of a size of noise: a run in the unknowns A and B, with rounding errors as noise."""

LEVELS, LATE, SHORTER = (LEVEL, 1.0), (0.5, 0.25), (1.0, 0.5)
"""Least |S|^2 behind the second front; fraction of a run, at its end, over which the front is
fitted; fraction of the run that is used. The second value of each is a variation."""
CHOICES = {"part of the run": SHORTER, "part fitted": LATE, "level": LEVELS}
MEANINGS = {
    "noisy_second_speed": "speed of the second front with noise, in sites per unit of tau",
    "distance": "mean distance of the second front with noise from the first, in sites",
}


def follow_noise(
    problems: list[PaperProblem],
    rest_threshold: float,
    noises: list[float],
    members: int,
    perturbation: float,
    tolerances: list[float],
    seed: int,
) -> ManyRuns:
    """Return the runs for the speed of the second front and its distance from the first.

    Both are (noise, omega), and the last noise is ROUNDING. The printed numbers have the first
    tolerance; the others give variations.
    """
    runs = []
    for tolerance in tolerances:
        solver = {"name": "dop853", "rtol": tolerance, "atol": tolerance}
        repeated = [problem.changed(solver=solver) for problem in problems]
        runs += members_of(repeated, members, perturbation, seed)
    sizes = [*noises, ROUNDING]
    shape = (len(tolerances), len(problems), members, len(sizes), len(MEANINGS))

    def conclude(retained: dict[str, np.ndarray]) -> xr.Dataset:
        numbers = retained["numbers"].reshape(*shape, *map(len, CHOICES.values()))
        return _numbers_by_noise(problems, noises, tolerances, numbers)

    retain = partial(follow_front, noises=sizes, rest_threshold=rest_threshold, seed=seed)
    return ManyRuns(runs, retain, conclude)


def _numbers_by_noise(
    problems: list[PaperProblem], noises: list[float], tolerances: list[float], numbers: np.ndarray
) -> xr.Dataset:
    """Return the dataset of `numbers` (tolerance, problem, member, noise, number, ...)."""

    def measure(tolerance: float, **choices: Any) -> dict[str, Estimate]:
        place = tuple(CHOICES[name].index(value) for name, value in choices.items())
        of_choices = numbers[tolerances.index(tolerance)][
            (..., *place)
        ]  # (omega, member, noise, number)
        limits = mean_limits(np.moveaxis(of_choices, (1, 3, 2), (0, 1, 2)))
        return {name: (limits.value[n], limits.half[n]) for n, name in enumerate(MEANINGS)}

    varied = vary_several(measure, {"tolerance": tolerances, **CHOICES})
    along = ("noise", "omega")
    printed = {name: NamedNumber(along, varied[name], MEANINGS[name]) for name in MEANINGS}
    labels = np.array([f"{noise:g}" for noise in noises] + [ROUNDING], object)
    coordinates = {
        "noise": ("noise", labels, {"long_name": "noise added to A + B, relative to |A - B|"}),
        "omega": (
            "omega",
            [problem.constants.omega for problem in problems],
            {"long_name": "detuning"},
        ),
    }
    title = "The second front on infinite chains with noise in A + B"
    ends = (
        [problem.end_time for problem in problems],
        {"long_name": "end time of the runs with noise"},
    )
    data = as_dataset(printed, coordinates).assign(noise_end_time=("omega", *ends))
    return data.assign_attrs(title=title)


def follow_front(
    problem: PaperProblem, noises: list[float | str], rest_threshold: float, seed: int
) -> dict[str, np.ndarray]:
    """Return the numbers of MEANINGS for each noise under all CHOICES, (noise, number, ...)."""
    return {
        "numbers": np.array([_numbers_of(problem, noise, rest_threshold, seed) for noise in noises])
    }


def _numbers_of(
    problem: PaperProblem, noise: float | str, rest_threshold: float, seed: int
) -> np.ndarray:
    tau, fronts, seconds = places_of(problem, noise, rest_threshold, seed)
    numbers = np.empty((len(MEANINGS), len(SHORTER), len(LATE), len(LEVELS)))
    for i, fraction in enumerate(SHORTER):
        for j, late in enumerate(LATE):
            is_fitted = (tau > (1.0 - late) * fraction * tau[-1]) & (tau <= fraction * tau[-1])
            for k, second in enumerate(seconds.T[:, is_fitted]):
                slope = lay_line(tau[is_fitted], second).slope
                numbers[:, i, j, k] = slope, (fronts[is_fitted] - second).mean()
    return numbers


def places_of(
    problem: PaperProblem, noise: float | str, rest_threshold: float, seed: int
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return times, sites of the first front (time,), and sites of the second (time, level).

    Each member draws its own noise, because its initial data are part of the seed.
    """
    in_doubles = noise == ROUNDING
    rng = np.random.default_rng([seed, *problem.initial.view(np.uint64).ravel()])
    pieces = integrate_intervals(
        problem if in_doubles else in_sums(problem), rest_threshold, SLICE_LENGTH
    )
    tau, fronts, seconds = [], [], []
    for times, _, _, sites in pieces:
        sums = turned(sites) if in_doubles else sites
        power = site_powers(sums[:2])
        tau.append(times[-1])
        fronts.append(find_front(site_powers(sums)))
        seconds.append([find_front(power, level) for level in LEVELS])
        if not in_doubles:
            size = np.sqrt(site_powers(sites[2:]))
            sites[:2] += noise * normal(rng, (2, size.size)) * size
    return np.array(tau), np.array(fronts), np.array(seconds)
