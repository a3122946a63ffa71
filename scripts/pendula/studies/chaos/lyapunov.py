"""Lyapunov exponents: the mean rates at which small changes of a solution grow.

The exponents of a Hamiltonian flow come in pairs of opposite sign, sum to zero, and two of them
vanish: those along the flow and across the energy.
"""

import numpy as np

from pendula.problem import Problem
from pendula.simulation.lattice import find_reduction

from .changes import PARITIES, random_change
from .tangents import Growth, grow

SEED = 20170817


def follow_parity(problem: Problem, parity: str, end_time: float, **controls) -> Growth:
    """Carry one random change of this parity along a case whose data are even.

    The kernels keep the parity to the last bit, so the
    change finds the fastest direction among those of its parity.
    """
    if not find_reduction(problem.amplitudes).even:
        raise ValueError("changes keep their parity only along data that are even in n")
    rng = np.random.default_rng([SEED, PARITIES.index(parity)])
    changes = random_change(problem.sites, parity, rng)[None]
    return grow(problem, changes, end_time, parity == "even", **controls)


def follow_all(problem: Problem, end_time: float, **controls) -> Growth:
    """Carry a full basis of 4 N changes along a case, for the whole spectrum."""
    rng = np.random.default_rng(SEED)
    changes = np.array([random_change(problem.sites, None, rng) for _ in range(4 * problem.sites)])
    return grow(problem, changes, end_time, **controls)
