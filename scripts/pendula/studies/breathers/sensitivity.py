"""Share of runs that spread over the chain, by the size of a random change of the data.

A run has spread where its fate says so: no three neighbouring pairs, with their mirror image, hold
more than half of P at the end, and P is larger than waves could have made it, see `fates`. The
confidence limits of the share are the exact ones of Clopper and Pearson.
"""

from collections.abc import Sequence

import numpy as np

from pendula.datasets.netcdf import Variable
from pendula.datasets.registry import NAMES
from pendula.datasets.trajectories import Contents, describe_run
from pendula.measures.confidence import Limits, share_limits
from pendula.numerics.elementary import modulus
from pendula.problem import Problem
from pendula.simulation.ensembles import draw_members
from pendula.simulation.simulate import Trajectory, simulate

from .fates import SPREADS, fate_of


def has_spread(problem: Problem, run: Trajectory) -> bool:
    """Return whether a run of a problem has spread: neither stayed or moved, nor dispersed."""
    return fate_of(problem, run.final) == SPREADS


def shares(problem: Problem, sizes: Sequence[float], members: int, seed: int) -> Limits:
    """Return the share that spreads for each relative size of the change, (size,)."""
    # outputs take a third of a run, and only the last one is used
    at_the_end_alone = problem.changed(output_step=problem.end_time)
    found = []
    for number, size in enumerate(sizes):
        drawn = draw_members(at_the_end_alone, size, members, [seed, number])
        spread = sum(has_spread(member, simulate(member)) for member in drawn)
        found.append(share_limits(spread, members))
    return Limits(*np.array(found).T)


def scan_amplitudes(problem: Problem, amplitudes: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return the largest l2 norm from data of each largest amplitude, and whether the run spreads.

    All are multiples of the problem's data. Both results are (initial,).
    """
    parts = problem.initial / modulus(problem.initial).max()
    problems = [problem.changed(initial=a * parts) for a in amplitudes]
    runs = [simulate(one) for one in problems]
    largest = [np.sqrt((run.l2**2).sum(axis=0)).max() for run in runs]
    return np.array(largest), np.array([*map(has_spread, problems, runs)])


def sensitivity_contents(
    name: str, problem: Problem, sizes: Sequence[float], members: int, seed: int,
    scan: Sequence[float],
) -> Contents:  # fmt: skip
    """Return the share that spreads by the size of a change, and what each amplitude leads to."""
    share = shares(problem, sizes, members, seed)
    largest, spread = scan_amplitudes(problem, np.array(scan))
    by_size, by_amplitude, said = ("size",), ("initial",), "share of runs that spread"
    variables = {
        "size": Variable(by_size, np.array(sizes), "size of a random change of the data, relative"),
        "share": Variable(by_size, share.value, said),
        "share_low": Variable(by_size, share.low, f"{said}, lower confidence limit"),
        "share_high": Variable(by_size, share.high, f"{said}, upper confidence limit"),
        "initial": Variable(
            by_amplitude, np.array(scan), f"{NAMES['initial']}, given by A_0 alone"
        ),
        "largest_l2": Variable(by_amplitude, largest, "largest l2 norm of A and B together"),
        "spread": Variable(
            by_amplitude, spread.astype(np.int8), "1 if the run has spread at its end"
        ),
    }  # fmt: skip
    about = describe_run(name, problem, problem.solver) | {"members": members, "seed": seed}
    a, b = problem.initial[:, problem.initial.shape[1] // 2].real
    if a:
        about["ratio"] = float(b / a)
    return variables, {"title": f"Which data close to those of {name} spread", **about}
