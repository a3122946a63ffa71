"""The members of ensembles of every case, each reduced to the numbers that sentences are about.

The paper's sentences on figures speak of levels, of growth, of how many pendula move. In a chaotic
case such a number differs from run to run, so that only an ensemble decides, by confidence limits.
Cases that are not chaotic have ensembles here too: what a sentence says of chaos must not hold for
them.
"""

from functools import partial
from itertools import product

import numpy as np
from latticode.datasets.netcdf import Variable
from latticode.datasets.trajectories import Contents
from latticode.measures.levels import correlation
from latticode.numerics.elementary import square_modulus
from latticode.simulation.ensembles import PERTURBATIONS, draw_members
from latticode.simulation.problem import name_window
from latticode.simulation.runs import Run, run_all, shaped
from latticode.simulation.simulate import simulate
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


def reduce_run(problem: Problem, windows: list[Window], reach: int) -> dict[str, np.ndarray]:
    """Run a problem that keeps moduli; return the numbers REDUCED, of the sites up to `reach`.

    With them comes the pair's l2 norm in the last window, "late".
    """
    run = simulate(problem, energy=False)
    inside = [(run.tau >= start) & (run.tau <= end) for start, end in windows]
    l2, linf = pair_l2(run), pair_linf(run)
    squares, every = run.modulus**2, problem.snapshot_every
    rms = np.sqrt([squares[..., kept[::every]].mean(axis=-1) for kept in inside])
    beyond = (reach - problem.half_width,) * 2
    return {
        "l2_level": np.stack([l2[:, kept].mean(axis=1) for kept in inside], axis=-1),
        "linf_level": np.stack([linf[:, kept].mean(axis=1) for kept in inside], axis=-1),
        "norm_correlation": np.array([correlation(*run.l2[:, kept] ** 2) for kept in inside]),
        "rms": np.pad(rms, ((0, 0), (0, 0), beyond), constant_values=np.nan),
        "late": l2[PAIR, inside[-1]],
    }


def relative_width(late: np.ndarray) -> float:
    """Return the deviation over members of series (member, time), relative to their mean."""
    return np.sqrt(late.var(axis=0, ddof=1).mean()) / late.mean()


def member_numbers(
    problems: dict[str, Problem], windows: list[Window], size: float, members: int, seed: int,
    run: Run = run_all,
) -> Contents:  # fmt: skip
    """Return what REDUCED names of each member of both kinds of each case, and relative widths.

    `problems` are given by case, and keep moduli; the sites are those of the longest chain.
    """
    kinds, reach = list(PERTURBATIONS), max(one.half_width for one in problems.values())
    drawn = [
        member
        for kind, one in product(kinds, problems.values())
        for member in draw_members(one, size, members, seed, kind)
    ]
    found = run(drawn, partial(reduce_run, windows=windows, reach=reach))
    found = shaped(found, (len(kinds), len(problems), members))
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
            ("kind", "case"), [list(map(relative_width, row)) for row in found["late"]], width
        ),
    }
    for name, (rest, long_name) in REDUCED.items():
        values = found[name].astype(np.float32) if name == "rms" else found[name]
        variables[name] = Variable(("kind", "case", "member", *rest), values, long_name)
    title = "Members of ensembles of every case, from almost equal data"
    about = {"perturbation": size, "members": members, "seed": seed}
    return variables, {"title": title, **shared, **about}
