"""Small changes of a solution carried along with it, and how much they have grown by each time.

Benettin, Galgani, Giorgilli and Strelcyn (Meccanica 15 (1980) 9): solution and changes are
integrated together, and the changes made orthonormal again at equal steps of time.
"""

from math import sqrt
from typing import NamedTuple

import numpy as np

from pendula.compiled import kernel
from pendula.integrators import dop853
from pendula.integrators.outcome import DONE, FAULTS
from pendula.models.tangent import ROWS, bundle_rates
from pendula.problem import Problem, output_times
from pendula.simulation.lattice import Reduction, pack
from pendula.simulation.simulate import IntegrationError, aligned, make_chain

from .orthonormal import inner, orthonormalise

STEP = 0.25
"""Units of tau between orthonormalisations: nothing grows by more than a factor of e in one."""
TOLERANCE = 1e-9


class Growth(NamedTuple):
    """What became of the changes; logarithms are natural ones."""

    tau: np.ndarray  # (time,)
    stretch: np.ndarray  # (change, time), logarithm of the growth since tau = 0
    size: np.ndarray  # (time,), l2 norm of the solution itself


@kernel
def observe_nothing(chain, bundle, i, record):
    """Keep nothing: what is wanted is in the bundle at the end of each step."""


solve = dop853.build(bundle_rates, observe_nothing)


@kernel
def carry(chain, bundle, span, controls, work, record, stretches, sizes):
    """Carry the bundle over as many spans of time as `stretches` (span, change) has rows.

    Return the status of the solver.
    """
    for i in range(stretches.shape[0]):
        outcome = solve(chain, bundle, span, controls, work, record)
        if outcome.status != DONE:
            return outcome.status
        orthonormalise(chain, bundle, stretches[i])
        sizes[i] = sqrt(inner(chain, bundle[:ROWS], bundle[:ROWS]))
    return DONE


def grow(
    problem: Problem,
    changes: np.ndarray,
    end_time: float,
    even: bool = False,
    step: float = STEP,
    tolerance: float = TOLERANCE,
) -> Growth:
    """Carry `changes` (change, 2, N) of a problem's data along with its solution.

    They must be linearly independent; `even` integrates half of a chain on which all are even.
    """
    reduction = Reduction(even, synchronised=False)
    chain = make_chain(problem.constants, problem.boundary, reduction)
    bundle = np.concatenate([pack(state, reduction) for state in (problem.amplitudes, *changes)])
    tau = output_times(end_time, step)
    stretches, sizes = np.empty((tau.size, len(changes))), np.empty(tau.size)
    orthonormalise(chain, bundle, stretches[0])
    stretches[0] = 0.0
    sizes[0] = np.sqrt(inner(chain, bundle[:ROWS], bundle[:ROWS]))
    span, record = tau[:2], np.empty(0)
    work = aligned((dop853.WORK, *bundle.shape))
    status = carry(
        chain, bundle, span, (tolerance, tolerance), work, record, stretches[1:], sizes[1:]
    )
    if status != DONE:
        raise IntegrationError(f"the changes could not be followed: {FAULTS[status]}")
    return Growth(tau, stretches.cumsum(axis=0).T, sizes)
