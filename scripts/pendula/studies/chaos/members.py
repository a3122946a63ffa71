"""The members of ensembles of every case, each reduced to the numbers that sentences are about.

The paper's sentences on figures speak of levels, of growth, of how many pendula move. In a chaotic
case such a number differs from run to run, so that only an ensemble decides, by confidence limits.
Cases that are not chaotic have ensembles here too: what a sentence says of chaos must not hold for
them.
"""

import numpy as np

from pendula.datasets.netcdf import Variable
from pendula.datasets.trajectories import COMPONENTS, Contents, describe_cases, side_by_side
from pendula.measures.confidence import student
from pendula.measures.levels import correlation
from pendula.numerics.elementary import square_modulus
from pendula.problem import Problem, name_window
from pendula.simulation.ensembles import PERTURBATIONS, draw_members
from pendula.simulation.simulate import Trajectory, simulate
from pendula.simulation.sweep import QUANTITIES, pair_l2, pair_linf

PAIR = QUANTITIES.index("pair")
REDUCED = {
    "l2_level": (("quantity", "window"), "mean of the l2 norm over the time window"),
    "linf_level": (("quantity", "window"), "mean of the l-infinity norm over the time window"),
    "linf_peak": (("quantity", "window"), "maximum of the l-infinity norm over the time window"),
    "in_motion": (("window",), "mean of P over the squared l-infinity norm: pendula in motion"),
    "norm_correlation": (("window",), "correlation in time of the squared l2 norms of A and B"),
    "rms": (("window", "component", "site"), "root mean square of an amplitude over the window"),
}
"""What each member is reduced to: dimensions after kind, case and member, and in words."""

Window = tuple[float, float]


def reduce_run(run: Trajectory, windows: list[Window], every: int) -> dict[str, np.ndarray]:
    """Return the numbers REDUCED of a run that kept the moduli at each `every`-th output time."""
    inside = [(run.tau >= start) & (run.tau <= end) for start, end in windows]
    l2, linf = pair_l2(run), pair_linf(run)
    ratio, squares = (l2[PAIR] / linf[PAIR]) ** 2, run.modulus**2
    return {
        "l2_level": np.stack([l2[:, kept].mean(axis=1) for kept in inside], axis=-1),
        "linf_level": np.stack([linf[:, kept].mean(axis=1) for kept in inside], axis=-1),
        "linf_peak": np.stack([linf[:, kept].max(axis=1) for kept in inside], axis=-1),
        "in_motion": np.array([ratio[kept].mean() for kept in inside]),
        "norm_correlation": np.array([correlation(*run.l2[:, kept] ** 2) for kept in inside]),
        "rms": np.sqrt([squares[..., kept[::every]].mean(axis=-1) for kept in inside]),
    }


Spread = tuple[float, float]
"""The variance over the members, averaged over time, and its relative standard error."""


def measure_spread(values: np.ndarray) -> Spread:
    """Return the spread of (member, time) over the members, three at least.

    Its error is that of the jackknife over the members, which are independent of each other while
    the times are not.
    """
    count = len(values)
    squares = ((values - values.mean(axis=0)) ** 2).mean(axis=1)
    whole = squares.sum()
    without = (whole - count / (count - 1) * squares) / (count - 2)
    error = np.sqrt((count - 1) * ((without - without.mean()) ** 2).mean())
    variance = whole / (count - 1)
    return float(variance), float(error / variance) if variance else 0.0


def width_ratio(even: Spread, uneven: Spread, members: int) -> tuple[float, float, float]:
    """Return the width of even ensembles over that of uneven ones, and its confidence limits."""
    ratio = np.sqrt(even[0] / uneven[0])
    error = np.sqrt(even[1] * even[1] + uneven[1] * uneven[1])
    off = student(members - 1) * 0.5 * error
    return ratio, ratio * (1.0 - off), ratio * (1.0 + off)


def measure_case(problem: Problem, windows, size: float, members: int, seed: int, kind: str):
    """Return (numbers REDUCED by name with members first, spread and mean of the pair's l2).

    Spread and mean are those of the last of the `windows`.
    """
    drawn = draw_members(problem, size, members, seed, kind)
    runs = [simulate(member, energy=False) for member in drawn]
    reduced = [reduce_run(run, windows, problem.snapshot_every) for run in runs]
    start, end = windows[-1]
    last = (runs[0].tau >= start) & (runs[0].tau <= end)
    late = np.array([pair_l2(run)[PAIR, last] for run in runs])
    stacked = {name: np.array([one[name] for one in reduced]) for name in REDUCED}
    return stacked, measure_spread(late), late.mean()


def member_numbers(
    problems: dict[str, Problem], windows: list[Window], size: float, members: int, seed: int
) -> Contents:
    """Return what REDUCED names of each member of both kinds of each case, and the bands' widths.

    `problems` are given by case, and keep moduli; the sites are those of the longest chain.
    """
    kinds, reach = list(PERTURBATIONS), max(one.half_width for one in problems.values())
    found = [
        [measure_case(one, windows, size, members, seed, kind) for one in problems.values()]
        for kind in kinds
    ]
    widths = [[np.sqrt(variance) / mean for _, (variance, _), mean in row] for row in found]
    pairs = zip(*[[spread for _, spread, _ in row] for row in found], strict=True)
    ratio, low, high = np.array([width_ratio(*pair, members) for pair in pairs]).T
    squares = [square_modulus(problem.initial) for problem in problems.values()]
    l2, linf = (np.sqrt([reduce(one) for one in squares]) for reduce in (np.sum, np.max))
    width = "standard deviation of the pair's l2 norm over the members, relative to its mean"
    over = "width of the even ensemble over that of the uneven one"
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
        "relative_width": Variable(("kind", "case"), widths, width),
        "width_ratio": Variable(("case",), ratio, over),
        "width_ratio_low": Variable(("case",), low, f"{over}, lower limit"),
        "width_ratio_high": Variable(("case",), high, f"{over}, upper limit"),
    }
    for name, (rest, long_name) in REDUCED.items():
        rows = [[stacked[name] for stacked, *_ in row] for row in found]
        if name == "rms":
            values = np.stack([side_by_side(row, -1) for row in rows]).astype(np.float32)
        else:
            values = np.array(rows)
        variables[name] = Variable(("kind", "case", "member", *rest), values, long_name)
    title = "Members of ensembles of every case, from almost equal data"
    about = {"perturbation": size, "members": members, "seed": seed}
    return variables, {"title": title, **shared, **about}
