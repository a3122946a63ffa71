"""How a solution that is even in n loses its evenness: by rounding, or by odd perturbations."""

import numpy as np

from pendula.datasets.netcdf import Variable
from pendula.datasets.trajectories import Contents, describe_cases
from pendula.measures.difference import first_above
from pendula.numerics.elementary import square_modulus
from pendula.problem import Problem, output_times

from .lyapunov import random_tangent
from .tangent_dynamics import follow_odd_part

BROKEN = 0.01
"""Relative size of the odd part from which on a solution no longer counts as even."""


def break_symmetry(
    problem: Problem, size: float, members: int, seed: int, step: float
) -> tuple[np.ndarray, np.ndarray]:
    """Return relative sizes of the odd part from even data (time,), and perturbed (member, time).

    Perturbations are odd, seeded, and of l2 norm `size` relative to the data. The problem is solved
    by dop853 at its tolerance, and odd parts are measured at each `step`.
    """
    amplitudes, tolerance = problem.amplitudes, problem.solver["rtol"]
    rng = np.random.default_rng(seed)
    perturbed = []
    for _ in range(members):
        odd = random_tangent(amplitudes.shape[1], "odd", rng)
        odd *= size * np.sqrt(square_modulus(amplitudes).sum() / square_modulus(odd).sum())
        perturbed.append(follow_odd_part(problem, amplitudes + odd, step, tolerance))
    return follow_odd_part(problem, amplitudes, step, tolerance), np.array(perturbed)


def odd_parts(
    problems: dict[str, Problem], size: float, members: int, seed: int, step: float
) -> Contents:
    """Return the odd part of each case against time, and when rounding alone makes it visible.

    `problems` are given by case, all of one end time; `rounded_time` is when it passes BROKEN.
    """
    runs = [break_symmetry(problem, size, members, seed, step) for problem in problems.values()]
    rounded, perturbed = map(np.array, zip(*runs, strict=True))
    tau = output_times(next(iter(problems.values())).end_time, step)
    part = "relative l2 norm of the odd part"
    described, shared = describe_cases(problems)
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
