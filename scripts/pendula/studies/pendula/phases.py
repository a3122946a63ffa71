"""The cases of the paper as pendula: norms, where they move, and their angles to look at.

Large data at a large mu start near the top of their swing. Their pendula are chaotic, so that the
largest P of one run is an accident of its rounding: that of an ensemble is compared with Theorem 1.
"""

from collections.abc import Mapping, Sequence

import numpy as np

from pendula.datasets.netcdf import Variable
from pendula.datasets.trajectories import COMPONENTS, Contents, describe_cases, side_by_side
from pendula.models.bounds import theorem_1_bound, theorem_3_bound
from pendula.models.pendula import frequency
from pendula.problem import Problem
from pendula.simulation.ensembles import draw_members
from pendula.simulation.simulate import simulate

from .runs import LIMIT, NOT_KNOWN, at_mu, envelopes, period_of

HALF_TURN = 127
"""Half a turn in steps of the film: no picture shows smaller ones, and a step fits into a byte."""


def norms_of(moduli: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return l2 and l-infinity over the sites of moduli (component, site, time)."""
    return np.sqrt((moduli * moduli).sum(axis=1)), moduli.max(axis=1)


def over_theorem_1(problem: Problem, mu: float) -> float:
    """Return the largest known P of the envelopes at mu, over what Theorem 1 allows by the data."""
    energy = simulate(problem.changed(end_time=problem.output_step)).energy[0]
    l2, _ = norms_of(envelopes(at_mu(problem, mu))[1])
    return float(np.nanmax((l2 * l2).sum(axis=0)) / theorem_1_bound(energy, problem.constants))


def measure_phases(
    problems: Mapping[str, Problem], mus: Sequence[float], look_every: int,
    case: str, size: float, members: int, seed: int,
) -> Contents:  # fmt: skip
    """Return norms of the envelopes of all cases at mu = 0, which is (4), and at each of `mus`.

    All cases end at one time, and norms are NaN once a pendulum is lost (runs.until_lost). The
    sites are those of the longest chain. The larger envelope of each pair is kept at every
    `look_every`-th output. So many members of one case, whose data are changed by `size`
    relatively, are compared with Theorem 1 at the largest of `mus`.
    """
    every = [LIMIT, *mus]
    found = [[envelopes(at_mu(one, mu)) for mu in every] for one in problems.values()]
    tau = found[0][0][0].tau
    norms = np.array([[norms_of(moduli) for _, moduli in row] for row in found])
    looks = side_by_side(
        [np.stack([moduli.max(axis=0)[:, ::look_every] for _, moduli in row]) for row in found], 1
    )
    reach = looks.shape[2] // 2
    starts = [(float(row[0][0].energy[0]), one)
              for row, one in zip(found, problems.values(), strict=True)]  # fmt: skip
    drawn = draw_members(problems[case], size, members, seed)
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
        "theorem_1_power": Variable(
            ("case",), [float(theorem_1_bound(h, one.constants)) for h, one in starts],
            "bound C of P by Theorem 1, infinite where it says nothing"),
        "theorem_3_power": Variable(
            ("case",), [float(theorem_3_bound(h, one.sites, one.constants)) for h, one in starts],
            "bound C_N of P by Theorem 3"),
        "member_mu": Variable(("member",), [float(max(mus))] * len(drawn),
                              "small parameter mu of the member"),
        "over_theorem_1": Variable(("member",), [over_theorem_1(one, max(mus)) for one in drawn],
                                   "largest P of the member over its bound C of Theorem 1"),
    }  # fmt: skip
    about = {"perturbed_case": case, "perturbation": size, "members": members, "seed": seed}
    about |= {"comment": NOT_KNOWN} if np.isnan(norms).any() else {}
    title = "The cases of the paper as pendula: norms of the amplitudes got back from angles and"
    return variables, {**shared, **about, "title": f"{title} velocities; mu = 0 stands for (4)"}


# --- Pendula to look at --------------------------------------------------------------------------


def filmed(problem: Problem, reach: int, periods: int, per_period: int) -> np.ndarray:
    """Return the angles on the sites -reach..reach in steps, (picture, component, site).

    Whole turns are left out, since no picture shows them.
    """
    period = period_of(problem)
    length = {"end_time": periods * period, "output_step": period / per_period}
    angles = simulate(problem.changed(snapshot_every=1, **length)).snapshots[0]
    centre = angles.shape[1] // 2
    angles = angles[:, centre - reach : centre + reach + 1]
    angles = angles - 2.0 * np.pi * np.rint(angles / (2.0 * np.pi))
    return np.rint(angles * (HALF_TURN / np.pi)).astype(np.int8).transpose(2, 0, 1)


def film_pendula(
    problems: Mapping[str, Problem], reach: int, periods: int, per_period: int
) -> Contents:
    """Return films of the middle of chains of pendula at one mu, over as many periods each."""
    given = list(problems.values())
    reach = min(reach, *(one.half_width for one in given))
    angles = np.array([filmed(one, reach, periods, per_period) for one in given])
    own = [frequency(one.constants.omega, one.mu) for one in given]
    described, shared = describe_cases(problems)
    about = {"title": "A film of the pendula", "mu": given[0].mu}
    about |= {"per_period": per_period, "half_turn": HALF_TURN}
    return {
        **described,
        "site": Variable(("site",), np.arange(-reach, reach + 1)),
        "component": Variable(("component",), ["x", "y"]),
        "period": Variable(("picture",), np.arange(angles.shape[1]) / per_period,
                           "number of periods 2 pi / omega since the start"),
        "tau_of_period": Variable(("case",), [period_of(one) for one in given],
                                  "slow time in a period 2 pi / omega"),
        "pendulum_frequency": Variable(("case",), own, "angular frequency omega of equation (2)"),
        "angle_step": Variable(("case", "picture", "component", "site"), angles,
                               f"angle in steps; half a turn has {HALF_TURN} steps"),
    }, {**shared, **about}  # fmt: skip
