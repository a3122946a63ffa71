"""Ensembles of every case: bands of the norms, and numbers of each member that decide claims.

The paper makes statements on levels, on growth, and on the number of pendula that move. In a
chaotic case such a number differs from run to run, and only an ensemble decides, by confidence
limits. Regular cases are negative controls: a statement about chaos must not hold for them.
"""

from functools import partial

import numpy as np
from latticode.datasets.netcdf import Variable
from latticode.datasets.registry import NAMES
from latticode.datasets.trajectories import Contents
from latticode.equations.ensembles import draw_members
from latticode.equations.initial_values import name_window
from latticode.measures.levels import bands, correlation
from latticode.numerics.elementary import square_modulus
from latticode.simulation.runs import ManyRuns, reshape_runs
from latticode.simulation.simulate import simulate
from latticode.simulation.sweep import QUANTITIES, pair_l2, pair_linf
from replication.variables import REGULAR, SCATTERED, missing

from pendula.many_cases import COMPONENTS, describe_cases
from pendula.problem import PaperProblem

PAIR = QUANTITIES.index("pair")
QUANTILES = (0.1, 0.5, 0.9)
"""The quantiles of the band of an ensemble: lower end, median, upper end."""
REDUCED = {
    "l2_level": (("quantity", "window"), "mean of the l2 norm over the time window"),
    "linf_level": (("quantity", "window"), "mean of the l-infinity norm over the time window"),
    "norm_correlation": (("window",), "correlation in time of the squared l2 norms of A and B"),
    "rms": (("window", "component", "site"), "root mean square of an amplitude over the window"),
}
"""Numbers of each member: their dimensions after (case, member), and their long names."""
ATTRIBUTES = {"norm_correlation": SCATTERED, "rms": missing("the chain has no such site")}

Window = tuple[float, float]


def reduce_run(problem: PaperProblem, windows: list[Window], reach: int) -> dict[str, np.ndarray]:
    """Return the norms of a run, (quantity, time), and the numbers REDUCED.

    The problem must store all moduli, which are padded with NaN to the sites -reach..reach.
    """
    run = simulate(problem, conserved=False)
    inside = [(run.tau >= start) & (run.tau <= end) for start, end in windows]
    l2, linf, squares = pair_l2(run), pair_linf(run), run.modulus**2
    rms = np.sqrt([squares[..., window].mean(axis=-1) for window in inside])
    beyond = (reach - problem.half_width,) * 2
    return {
        "l2": l2,
        "linf": linf,
        "l2_level": np.stack([l2[:, window].mean(axis=1) for window in inside], axis=-1),
        "linf_level": np.stack([linf[:, window].mean(axis=1) for window in inside], axis=-1),
        "norm_correlation": np.array([correlation(*run.l2[:, window] ** 2) for window in inside]),
        "rms": np.pad(rms, ((0, 0), (0, 0), beyond), constant_values=np.nan),
    }


def relative_width(late: np.ndarray) -> float:
    """Return the standard deviation over members of series (member, time), relative to the mean."""
    return np.sqrt(late.var(axis=0, ddof=1).mean()) / late.mean()


def measure_members(
    problems: dict[str, PaperProblem], windows: list[Window], size: float, members: int, seed: int
) -> ManyRuns:
    """Return the runs of all members of each case, for the dataset of bands and of REDUCED.

    `problems` maps each case to its problem, which stores all moduli. The dataset has the sites of
    the longest chain.
    """
    reach = max(problem.half_width for problem in problems.values())
    drawn = [m for problem in problems.values() for m in draw_members(problem, size, members, seed)]
    attributes_of_study = {"perturbation": size, "members": members, "seed": seed}

    def conclude(retained: dict[str, np.ndarray]) -> Contents:
        numbers = reshape_runs(retained, (len(problems), members))
        variables, attributes = _members_contents(problems, windows, reach, numbers)
        return variables, {
            **attributes,
            **attributes_of_study,
            "band_share": QUANTILES[-1] - QUANTILES[0],
        }

    return ManyRuns(drawn, partial(reduce_run, windows=windows, reach=reach), conclude)


def _members_contents(
    problems: dict[str, PaperProblem],
    windows: list[Window],
    reach: int,
    numbers: dict[str, np.ndarray],
) -> Contents:
    """Return the dataset of the results of `reduce_run`, each (case, member, ...)."""
    tau = next(iter(problems.values())).times
    squares = [square_modulus(problem.initial) for problem in problems.values()]
    l2, linf = (np.sqrt([reduce(square) for square in squares]) for reduce in (np.sum, np.max))
    late = numbers["l2"][:, :, PAIR, tau >= windows[-1][0]]
    width = "standard deviation of the pair's l2 norm over the members, relative to its mean"
    described, shared = describe_cases(problems)
    variables = {
        **described,
        "tau": Variable(("tau",), tau),
        "quantile": Variable(("quantile",), np.array(QUANTILES), "quantile over the ensemble"),
        "quantity": Variable(("quantity",), list(QUANTITIES)),
        "window": Variable(("window",), [name_window(window) for window in windows]),
        "component": COMPONENTS,
        "site": Variable(("site",), np.arange(-reach, reach + 1)),
        "l2_start": Variable(("case",), l2, "initial l2 norm of the pair", attributes=REGULAR),
        "linf_start": Variable(("case",), linf, "initial l-infinity norm", attributes=REGULAR),
        "relative_width": Variable(
            ("case",), list(map(relative_width, late)), width, attributes=SCATTERED
        ),
    }
    for name in ("l2", "linf"):
        variables[name] = Variable(
            ("case", "quantile", "component", "tau"),
            np.array([bands(runs[:, :PAIR], QUANTILES) for runs in numbers[name]]),
            f"{NAMES[name]}, quantiles over the ensemble",
        )
    for name, (dimensions, long_name) in REDUCED.items():
        values = numbers[name].astype(np.float32) if name == "rms" else numbers[name]
        attributes = ATTRIBUTES.get(name, {})
        variables[name] = Variable(
            ("case", "member", *dimensions), values, long_name, attributes=attributes
        )
    title = "Ensembles of every case, from slightly perturbed data"
    return variables, {"title": title, **shared}
