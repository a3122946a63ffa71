"""Tangent vectors of a solution carried along with it, and how much they have grown by each time.

A tangent vector is a small perturbation of the data, to first order. Solution and tangent vectors
are integrated together, and the vectors made orthonormal again at equal steps of time (Benettin,
Galgani, Giorgilli and Strelcyn, Meccanica 15 (1980) 9).
"""

from math import sqrt
from typing import NamedTuple

import numpy as np

from pendula.compiled import kernel
from pendula.integrators import DONE, FAULTS, dop853
from pendula.models.amplitudes import Chain
from pendula.models.chain import MIRROR
from pendula.models.tangent import ROWS, bundle_rates
from pendula.numerics.elementary import log
from pendula.problem import Problem, output_times
from pendula.simulation.interrupts import interruptible
from pendula.simulation.lattice import WHOLE, Reduction, aligned, pack
from pendula.simulation.models import make_chain
from pendula.simulation.simulate import IntegrationError

from .asymmetric import asymmetric_rates, odd_part


@kernel
def inner(chain, u, v):
    """Return the scalar product of two states over the whole chain, also where half is kept."""
    total = 0.0
    for row in range(u.shape[0]):
        for j in range(1, u.shape[1] - 1):
            total += u[row, j] * v[row, j]
    if chain.left == MIRROR:
        centre = 0.0
        for row in range(u.shape[0]):
            centre += u[row, 1] * v[row, 1]
        total = 2.0 * total - centre
    return total


@kernel
def subtract(u, factor, v):
    """Take `factor` times `v` from `u`."""
    for row in range(u.shape[0]):
        for j in range(1, u.shape[1] - 1):
            u[row, j] -= factor * v[row, j]


@kernel
def scale(u, factor):
    """Multiply `u` by `factor`."""
    for row in range(u.shape[0]):
        for j in range(1, u.shape[1] - 1):
            u[row, j] *= factor


@kernel
def orthonormalise(chain, bundle, lengths):
    """Make the tangent vectors in `bundle` orthonormal; write their lengths.

    This is the modified Gram-Schmidt method: the first vector keeps its direction, and each other
    one loses its components along those before it. `lengths` is (vector,).
    """
    for k in range(lengths.size):
        first = (k + 1) * ROWS
        u = bundle[first : first + ROWS]
        for before in range(ROWS, first, ROWS):
            v = bundle[before : before + ROWS]
            subtract(u, inner(chain, u, v), v)
        length = sqrt(inner(chain, u, u))
        lengths[k] = length
        scale(u, 1.0 / length)


STEP = 0.25
"""Units of tau between orthonormalisations: nothing grows by more than a factor of e in one."""
TOLERANCE = 1e-9


class Growth(NamedTuple):
    """How tangent vectors have grown; logarithms are natural ones."""

    tau: np.ndarray  # (time,)
    log_growth: np.ndarray  # (vector, time), logarithm of the growth since tau = 0
    size: np.ndarray  # (time,), l2 norm of the solution itself


class Motion(NamedTuple):
    """What is integrated: a solution and its tangent vectors, or a solution in asymmetric sums.

    The two share one solver, since a second one would take as long to compile.
    """

    chain: Chain
    asymmetric: bool


@kernel
def motion_rates(motion, bundle, slopes):
    """Write the rates of a bundle, or those of a solution alone in an arithmetic that is uneven."""
    if motion.asymmetric:
        asymmetric_rates(motion.chain, bundle, slopes)
    else:
        bundle_rates(motion.chain, bundle, slopes)


@kernel
def observe_nothing(motion, bundle, i, record):
    """Keep nothing: the bundle at the end of each span of time has all that is wanted."""


solve = dop853.build(motion_rates, observe_nothing)


@kernel
def carry(motion, bundle, span, controls, work, record, lengths, sizes, odd, stop):
    """Carry the bundle over as many spans of time as `lengths` (span, vector) has rows.

    Write `sizes` and, in asymmetric sums, the `odd` parts of the solution; return the status of the
    solver.
    """
    for i in range(lengths.shape[0]):
        outcome = solve(motion, bundle, span, controls, work, record, stop)
        if outcome.status != DONE:
            return outcome.status
        orthonormalise(motion.chain, bundle, lengths[i])
        sizes[i] = sqrt(inner(motion.chain, bundle[:ROWS], bundle[:ROWS]))
        if motion.asymmetric:
            odd[i] = odd_part(bundle)
    return DONE


def grow(
    problem: Problem,
    tangents: np.ndarray,
    end_time: float,
    even: bool = False,
    step: float = STEP,
    tolerance: float = TOLERANCE,
) -> Growth:
    """Carry `tangents` (vector, 2, N), perturbations of a problem's data, along with its solution.

    They must be linearly independent; `even` integrates half of a chain on which all are even.
    Raises IntegrationError where dop853 gives up.
    """
    reduction = Reduction(even, synchronised=False)
    motion = Motion(make_chain(problem.constants, problem.boundary, reduction), asymmetric=False)
    bundle = np.concatenate([pack(state, reduction) for state in (problem.amplitudes, *tangents)])
    tau = output_times(end_time, step)
    lengths, sizes = np.empty((tau.size, len(tangents))), np.empty(tau.size)
    orthonormalise(motion.chain, bundle, lengths[0])
    lengths[0] = 1.0
    sizes[0] = np.sqrt(inner(motion.chain, bundle[:ROWS], bundle[:ROWS]))
    _carry(motion, bundle, tau, tolerance, lengths, sizes, np.empty(tau.size))
    return Growth(tau, log(lengths).cumsum(axis=0).T, sizes)


def follow_odd_part(
    problem: Problem, amplitudes: np.ndarray, step: float, tolerance: float
) -> np.ndarray:
    """Return the relative size of the odd part at steps of time, (time,), from data (2, N).

    Sums over neighbours are asymmetric. Raises IntegrationError where dop853 gives up.
    """
    motion = Motion(make_chain(problem.constants, problem.boundary, WHOLE), asymmetric=True)
    tau, y = output_times(problem.end_time, step), pack(amplitudes, WHOLE)
    odd = np.empty(tau.size)
    odd[0] = odd_part(y)
    _carry(motion, y, tau, tolerance, np.empty((tau.size, 0)), np.empty(tau.size), odd)
    return odd


def _carry(motion: Motion, bundle, tau, tolerance: float, lengths, sizes, odd) -> None:
    """Carry a bundle to each later time, and write what `carry` says behind the first entries."""
    record, controls = np.empty(0), (tolerance, tolerance)
    work = aligned((dop853.WORK, *bundle.shape))
    later = lengths[1:], sizes[1:], odd[1:]
    status = interruptible(carry, motion, bundle, tau[:2], controls, work, record, *later)
    if status != DONE:
        raise IntegrationError(f"the motion could not be followed: {FAULTS[status]}")
