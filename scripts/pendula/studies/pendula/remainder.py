"""How far the expansion (3) is from Newton's equations: its error, order by order in mu.

The pendula start from the data that the case gives them, x = 2 mu Re a and dx/dt = -2 mu omega Im a
with the amplitudes a of the case. The leading expansion starts from A = a, the corrected one from
what makes the same angles and velocities to its order (see pendula.models.expansion).

# ASSUME: the paper does not say which velocities its expansion starts from. Those of the model
# leave out the slow rate of the amplitudes, which changes the constant of the error and no order.

Error. It is the largest |x - x of (3)| over both pendula, all sites and all times up to an end. In
between it swings with omega, 3 omega and so on, so that its size repeats after half a period. Half
a period is sampled in each short span of tau, and the parabola through the largest sample and its
neighbours has the maximum.
"""

from collections.abc import Callable, Mapping
from typing import NamedTuple

import numpy as np

from pendula.datasets.netcdf import Variable
from pendula.datasets.trajectories import Contents
from pendula.measures.difference import VISIBLE
from pendula.models.pendula import frequency
from pendula.numerics.elementary import exp, log
from pendula.problem import PENDULA, Problem
from pendula.simulation.lattice import find_reduction

from .followed import angles_at, compared, misses, turns

PHASES = 12
"""Samples of half a period; with twice as many the maxima change by less than 1e-3."""


ROUNDING = 1e-16
"""What is smaller than this part of the data makes no difference to them in double precision."""


class Reading(NamedTuple):
    """What is taken for the expansion: the paper's, its next order, or a wrong one.

    `corrected` lets G move the amplitudes, from the corrected start. `third` is the factor of P E^3
    in the angles, and `clock` the slow time of the amplitudes over mu^2 t / 2.
    """

    corrected: bool = False
    third: float = 0.0
    clock: float = 1.0


READINGS = {"leading": Reading(), "corrected": Reading(corrected=True, third=1.0)}
WRONG = {
    "the slow time mu^2 t": Reading(clock=2.0),
    "a third harmonic of the opposite sign": Reading(corrected=True, third=-1.0),
    "a third harmonic alone": Reading(third=1.0),
}
"""Expansions that must not have the order of a right one."""


class Samples(NamedTuple):
    """Times at which angles are compared: windows of half a period, as counts of parts of one."""

    steps: np.ndarray  # (window, PHASES + 2): times in units of half a period / PHASES
    step: float  # that unit in tau
    apart: bool  # whether there is time between the windows

    @property
    def times(self) -> tuple[np.ndarray, np.ndarray]:
        """All times, once each and rising from zero on, and the place of each sample in them.

        They are in the unit `step`, by which a run has to multiply them.
        """
        steps, places = np.unique(np.append(0, self.steps), return_inverse=True)
        return steps, places[1:].reshape(self.steps.shape)


def samples(mu: float, omega: float, end: float, spacing: float) -> Samples:
    """Return windows of half a period that end at the multiples of `spacing` up to `end`.

    Where `spacing` is shorter than half a period, more of them cover all of the time. Two samples
    more leave no maximum at the edge of a window.
    """
    half_period = 0.5 * np.pi * mu * mu / np.sqrt(1.0 + mu * mu * omega)
    step = half_period / PHASES
    spans = spacing * np.arange(1, round(end / spacing) + 1)
    last = np.floor(spans / step * (1.0 + 1e-12)).astype(int)
    if spacing <= half_period:
        last = np.union1d(last, np.arange(PHASES, last[-1], PHASES))
    steps = last[:, None] - np.arange(PHASES + 1, -1, -1)
    return Samples(np.maximum(steps, 0), step, spacing > half_period)


def peak(before, here, after) -> np.ndarray:
    """Return the top of the parabola through three values if the middle one is the largest.

    Else it is the middle one, which also stays if it is infinite.
    """
    highest = (here >= before) & (here >= after) & np.isfinite(here)
    before, middle, after = (np.where(highest, one, 0.0) for one in (before, here, after))
    curved, slope = (before - middle) + (after - middle), before - after
    return np.where(
        curved < 0.0, middle - 0.125 * slope * slope / np.minimum(curved, -1e-300), here
    )


def window_maxima(found: Samples, errors: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return the time and the size of the largest of errors (window, sample) in each window.

    Windows that leave time between them miss the highest one between two: it is the top of a
    parabola again, through the maxima of three windows.
    """
    inner = errors[:, 1:-1].argmax(axis=1) + 1
    rows = np.arange(len(errors))
    size = peak(*(errors[rows, inner + i] for i in (-1, 0, 1)))
    if found.apart and size.size > 2:
        size[1:-1] = peak(size[:-2], size[1:-1], size[2:])
    return found.steps[rows, inner] * found.step, size


def up_to(taus: np.ndarray, sizes: np.ndarray, ends: np.ndarray, run_end: float) -> np.ndarray:
    """Return the largest of sizes (..., window) so far at each of `ends`; NaN beyond the run."""
    largest = np.maximum.accumulate(sizes, axis=-1)
    last = np.searchsorted(taus, ends, side="right") - 1
    return np.where(ends <= run_end, largest[..., last], np.nan)


def orders(errors: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return the order in mu of errors (mu, ...) as mu goes to zero, and what it may be off by.

    Each mu is half of the one before. The order between two neighbours is that of the limit plus a
    multiple of mu^2, so two of them, from the three smallest mu that have an error, give the limit.
    What the second of them differs by from the limit is taken as its error. NaN where fewer than
    three mu have an error.
    """
    shape = errors.shape[1:]
    order, off = np.full((2, *shape), np.nan)
    for place in np.ndindex(shape):
        known = np.flatnonzero(np.isfinite(errors[(slice(None), *place)]))
        if known.size >= 3:
            coarse, middle, fine = errors[(known[-3:], *place)]
            before, last = log(coarse / middle) / log(2.0), log(middle / fine) / log(2.0)
            step = (last - before) / 3.0
            order[place], off[place] = last + step, abs(step)
    return order, off


def smallest_known(errors: np.ndarray) -> np.ndarray:
    """Return, of errors (mu, ...), those of the last mu that has one; NaN where none has."""
    found = np.full(errors.shape[1:], np.nan)
    for one in errors:
        found = np.where(np.isfinite(one), one, found)
    return found


def horizon(taus: np.ndarray, errors: np.ndarray, sizes: np.ndarray, part: float) -> float:
    """Return the first tau at which the error so far is `part` of the largest angle so far.

    Infinite where it never is.
    """
    largest, size = np.maximum.accumulate(errors), np.maximum.accumulate(sizes)
    beyond = np.flatnonzero(largest >= part * size)
    return float(taus[beyond[0]]) if beyond.size else np.inf


class Followed(NamedTuple):
    """One run of the pendula, window by window: the error of each right reading, and the angles."""

    taus: np.ndarray  # (reading, window)
    errors: np.ndarray  # (reading, window)
    angles: np.ndarray  # (window,): the largest
    wrong: np.ndarray  # (wrong reading,): the largest error up to a time


def follow(problem: Problem, spacing: float, wrong_end: float) -> Followed:
    """Return how far the expansions are from the pendula of `problem` up to its end time.

    Wrong readings are followed up to the slow time `wrong_end` only.
    """
    mu, omega = problem.mu, problem.constants.omega
    reduction = find_reduction(problem.amplitudes)
    found = samples(mu, omega, problem.end_time, spacing)
    steps, places = found.times
    angles = angles_at(problem, steps * (np.pi / PHASES / frequency(omega, mu)), reduction)
    phases = np.pi / PHASES * np.arange(2 * PHASES)
    turned = turns(phases)[steps % phases.size]
    brief = int(np.searchsorted(steps * found.step, wrong_end * (1.0 + 1e-9), side="right"))
    counts = dict.fromkeys(READINGS, steps.size) | dict.fromkeys(WRONG, brief)
    missed = {}
    for (corrected, clock), thirds in runs_of({**READINGS, **WRONG}).items():
        wanted = np.array([counts[name] for name in thirds])
        record = compared(angles, turned, mu, np.array(list(thirds.values())), wanted)
        taus = clock * found.step * steps[: wanted.max()]
        sizes = misses(problem, mu * mu if corrected else 0.0, taus, record, reduction)
        missed |= dict(zip(thirds, sizes, strict=True))
    pairs = [window_maxima(found, missed[name][places]) for name in READINGS]
    return Followed(
        *map(np.array, zip(*pairs, strict=True)),
        window_maxima(found, np.abs(angles).max(axis=(1, 2))[places])[1],
        np.array([missed[name][:brief].max() for name in WRONG]),
    )


def runs_of(readings: Mapping[str, Reading]) -> dict[tuple[bool, float], dict[str, float]]:
    """Return by runs of the amplitudes the readings that share one, with their third harmonic."""
    runs = {}
    for name, one in readings.items():
        runs.setdefault((one.corrected, one.clock), {})[name] = one.third
    return runs


def reach(problem: Problem, end: float) -> int:
    """Return the last site that the data have reached by the slow time `end`, but for rounding.

    By (4) the larger modulus of a pair grows by epsilon times those of its neighbours and by
    2 (gamma + epsilon) times itself at most. So n sites away from the data it is at most
    e^(2 (gamma + epsilon) tau) (epsilon tau)^n / n! of the largest modulus of the data.
    """
    constants, n = problem.constants, 0
    largest = float(exp(2.0 * (abs(constants.gamma) + abs(constants.epsilon)) * end))
    while largest > ROUNDING:
        n += 1
        largest *= abs(constants.epsilon) * end / n
    return problem.initial.shape[1] // 2 + n - 1


class Case(NamedTuple):
    """What is found for one case: by the right expansions, and by the wrong ones."""

    errors: np.ndarray  # (mu, expansion, end)
    angles: np.ndarray  # (mu, end)
    horizons: np.ndarray  # (mu, expansion)
    wrong: np.ndarray  # (mu, wrong expansion), up to the shortest run's end


def measure(
    problem: Problem, run_ends: Mapping[float, float], ends: np.ndarray, spacing: float
) -> Case:
    """Return the errors of a case of the amplitudes, whose pendula are run to an end by each mu."""
    errors, angles, horizons, wrong = [], [], [], []
    for mu, end in run_ends.items():
        moving = min(problem.half_width, reach(problem, end))
        pendula = problem.changed(
            model=PENDULA, mu=mu, end_time=end, output_step=end, half_width=moving
        )
        run = follow(pendula, spacing, min(run_ends.values()))
        pairs = list(zip(run.taus, run.errors, strict=True))
        errors.append([up_to(tau, size, ends, end) for tau, size in pairs])
        angles.append(up_to(run.taus[0], run.angles, ends, end))
        horizons.append([horizon(tau, size, run.angles, VISIBLE) for tau, size in pairs])
        wrong.append(run.wrong)
    return Case(*map(np.array, (errors, angles, horizons, wrong)))


# --- The dataset ----------------------------------------------------------------------------------


def remainder_contents(
    problems: Mapping[str, Problem],
    run_ends: Mapping[str, Mapping[float, float]],
    end_step: float,
    spacing: float,
    step: Callable[[str], None] = lambda message: None,
) -> Contents:
    """Return the errors of all cases; `run_ends` gives by case and mu how far the pendula are run.

    All cases have the same mu, each half of the one before.
    """
    mus = np.array(list(next(iter(run_ends.values()))), dtype=float)
    last = np.array([list(run_ends[name].values()) for name in problems], dtype=float)
    ends = end_step * np.arange(1, round(last.max() / end_step) + 1)
    found = []
    for name, problem in problems.items():
        found.append(measure(problem, run_ends[name], ends, spacing))
        step(f"{name} done ({len(found)} of {len(problems)})")
    errors = np.array([one.errors for one in found]).transpose(2, 0, 1, 3)
    order, off = orders(np.moveaxis(errors, 2, 0))
    powers = np.array([mus * mus * mus, mus * mus * mus * mus * mus])
    constant = smallest_known(np.moveaxis(errors / powers[:, None, :, None], 2, 0))
    wrong = np.array([one.wrong for one in found]).transpose(2, 0, 1)
    horizons = np.array([one.horizons for one in found]).transpose(2, 0, 1)
    over, reduced = ("expansion", "case", "mu", "end"), ("expansion", "case", "end")
    variables = {
        "expansion": Variable(("expansion",), list(READINGS), "order of the expansion"),
        "case": Variable(("case",), list(problems)),
        "mu": Variable(("mu",), mus),
        "end": Variable(("end",), ends, "end of the time window, which begins at 0"),
        "omega": Variable(("case",), [float(one.constants.omega) for one in problems.values()]),
        "pendula_end": Variable(("case", "mu"), last, "end of the run of the pendula"),
        "error": Variable(over, errors, "error of an angle, the largest up to the end", "rad"),
        "order": Variable(reduced, order, "order in mu of the error as mu goes to zero"),
        "order_uncertainty": Variable(reduced, off, "what the order in mu may be off by"),
        "error_constant": Variable(
            reduced, constant, "error over mu^3, of the corrected expansion mu^5, at the least mu",
            "rad"),
        "largest_angle": Variable(("case", "mu", "end"), np.array([one.angles for one in found]),
                                  "largest angle up to the end", "rad"),
        "visible_from": Variable(over[:3], horizons,
                            "slow time at which the error is a visible part of the largest angle"),
        "wrong_expansion": Variable(("wrong_expansion",), list(WRONG), "expansion that is wrong"),
        "wrong_error": Variable(("wrong_expansion", "case", "mu"), wrong,
                                "largest error of an angle by a wrong expansion", "rad"),
        "wrong_order": Variable(("wrong_expansion", "case"), orders(np.moveaxis(wrong, 2, 0))[0],
                                "order in mu of the error of a wrong expansion"),
    }  # fmt: skip
    about = {"title": "The expansion (3) and its next order beside Newton's equations (1)"}
    about |= {"visible_part": VISIBLE, "spacing": spacing}
    return variables, about | _solver_of(problems)


def _solver_of(problems: Mapping[str, Problem]) -> dict[str, object]:
    """Return name and controls of the solver that follows the pendula of all cases."""
    (solver,) = {tuple(sorted(one.solver.items())) for one in problems.values()}
    return {"solver" if key == "name" else f"solver_{key}": value for key, value in solver}
