"""The dataset of broken symmetry."""

import numpy as np

from pendula.datasets.netcdf import Variable
from pendula.measures.difference import first_above
from pendula.problem import Problem

from .cases import describe_cases
from .symmetry import BROKEN, GROWING, break_symmetry, growth_between


def odd_parts(
    problems: dict[str, Problem], size: float, members: int, seed: int
) -> dict[str, Variable]:
    """Return the odd part of each case against time, when it passes BROKEN, how fast it grows.

    `problems` are given by case, all of one end time.
    """
    runs = [break_symmetry(problem, size, members, seed) for problem in problems.values()]
    first = next(iter(problems.values()))
    tau = first.times
    variables = {
        **describe_cases(problems),
        "tau": Variable(("tau",), tau, "slow time"),
    }
    for name, title, dims in (
        ("rounded", "by rounding alone", ("case",)),
        ("perturbed", "from an odd perturbation", ("case", "member")),
    ):
        odd = np.array([getattr(run, name) for run in runs])
        broken = first_above(tau, odd, BROKEN)
        rates = np.apply_along_axis(lambda one: growth_between(tau, one, *GROWING), -1, odd)
        variables |= {
            name: Variable((*dims, "tau"), odd, f"relative l2 norm of the odd part {title}"),
            f"{name}_time": Variable(dims, broken, f"odd part above {BROKEN:g} {title}", "tau"),
            f"{name}_rate": Variable(dims, rates, f"growth rate of the odd part {title}", "tau-1"),
        }
    return variables
