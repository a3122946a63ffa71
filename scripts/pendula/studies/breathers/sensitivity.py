"""Which of almost equal data spread over the chain, and how almost equal they have to be.

A run has spread where its fate says so: no three neighbouring pairs, with their mirror image, hold
more than half of P at the end, and P is larger than waves could have made it, see `fates`. The
share of runs that have spread is counted over random relative changes of the data of one size, with
the exact limits of Clopper and Pearson.
"""

from collections.abc import Iterable

import numpy as np

from pendula.measures.confidence import Limits, share_limits
from pendula.numerics.elementary import modulus
from pendula.problem import Problem
from pendula.simulation.ensembles import draw_members
from pendula.simulation.simulate import Trajectory, simulate

from .fates import SPREADS, at_the_end, fate_of, largest_linear_gain, power_of


def has_spread(problem: Problem, run: Trajectory) -> bool:
    """Return whether a run of a problem has spread: neither stayed or moved, nor dispersed."""
    gain = largest_linear_gain(problem.constants)
    return fate_of(at_the_end(run), power_of(problem.initial), gain) == SPREADS


def largest_l2(run: Trajectory) -> float:
    """Return the largest l2 norm of a run over both components."""
    return float(np.sqrt((run.l2**2).sum(axis=0)).max())


def share_that_spreads(problem: Problem, size: float, members: int, seed: list[int]) -> Limits:
    """Return the share of members that spread, with its limits; all data have relative `size`."""
    # outputs take a third of a run, and nothing reads those before the end
    at_the_end_alone = problem.changed(output_step=problem.end_time)
    drawn = draw_members(at_the_end_alone, size, members, seed)
    return share_limits(sum(has_spread(member, simulate(member)) for member in drawn), members)


def shares(problem: Problem, sizes: Iterable[float], members: int, seed: int) -> Limits:
    """Return the share that spreads for each size of the change, (size,), by draws of its own."""
    found = [
        share_that_spreads(problem, size, members, [seed, number])
        for number, size in enumerate(sizes)
    ]
    return Limits(*np.array(found).T)


def scan(problem: Problem, amplitudes: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return the largest l2 norm from data of each largest amplitude, and whether the run spreads.

    All are multiples of the problem's data. Both results are (initial,).
    """
    parts = problem.initial / modulus(problem.initial).max()
    problems = [problem.changed(initial=a * parts) for a in amplitudes]
    runs = [simulate(one) for one in problems]
    spread = [has_spread(one, run) for one, run in zip(problems, runs, strict=True)]
    return np.array([largest_l2(run) for run in runs]), np.array(spread)
