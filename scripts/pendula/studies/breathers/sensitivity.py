"""Share of runs that spread over the chain, by the size of a random perturbation of the data.

As in `fates`, a run spreads if no three neighbouring pairs, with their mirror images, have more
than half of P at the end, and P is larger than linear waves can reach. The confidence limits of the
share are the exact ones of Clopper and Pearson.
"""

from collections.abc import Sequence
from functools import partial

import numpy as np
from latticode.datasets.netcdf import Variable
from latticode.datasets.stated import describe_run
from latticode.datasets.trajectories import Contents
from latticode.equations.ensembles import draw_members
from latticode.measures.confidence import ConfidenceInterval, share_limits
from latticode.simulation.runs import ManyRuns
from replication.variables import CHAOTIC

from pendula.problem import PaperProblem

from .fates import MAJORITY, SPREADS, keep_fate


def measure_sensitivity(
    name: str,
    problem: PaperProblem,
    sizes: Sequence[float],
    members: int,
    seed: int,
    majority: float = MAJORITY,
) -> ManyRuns:
    """Return the runs that give the share that spreads for each relative perturbation."""
    # outputs take a third of the time of a run, and only the last output is used
    at_the_end_alone = problem.changed(output_step=problem.end_time)
    drawn = [
        member
        for number, size in enumerate(sizes)
        for member in draw_members(at_the_end_alone, size, members, [seed, number])
    ]
    attributes = describe_run(name, problem, problem.solver) | {"members": members, "seed": seed}
    attributes |= CHAOTIC
    title = f"Which data close to those of {name} spread"

    def conclude(retained: dict[str, np.ndarray]) -> Contents:
        return _shares_of(sizes, members, retained["fate"]), {"title": title, **attributes}

    return ManyRuns(drawn, partial(keep_fate, majority=majority), conclude)


def _shares_of(sizes: Sequence[float], members: int, fates: np.ndarray) -> dict[str, Variable]:
    """Return the share of the fates (run,) that spread, with its confidence limits, (size,)."""
    spread = (fates == SPREADS).reshape(len(sizes), members).sum(axis=1)
    share = ConfidenceInterval(
        *np.transpose([share_limits(int(count), members) for count in spread])
    )
    by_size, label = ("size",), "share of runs that spread"
    return {
        "size": Variable(by_size, np.array(sizes), "size of a random change of the data, relative"),
        "share": Variable(by_size, share.value, label),
        "share_low": Variable(by_size, share.low, f"{label}, lower confidence limit"),
        "share_high": Variable(by_size, share.high, f"{label}, upper confidence limit"),
    }
