"""Tangent vectors of a solution carried along with it, and how much they have grown by each time.

A tangent vector is a small perturbation of the data, to first order. Solution and tangent vectors
are integrated together, and the vectors made orthonormal again at equal steps of time (Benettin,
Galgani, Giorgilli and Strelcyn, Meccanica 15 (1980) 9).
"""

from math import sqrt
from typing import NamedTuple

import numpy as np
from latticode.equations.ends import MIRROR
from latticode.integrators import DONE, FAULTS, dop853
from latticode.kernels.compiled import kernel
from latticode.numerics.draws import complex_normal
from latticode.numerics.elementary import log
from latticode.simulation.interrupts import interruptible
from latticode.simulation.lattice import Reduction, aligned, pack
from latticode.simulation.problem import output_times
from latticode.simulation.simulate import IntegrationError

from pendula.models.tangent import ROWS, bundle_rates
from pendula.problem import Problem

from .integrations import make_chain


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


@kernel
def observe_nothing(chain, bundle, i, record):
    """Keep nothing: the bundle at the end of each span of time has all that is wanted."""


solve = dop853.build(bundle_rates, observe_nothing)


@kernel
def carry(chain, bundle, span, controls, work, record, lengths, sizes, stop):
    """Carry the bundle over as many spans of time as `lengths` (span, vector) has rows.

    Write `sizes` of the solution; return the status of the solver.
    """
    for i in range(lengths.shape[0]):
        outcome = solve(chain, bundle, span, controls, work, record, stop)
        if outcome.status != DONE:
            return outcome.status
        orthonormalise(chain, bundle, lengths[i])
        sizes[i] = sqrt(inner(chain, bundle[:ROWS], bundle[:ROWS]))
    return DONE


def random_tangent(sites: int, rng: np.random.Generator, even: bool = False) -> np.ndarray:
    """Return complex Gaussian amplitudes (2, N), even in n to the last bit if that is wanted."""
    z = complex_normal(rng, (2, sites))
    return z + z[:, ::-1] if even else z


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
    chain = make_chain(problem.constants, problem.boundary, reduction)
    bundle = np.concatenate([pack(state, reduction) for state in (problem.amplitudes, *tangents)])
    tau = output_times(end_time, step)
    lengths, sizes = np.empty((tau.size, len(tangents))), np.empty(tau.size)
    orthonormalise(chain, bundle, lengths[0])
    lengths[0] = 1.0
    sizes[0] = np.sqrt(inner(chain, bundle[:ROWS], bundle[:ROWS]))
    record, controls = np.empty(0), (tolerance, tolerance)
    work = aligned((dop853.WORK, *bundle.shape))
    later = lengths[1:], sizes[1:]
    status = interruptible(carry, chain, bundle, tau[:2], controls, work, record, *later)
    if status != DONE:
        raise IntegrationError(f"the motion could not be followed: {FAULTS[status]}")
    return Growth(tau, log(lengths).cumsum(axis=0).T, sizes)
