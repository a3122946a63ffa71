"""The phases of the paper in the real pendula: norms, and where they move, for all cases and mu.

Large data at a large mu start near the top of their swing. Their pendula are chaotic, so that the
largest P of one run is an accident of its rounding. What these data do is asked of an ensemble.
"""

from collections.abc import Mapping, Sequence

import numpy as np

from pendula.datasets.netcdf import Variable
from pendula.datasets.trajectories import COMPONENTS, Contents, describe_cases, side_by_side
from pendula.models.bounds import theorem_1_bound, theorem_3_bound
from pendula.problem import Problem
from pendula.simulation.ensembles import draw_members
from pendula.simulation.simulate import Trajectory, simulate

from .envelope import LIMIT, at_mu, envelopes, norms_of
from .followed import NOT_KNOWN

ENVELOPE = "of the amplitudes got back from angles and velocities"


def measure_phases(
    problems: Mapping[str, Problem], mus: Sequence[float], look_every: int,
    case: str, size: float, members: int, seed: int,
) -> Contents:  # fmt: skip
    """Return norms of the envelopes of all cases at mu = 0, which is (4), and at each of `mus`.

    All cases end at one time, and norms are NaN once a pendulum is lost (followed.until_lost). The
    sites are those of the longest chain. The larger envelope of each pair is kept at every
    `look_every`-th output. So many members of one case are held to Theorem 1 at the largest of
    `mus`: the data of each are changed by `size`, relatively.
    """
    every = [LIMIT, *mus]
    found = [[envelopes(at_mu(one, mu)) for mu in every] for one in problems.values()]
    tau = found[0][0][0].tau
    norms = np.array([[norms_of(moduli) for _, moduli in row] for row in found])
    looks = side_by_side(
        [np.stack([moduli.max(axis=0)[:, ::look_every] for _, moduli in row]) for row in found], 1
    )
    reach = looks.shape[2] // 2
    described, shared = describe_cases(problems)
    over = ("case", "mu", "component", "tau")
    variables = {
        **described,
        "mu": Variable(("mu",), every),
        "tau": Variable(("tau",), tau),
        "component": COMPONENTS,
        "site": Variable(("site",), np.arange(-reach, reach + 1)),
        "snapshot_tau": Variable(("snapshot",), tau[::look_every]),
        "l2": Variable(over, norms[:, :, 0]),
        "linf": Variable(over, norms[:, :, 1]),
        "larger_modulus": Variable(("case", "mu", "site", "snapshot"), np.float32(looks),
                                   "larger modulus of the two amplitudes on a site"),
        **_bounds(problems, [row[0][0] for row in found]),
        **_members(draw_members(problems[case], size, members, seed), max(mus)),
    }  # fmt: skip
    about = {"perturbed_case": case, "perturbation": size, "members": members, "seed": seed}
    about |= {"comment": NOT_KNOWN} if np.isnan(norms).any() else {}
    title = f"The cases of the paper as pendula: norms {ENVELOPE}; mu = 0 stands for (4)"
    return variables, {**shared, **about, "title": title}


def over_theorem_1(problem: Problem, mu: float) -> float:
    """Return the largest known P of the envelopes at mu, over what Theorem 1 allows by the data."""
    energy = simulate(problem.changed(end_time=problem.output_step)).energy[0]
    l2, _ = norms_of(envelopes(at_mu(problem, mu))[1])
    return float(np.nanmax((l2 * l2).sum(axis=0)) / theorem_1_bound(energy, problem.constants))


def _members(drawn: Sequence[Problem], mu: float) -> dict[str, Variable]:
    """Return how near each member comes to the bound of Theorem 1, and its mu."""
    return {
        "member_mu": Variable(("member",), [float(mu)] * len(drawn),
                              "small parameter mu of the member"),
        "over_theorem_1": Variable(("member",), [over_theorem_1(one, mu) for one in drawn],
                                   "largest P of the member over its bound C of Theorem 1"),
    }  # fmt: skip


def _bounds(problems: Mapping[str, Problem], runs: Sequence[Trajectory]) -> dict[str, Variable]:
    """Return what the theorems allow P = |A|^2 + |B|^2 by the data, by case."""
    pairs = [(float(run.energy[0]), one) for run, one in zip(runs, problems.values(), strict=True)]
    return {
        "theorem_1_power": Variable(
            ("case",), [float(theorem_1_bound(h, one.constants)) for h, one in pairs],
            "bound C of P by Theorem 1, infinite where it says nothing"),
        "theorem_3_power": Variable(
            ("case",), [float(theorem_3_bound(h, one.sites, one.constants)) for h, one in pairs],
            "bound C_N of P by Theorem 3"),
    }  # fmt: skip
