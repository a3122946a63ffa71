"""The members of ensembles of every case, each reduced to the numbers that sentences are about.

The paper's sentences on figures speak of levels, of growth, of how many pendula move. In a chaotic
case such a number differs from run to run, so that only an ensemble decides, by confidence limits.
Cases that are not chaotic have ensembles here too: what a sentence says of chaos must not hold for
them.
"""

import numpy as np
from latticode.datasets.netcdf import Variable
from latticode.datasets.trajectories import Contents, side_by_side
from latticode.measures.levels import correlation
from latticode.numerics.elementary import square_modulus
from latticode.simulation.ensembles import PERTURBATIONS, draw_members
from latticode.simulation.problem import name_window
from latticode.simulation.simulate import Trajectory, simulate
from latticode.simulation.sweep import QUANTITIES, pair_l2, pair_linf

from pendula.many_cases import COMPONENTS, describe_cases
from pendula.problem import Problem

PAIR = QUANTITIES.index("pair")
REDUCED = {
    "l2_level": (("quantity", "window"), "mean of the l2 norm over the time window"),
    "linf_level": (("quantity", "window"), "mean of the l-infinity norm over the time window"),
    "norm_correlation": (("window",), "correlation in time of the squared l2 norms of A and B"),
    "rms": (
        ("window", "component", "site"),
        "root mean square of an amplitude over the window; NaN: no site",
    ),
}
"""What each member is reduced to: dimensions after kind, case and member, and in words."""

Window = tuple[float, float]


def reduce_run(run: Trajectory, windows: list[Window], every: int) -> dict[str, np.ndarray]:
    """Return the numbers REDUCED of a run that kept the moduli at each `every`-th output time."""
    inside = [(run.tau >= start) & (run.tau <= end) for start, end in windows]
    l2, linf = pair_l2(run), pair_linf(run)
    squares = run.modulus**2
    return {
        "l2_level": np.stack([l2[:, kept].mean(axis=1) for kept in inside], axis=-1),
        "linf_level": np.stack([linf[:, kept].mean(axis=1) for kept in inside], axis=-1),
        "norm_correlation": np.array([correlation(*run.l2[:, kept] ** 2) for kept in inside]),
        "rms": np.sqrt([squares[..., kept[::every]].mean(axis=-1) for kept in inside]),
    }


def measure_case(problem: Problem, windows, size: float, members: int, seed: int, kind: str):
    """Return the numbers REDUCED by name, with members first, and the width of the pair's l2 norm.

    This is the deviation over the members in the last of the `windows`, relative to the mean.
    """
    drawn = draw_members(problem, size, members, seed, kind)
    runs = [simulate(member, energy=False) for member in drawn]
    reduced = [reduce_run(run, windows, problem.snapshot_every) for run in runs]
    start, end = windows[-1]
    last = (runs[0].tau >= start) & (runs[0].tau <= end)
    late = np.array([pair_l2(run)[PAIR, last] for run in runs])
    stacked = {name: np.array([one[name] for one in reduced]) for name in REDUCED}
    return stacked, np.sqrt(late.var(axis=0, ddof=1).mean()) / late.mean()


def member_numbers(
    problems: dict[str, Problem], windows: list[Window], size: float, members: int, seed: int
) -> Contents:
    """Return what REDUCED names of each member of both kinds of each case, and relative widths.

    `problems` are given by case, and keep moduli; the sites are those of the longest chain.
    """
    kinds, reach = list(PERTURBATIONS), max(one.half_width for one in problems.values())
    found = [
        [measure_case(one, windows, size, members, seed, kind) for one in problems.values()]
        for kind in kinds
    ]
    squares = [square_modulus(problem.initial) for problem in problems.values()]
    l2, linf = (np.sqrt([reduce(one) for one in squares]) for reduce in (np.sum, np.max))
    width = "standard deviation of the pair's l2 norm over the members, relative to its mean"
    described, shared = describe_cases(problems)
    variables = {
        **described,
        "kind": Variable(("kind",), kinds, "kind of the ensemble: runs even in n, or not"),
        "quantity": Variable(("quantity",), list(QUANTITIES)),
        "window": Variable(("window",), [name_window(window) for window in windows]),
        "component": COMPONENTS,
        "site": Variable(("site",), np.arange(-reach, reach + 1)),
        "l2_start": Variable(("case",), l2, "l2 norm of the data, of the pair"),
        "linf_start": Variable(("case",), linf, "l-infinity norm of the data"),
        "relative_width": Variable(
            ("kind", "case"), [[one for _, one in row] for row in found], width
        ),
    }
    for name, (rest, long_name) in REDUCED.items():
        rows = [[stacked[name] for stacked, _ in row] for row in found]
        if name == "rms":
            values = np.stack([side_by_side(row, -1) for row in rows]).astype(np.float32)
        else:
            values = np.array(rows)
        variables[name] = Variable(("kind", "case", "member", *rest), values, long_name)
    title = "Members of ensembles of every case, from almost equal data"
    about = {"perturbation": size, "members": members, "seed": seed}
    return variables, {"title": title, **shared, **about}
