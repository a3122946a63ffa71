"""Runs of the pendula, and of the amplitudes behind an expansion, at times of the study's own."""

from math import ceil
from typing import NamedTuple

import numpy as np

from pendula.compiled import kernel
from pendula.integrators import DONE, FAULTS, dop853
from pendula.models.expansion import Expansion, angle, corrected_start, rates
from pendula.models.pendula import frequency
from pendula.numerics import elementary
from pendula.numerics.elementary import product
from pendula.problem import Problem
from pendula.simd import largest_magnitude
from pendula.simulation.interrupts import interruptible
from pendula.simulation.lattice import Reduction, aligned, find_reduction, pack
from pendula.simulation.models import MODELS, make_chain
from pendula.simulation.simulate import IntegrationError

from .mathieu import strings_grow

TOLERANCE = 1e-12
"""Of the amplitudes, relative and absolute: far below what the expansion leaves at any mu."""
LOST = 16.0 * np.pi
"""An angle in rad, of eight turns: no expansion about the pendula at rest follows it."""
NOT_KNOWN = "NaN is not known: the drive makes pendula over the top ever faster"
PIECE = 168
"""Times between two looks at the angles."""


class Compared(NamedTuple):
    """Angles of pendula, and how far those of an expansion are from them, reading by reading."""

    angles: np.ndarray  # (time, component, site)
    turns: np.ndarray  # (time, 4)
    mu: float
    thirds: np.ndarray  # (reading,): factors of the third harmonic
    counts: np.ndarray  # (reading,): at so many times each is compared
    apart: np.ndarray  # (component, site): scratch
    misses: np.ndarray  # (reading, time): the largest of all pendula


def turns(phases: np.ndarray) -> np.ndarray:
    """Return Re E, Im E, Re E^3 and Im E^3 (phase, 4) where omega t is one of `phases`."""
    once = elementary.turn(phases)
    cubed = product(once, product(once, once))
    return np.stack([once.real, once.imag, cubed.real, cubed.imag], axis=-1)


def compared(
    angles: np.ndarray, turns: np.ndarray, mu: float, thirds: np.ndarray, counts: np.ndarray
) -> Compared:
    """Return the record that `compare` reads, with arrays in which it writes its results."""
    blank = np.empty(angles.shape[1:]), np.zeros((len(thirds), counts.max()))
    return Compared(angles, turns, mu, thirds, counts, *blank)


@kernel
def compare(expansion, y, i, record):
    """Write the largest misses of each reading at output `i`, where the amplitudes are `y`."""
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
    problem: Problem, squared_mu: float, taus: np.ndarray, record: Compared, reduction: Reduction
) -> np.ndarray:
    """Return `record.misses`, filled in at all times `taus`, which begin with 0.

    The amplitudes of what `reduction` leaves of the chain move by F + `squared_mu` G (see
    pendula.models.expansion), from the data that have the angles and velocities of the problem's
    data to that order.
    """
    chain = make_chain(problem.constants, problem.boundary, reduction)
    y = corrected_start(chain, squared_mu, pack(problem.amplitudes, reduction))
    system = Expansion(chain, squared_mu, np.zeros_like(y), np.zeros_like(y))
    controls, work = (TOLERANCE, TOLERANCE), aligned((dop853.WORK, *y.shape))
    outcome = interruptible(run, system, y, taus, controls, work, record)
    if outcome.status != DONE:
        fault = FAULTS[outcome.status]
        raise IntegrationError(f"the amplitudes stopped at tau = {outcome.time:.6g}: {fault}")
    return record.misses


def until_lost(problem: Problem) -> Problem:
    """Return a problem of the pendula, ended where one of them is LOST to a drive without bounds.

    Where the drive makes the strings grow, pendula over the top turn exponentially faster, and the
    number of steps grows alike: in ten units of tau it may become 1e10. Where a pendulum is lost
    before the first output, the problem has outputs at shorter steps.
    """
    if not strings_grow(problem.constants, problem.mu):
        return problem
    each = ceil(2.0 * problem.output_step / period_of(problem))
    looks = problem.changed(output_step=problem.output_step / each)
    times = MODELS[problem.model].times(looks)
    angles = angles_at(looks, times, find_reduction(problem.amplitudes), piece=1)
    known = np.isfinite(angles[:, 0, 0]).sum() - 1
    if known < each:
        return looks.changed(end_time=float(looks.times[known]))
    return problem.changed(end_time=float(problem.times[known // each]))


def period_of(problem: Problem) -> float:
    """Return the period 2 pi / omega of the pendula in units of tau."""
    mu = problem.mu
    return np.pi * mu * mu / frequency(problem.constants.omega, mu)


def angles_at(
    problem: Problem, times: np.ndarray, reduction: Reduction, piece: int = PIECE
) -> np.ndarray:
    """Return the angles (time, component, site) of what `reduction` leaves, at the times t.

    `problem` is one of the pendula, and `times` begin with 0. Pendula that have gone over the top
    may be driven faster and faster, which takes ever more steps. So the run ends where an angle is
    beyond LOST after so many times as `piece` says, and all angles are infinite from then on.
    """
    model = MODELS[problem.model]
    method, y = model.solvers[problem.solver["name"]], model.start(problem, reduction)
    system = model.system(problem, reduction)
    rtol, atol = (float(problem.solver[name]) for name in method.controls)
    controls, work = (rtol, atol * model.atol(problem)), method.room_for(system, y)
    angles = np.full((times.size, y.shape[0] // 2, y.shape[1] - 2), np.inf)

    def follow(stop: np.ndarray) -> None:
        for first in range(0, times.size - 1, piece):
            part = times[first : first + piece + 1]
            record = model.record(*angles.shape[1:], part.size, 1)
            outcome = method.run(system, y, part, controls, work, record, stop)
            if outcome.status != DONE:
                raise IntegrationError(f"the pendula stopped: {FAULTS[outcome.status]}")
            angles[first : first + part.size] = np.moveaxis(record.snapshots[0], -1, 0)
            if np.abs(y[::2]).max() > LOST:
                return

    interruptible(follow)
    return angles
