"""Which of almost equal data spread over the chain, and how almost equal they have to be.

A run has spread where no three neighbouring pairs, with their mirror image, hold more than half of
P at the end, see `fates`. The share of runs that have spread is counted over random relative
changes of the data of one size, with the exact limits of Clopper and Pearson.
"""

from collections.abc import Iterable

import numpy as np

from pendula.measures.confidence import Limits, share_limits
from pendula.problem import Problem
from pendula.simulation.ensembles import draw_members
from pendula.simulation.simulate import Trajectory, simulate

from .fates import at_the_end, place_of


def has_spread(run: Trajectory) -> bool:
    """Return whether no three pairs hold more than half of P at the end of a run."""
    return place_of(at_the_end(run)) is None


def largest_l2(run: Trajectory) -> float:
    """Return the largest l2 norm of a run over both components."""
    return float(np.sqrt((run.l2**2).sum(axis=0)).max())


def share_that_spreads(problem: Problem, size: float, members: int, seed: list[int]) -> Limits:
    """Return the share of members that spread, with its limits; all data have relative `size`."""
    runs = (simulate(member) for member in draw_members(problem, size, members, seed))
    return share_limits(sum(has_spread(run) for run in runs), members)


def shares(problem: Problem, sizes: Iterable[float], members: int, seed: int) -> Limits:
    """Return the share that spreads for each size of the change, (size,), by draws of its own."""
    found = [
        share_that_spreads(problem, size, members, [seed, number])
        for number, size in enumerate(sizes)
    ]
    return Limits(*np.array(found).T)


def scan(problem: Problem, amplitudes: np.ndarray, ratio: float) -> tuple[np.ndarray, np.ndarray]:
    """Return the largest l2 norm from each A_0 with B_0 = `ratio` A_0, and whether the run spreads.

    Both are (initial,).
    """
    runs = [
        simulate(problem.changed(initial=np.array([[a], [ratio * a]], complex))) for a in amplitudes
    ]
    return np.array([largest_l2(run) for run in runs]), np.array([has_spread(run) for run in runs])
