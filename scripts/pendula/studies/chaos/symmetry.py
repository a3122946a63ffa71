"""How a solution that is even in n loses its evenness: by rounding, or by odd perturbations.

The library sums neighbours so that evenness survives rounding. Here they are summed from right to
left, as one writes it first, so that each step leaves an odd error of the order of rounding.
"""

from math import sqrt
from typing import NamedTuple

import numpy as np

from pendula.compiled import inlined_by_llvm, kernel
from pendula.datasets.netcdf import Variable
from pendula.datasets.trajectories import Contents, describe_cases
from pendula.integrators import DONE, FAULTS, dop853
from pendula.measures.difference import first_above
from pendula.models.amplitudes import at_every_site, close, field, modulus2
from pendula.numerics.elementary import square_modulus
from pendula.problem import Problem
from pendula.simulation.interrupts import interruptible
from pendula.simulation.lattice import WHOLE, pack
from pendula.simulation.simulate import IntegrationError, aligned, make_chain

from .tangents import random_tangent

BROKEN = 0.01
"""Relative size of the odd part from which on a solution no longer counts as even."""


@inlined_by_llvm
def lopsided_field(chain, drive, left, u, right, partner, squared_modulus):
    """Return one part of the right-hand side of (4), its neighbours summed from right to left."""
    coupling = chain.epsilon * ((right - 2.0 * u) + left)
    # where a site and its neighbours are alike, the field has no coupling of its own
    return coupling + field(chain, drive, u, u, u, partner, squared_modulus)


@inlined_by_llvm
def lopsided_part(chain, drive, y, row, other, j, squared_modulus):
    """Return the right-hand side from one row at column `j`; `other` is that of the partner."""
    before, here, after = y[row, j - 1], y[row, j], y[row, j + 1]
    return lopsided_field(chain, drive, before, here, after, y[other, j], squared_modulus)


@inlined_by_llvm
def lopsided_at(chain, states, re, j, dy):
    y, im, other = states[0], re + 1, dy.shape[0] - 2 - re
    squared_modulus = modulus2(y, re, j)
    dy[re, j] = lopsided_part(chain, -chain.gamma, y, im, other + 1, j, squared_modulus)
    dy[im, j] = -lopsided_part(chain, chain.gamma, y, re, other, j, squared_modulus)


write_lopsided = at_every_site(lopsided_at)


@kernel
def lopsided_rates(chain, y, dy):
    """Write the right-hand side of (4) at `y` into `dy`, in an arithmetic that is not even."""
    close(chain, y)
    write_lopsided(chain, (y,), dy)


@kernel
def observe_odd(chain, y, i, odd):
    """Write the l2 norm of the part of `y` that is odd in n, relative to the whole, to odd[i]."""
    last = y.shape[1] - 1
    part = whole = 0.0
    for row in range(y.shape[0]):
        for j in range(1, last):
            half = 0.5 * (y[row, j] - y[row, last - j])
            part += half * half
            whole += y[row, j] * y[row, j]
    odd[i] = sqrt(part / whole)


solve = dop853.build(lopsided_rates, observe_odd)


@kernel
def run_lopsided(chain, y, times, controls, work, odd, stop):
    return solve(chain, y, times, controls, work, odd, stop)


def follow_odd_part(problem: Problem, amplitudes: np.ndarray) -> np.ndarray:
    """Return the relative size of the odd part at each output time, (time,), from (2, N) data."""
    chain = make_chain(problem.constants, problem.boundary, WHOLE)
    times = problem.times
    controls = tuple(float(problem.solver[key]) for key in ("rtol", "atol"))
    y, odd = pack(amplitudes, WHOLE), np.empty(len(times))
    work = aligned((dop853.WORK, *y.shape))
    outcome = interruptible(run_lopsided, chain, y, times, controls, work, odd)
    if outcome.status != DONE:
        raise IntegrationError(f"stopped at tau = {outcome.time:.6g}: {FAULTS[outcome.status]}")
    return odd


class OddPart(NamedTuple):
    """Relative sizes of the odd part; members are seeded odd perturbations of the data."""

    rounded: np.ndarray  # (time,)
    perturbed: np.ndarray  # (member, time)


def break_symmetry(problem: Problem, size: float, members: int, seed: int = 0) -> OddPart:
    """Follow even data as they are, and with odd perturbations of l2 norm `size` relative to them.

    The problem is solved by dop853.
    """
    amplitudes = problem.amplitudes
    rng = np.random.default_rng(seed)
    perturbed = []
    for _ in range(members):
        odd = random_tangent(amplitudes.shape[1], "odd", rng)
        odd *= size * np.sqrt(square_modulus(amplitudes).sum() / square_modulus(odd).sum())
        perturbed.append(follow_odd_part(problem, amplitudes + odd))
    return OddPart(follow_odd_part(problem, amplitudes), np.array(perturbed))


def odd_parts(problems: dict[str, Problem], size: float, members: int, seed: int) -> Contents:
    """Return the odd part of each case against time, and when rounding alone makes it visible.

    `problems` are given by case, all of one end time; `rounded_time` is when it passes BROKEN.
    """
    runs = [break_symmetry(problem, size, members, seed) for problem in problems.values()]
    tau = next(iter(problems.values())).times
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
