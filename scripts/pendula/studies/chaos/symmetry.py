"""How a solution that is even in n loses its evenness: by rounding, or by odd perturbations."""

from typing import NamedTuple

import numpy as np

from pendula.datasets.netcdf import Variable
from pendula.datasets.trajectories import Contents, describe_cases
from pendula.measures.difference import first_above
from pendula.numerics.elementary import square_modulus
from pendula.problem import Problem, output_times

from .tangent_dynamics import follow_odd_part
from .tangents import random_tangent

BROKEN = 0.01
"""Relative size of the odd part from which on a solution no longer counts as even."""


class OddPart(NamedTuple):
    """Relative sizes of the odd part; members are seeded odd perturbations of the data."""

    rounded: np.ndarray  # (time,)
    perturbed: np.ndarray  # (member, time)


def break_symmetry(
    problem: Problem, size: float, members: int, seed: int = 0, step: float = 0.25
) -> OddPart:
    """Follow even data as they are, and with odd perturbations of l2 norm `size` relative to them.

    The problem is solved by dop853 at its tolerance, and odd parts are measured at each `step`.
    """
    amplitudes, tolerance = problem.amplitudes, problem.solver["rtol"]
    rng = np.random.default_rng(seed)
    perturbed = []
    for _ in range(members):
        odd = random_tangent(amplitudes.shape[1], "odd", rng)
        odd *= size * np.sqrt(square_modulus(amplitudes).sum() / square_modulus(odd).sum())
        perturbed.append(follow_odd_part(problem, amplitudes + odd, step, tolerance))
    rounded = follow_odd_part(problem, amplitudes, step, tolerance)
    return OddPart(rounded, np.array(perturbed))


def odd_parts(
    problems: dict[str, Problem], size: float, members: int, seed: int, step: float
) -> Contents:
    """Return the odd part of each case against time, and when rounding alone makes it visible.

    `problems` are given by case, all of one end time; `rounded_time` is when it passes BROKEN.
    """
    runs = [break_symmetry(problem, size, members, seed, step) for problem in problems.values()]
    tau = output_times(next(iter(problems.values())).end_time, step)
    rounded = np.array([run.rounded for run in runs])
    perturbed = np.array([run.perturbed for run in runs])
    described, shared = describe_cases(problems)
    part = "relative l2 norm of the odd part"
    variables = {
        **described,
        "tau": Variable(("tau",), tau),
        "rounded": Variable(("case", "tau"), rounded, f"{part} by rounding alone"),
        "rounded_time": Variable(
            ("case",), first_above(tau, rounded, BROKEN), f"{part} above {BROKEN:g} by rounding"
        ),
        "perturbed": Variable(
            ("case", "member", "tau"), perturbed, f"{part} from an odd perturbation"
        ),
    }
    title = "How even data lose their evenness: by rounding, and by small odd perturbations"
    about = {"perturbation": size, "members": members, "seed": seed}
    return variables, {"title": title, **shared, **about}
