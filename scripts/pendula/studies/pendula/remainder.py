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

from collections.abc import Callable, Mapping, Sequence
from typing import NamedTuple

import numpy as np
from latticode.datasets.netcdf import Variable
from latticode.datasets.trajectories import Contents
from latticode.integrators import DONE, FAULTS, dop853
from latticode.kernels.compiled import kernel
from latticode.kernels.simd import largest_magnitude
from latticode.numerics.elementary import exp, log, product, turn
from latticode.simulation.interrupts import interruptible
from latticode.simulation.lattice import Reduction, aligned, find_reduction, pack
from latticode.simulation.simulate import IntegrationError

from pendula.models.expansion import Expansion, angle, corrected_start, rates
from pendula.models.integrations import make_chain
from pendula.models.pendula import frequency
from pendula.problem import PENDULA, Problem

from .runs import angles_at

TOLERANCE = 1e-12
"""Of the amplitudes, relative and absolute: far below what the expansion leaves at any mu."""
PHASES = 12
"""Samples of half a period; with twice as many the maxima change by less than 1e-3."""
ROUNDING = 1e-16
"""What is smaller than this part of the data makes no difference to them in double precision."""
RUNS = {
    (False, 1.0): {"leading": 0.0, "a third harmonic alone": 1.0},
    (True, 1.0): {"corrected": 1.0, "a third harmonic of the opposite sign": -1.0},
    (False, 2.0): {"the slow time mu^2 t": 0.0},
}
"""Expansions by the run of the amplitudes that they share, with the factor of P E^3 in the angles.

A run is told by whether G moves the amplitudes, from the corrected start, and by their slow time
over mu^2 t / 2.
"""
LOST = "; NaN: beyond the end of a run"
RIGHT = ("leading", "corrected")
WRONG = (
    "the slow time mu^2 t",
    "a third harmonic of the opposite sign",
    "a third harmonic alone",
)
"""Expansions that must not have the order of a right one."""


# --- How far an expansion is from the angles -----------------------------------------------------


class Compared(NamedTuple):
    """Angles of pendula, and how far those of expansions are from them."""

    angles: np.ndarray  # (time, component, site)
    turns: np.ndarray  # (time, 4): Re E, Im E, Re E^3 and Im E^3
    mu: float
    thirds: np.ndarray  # (expansion,): factors of the third harmonic
    counts: np.ndarray  # (expansion,): at so many times each is compared
    apart: np.ndarray  # (component, site): scratch
    misses: np.ndarray  # (expansion, time): the largest of all pendula


@kernel
def compare(expansion, y, i, record):
    """Write the largest misses of each expansion at output `i`, where the amplitudes are `y`."""
    turn = record.turns[i, 0], record.turns[i, 1], record.turns[i, 2], record.turns[i, 3]
    one, sites = np.uint64(1), record.apart.shape[1]
    for reading in range(record.thirds.size):
        if i >= record.counts[reading]:
            continue
        third = record.thirds[reading]
        for re in range(0, y.shape[0], 2):
            im, k, other = re + 1, re // 2, y.shape[0] - 2 - re
            for place in range(sites):
                site = np.uint64(place)  # so that no code asks whether it counts from the end
                j = site + one
                u, v, s, t = y[re, j], y[im, j], y[other, j], y[other + 1, j]
                expected = angle(record.mu, expansion.chain.gamma, third, turn, u, v, s, t)
                record.apart[k, site] = record.angles[i, k, site] - expected
        record.misses[reading, i] = largest_magnitude(record.apart.reshape(-1))


solve = dop853.build(rates, compare)


@kernel
def run(system, y, times, controls, work, record, stop):
    return solve(system, y, times, controls, work, record, stop)


def misses(
    problem: Problem, corrected: bool, taus: np.ndarray, turned: np.ndarray, angles: np.ndarray,
    thirds: Sequence[float], counts: Sequence[int], reduction: Reduction,
) -> np.ndarray:  # fmt: skip
    """Return how far expansions are from `angles`, (expansion, time), zero after their `counts`.

    `problem` is that of the pendula, whose angles (time, component, site) are of what `reduction`
    leaves of the chain; `turned` is E at each time. The amplitudes are solved at `taus`, which
    begin with 0: by F, or if `corrected` by F + mu^2 G from the data that have the angles and
    velocities of the problem's to that order (see pendula.models.expansion).
    """
    squared_mu = problem.mu * problem.mu if corrected else 0.0
    cubed = product(turned, product(turned, turned))
    record = Compared(
        angles, np.stack([turned.real, turned.imag, cubed.real, cubed.imag], axis=-1), problem.mu,
        np.array(thirds), np.array(counts), np.empty(angles.shape[1:]),
        np.zeros((len(thirds), max(counts))),
    )  # fmt: skip
    chain = make_chain(problem.constants, problem.boundary, reduction)
    y = corrected_start(chain, squared_mu, pack(problem.amplitudes, reduction))
    system = Expansion(chain, squared_mu, np.zeros_like(y), np.zeros_like(y))
    controls, work = (TOLERANCE, TOLERANCE), aligned((dop853.WORK, *y.shape))
    outcome = interruptible(run, system, y, taus, controls, work, record)
    if outcome.status != DONE:
        fault = FAULTS[outcome.status]
        raise IntegrationError(f"the amplitudes stopped at tau = {outcome.time:.6g}: {fault}")
    return record.misses


# --- Sampling ------------------------------------------------------------------------------------


class Samples(NamedTuple):
    """Times at which angles are compared: windows of half a period, as counts of parts of one."""

    steps: np.ndarray  # (window, PHASES + 2): times in units of half a period / PHASES
    step: float  # that unit in tau
    apart: bool  # whether there is time between the windows


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
    """Return the largest of sizes (window,) so far at each of `ends`; NaN beyond the run."""
    last = np.searchsorted(taus, ends, side="right") - 1
    return np.where(ends <= run_end, np.maximum.accumulate(sizes)[last], np.nan)


# --- Errors by case, mu and end ------------------------------------------------------------------


class Errors(NamedTuple):
    """Errors of the expansions in one run of the pendula; with mu as first axis, in several."""

    right: np.ndarray  # (expansion, end)
    wrong: np.ndarray  # (wrong expansion,), up to the shortest run's end


def follow(problem: Problem, ends: np.ndarray, spacing: float, wrong_end: float) -> Errors:
    """Return the errors of the expansions of the pendula of `problem` up to its end time.

    Wrong expansions are followed up to the slow time `wrong_end` only.
    """
    mu, omega = problem.mu, problem.constants.omega
    reduction = find_reduction(problem.amplitudes)
    found = samples(mu, omega, problem.end_time, spacing)
    # all times, once each and rising from zero on, and the place of each sample in them
    steps, places = np.unique(np.append(0, found.steps), return_inverse=True)
    places = places[1:].reshape(found.steps.shape)
    angles = angles_at(problem, steps * (np.pi / PHASES / frequency(omega, mu)), reduction)
    turned = turn(np.pi / PHASES * np.arange(2 * PHASES))[steps % (2 * PHASES)]
    brief = np.searchsorted(steps * found.step, wrong_end * (1.0 + 1e-9), side="right")
    missed = {}
    for (corrected, clock), thirds in RUNS.items():
        counts = [brief if name in WRONG else steps.size for name in thirds]
        taus = clock * found.step * steps[: max(counts)]
        given = taus, turned, angles, list(thirds.values()), counts
        sizes = misses(problem, corrected, *given, reduction)
        missed |= dict(zip(thirds, sizes, strict=True))
    right = [window_maxima(found, missed[name][places]) for name in RIGHT]
    return Errors(
        np.array([up_to(tau, size, ends, problem.end_time) for tau, size in right]),
        np.array([missed[name][:brief].max() for name in WRONG]),
    )


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


def measure(
    problem: Problem, run_ends: Mapping[float, float], ends: np.ndarray, spacing: float
) -> Errors:
    """Return the errors of a case of the amplitudes, whose pendula are run to an end by each mu."""
    found = []
    for mu, end in run_ends.items():
        moving = min(problem.half_width, reach(problem, end))
        changes = {"end_time": end, "output_step": end, "half_width": moving}
        pendula = problem.changed(model=PENDULA, mu=mu, **changes)
        found.append(follow(pendula, ends, spacing, min(run_ends.values())))
    return Errors(*map(np.array, zip(*found, strict=True)))


def orders(errors: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return the order in mu of errors (mu, ...) as mu goes to zero, and what it may be off by.

    Each mu is half of the one before. The order between two neighbours is that of the limit plus a
    multiple of mu^2, so two of them, from the three smallest mu that have an error, give the limit.
    What the second of them differs by from the limit is taken as its error. NaN where fewer than
    three mu have an error.
    """
    order, off = np.full((2, *errors.shape[1:]), np.nan)
    for place in np.ndindex(order.shape):
        known = np.flatnonzero(np.isfinite(errors[(slice(None), *place)]))
        if known.size >= 3:
            coarse, middle, fine = errors[(known[-3:], *place)]
            before, last = log(coarse / middle) / log(2.0), log(middle / fine) / log(2.0)
            step = (last - before) / 3.0
            order[place], off[place] = last + step, abs(step)
    return order, off


def remainder_contents(
    problems: Mapping[str, Problem],
    run_ends: Mapping[float, float],
    end_step: float,
    spacing: float,
    step: Callable[[str], None] = lambda message: None,
) -> Contents:
    """Return the errors of all cases; `run_ends` gives by mu how far the pendula are run.

    Each mu is half of the one before. Errors are of the times up to each multiple of `end_step`.
    """
    mus, last = (np.array([*one], dtype=float) for one in (run_ends, run_ends.values()))
    ends = end_step * np.arange(1, round(last.max() / end_step) + 1)
    found = []
    for name, problem in problems.items():
        found.append(measure(problem, run_ends, ends, spacing))
        step(f"{name} done ({len(found)} of {len(problems)})")
    errors = np.array([one.right for one in found])  # (case, mu, expansion, end)
    order, off = orders(errors.transpose(1, 2, 0, 3))
    wrong = np.array([one.wrong for one in found])  # (case, mu, wrong expansion)
    over, reduced = ("expansion", "case", "mu", "end"), ("expansion", "case", "end")
    variables = {
        "expansion": Variable(("expansion",), list(RIGHT), "order of the expansion"),
        "case": Variable(("case",), list(problems)),
        "mu": Variable(("mu",), mus),
        "end": Variable(("end",), ends, "end of the time window, which begins at 0"),
        "pendula_end": Variable(("mu",), last, "end of the run of the pendula"),
        "error": Variable(over, errors.transpose(2, 0, 1, 3),
                          f"error of an angle, the largest up to the end{LOST}", "rad"),
        "order": Variable(reduced, order, f"order in mu of the error as mu goes to zero{LOST}"),
        "order_uncertainty": Variable(reduced, off, f"what the order in mu may be off by{LOST}"),
        "wrong_expansion": Variable(("wrong_expansion",), list(WRONG), "expansion that is wrong"),
        "wrong_error": Variable(("wrong_expansion", "case", "mu"), wrong.transpose(2, 0, 1),
                                "largest error of an angle by a wrong expansion", "rad"),
        "wrong_order": Variable(("wrong_expansion", "case"), orders(wrong.transpose(1, 2, 0))[0],
                                "order in mu of the error of a wrong expansion"),
    }  # fmt: skip
    return variables, {"title": "The expansion (3) and its next order beside Newton's equations"}
