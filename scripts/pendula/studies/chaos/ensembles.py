"""Seeded ensembles: a case from slightly perturbed initial conditions, as many times as wanted.

Where the motion is chaotic one run is one draw; what a second solver, or another computer, would
draw as well is the distribution.
"""

from collections.abc import Mapping

import numpy as np
from latticode.datasets.netcdf import Variable
from latticode.datasets.registry import NAMES
from latticode.datasets.trajectories import Contents
from latticode.measures.levels import bands, moments
from latticode.simulation.ensembles import draw_members
from latticode.simulation.problem import name_window
from latticode.simulation.simulate import simulate
from latticode.simulation.sweep import QUANTITIES, STATISTICS, pair_l2, pair_linf, sweep

from pendula.many_cases import describe_cases
from pendula.problem import Problem, by_name

NORMS = {"l2": pair_l2, "linf": pair_linf}
QUANTILES = (0.05, 0.5, 0.95)
"""The ends of the band of an ensemble, and its middle."""
MOMENTS = {
    "mean": "ensemble mean",
    "deviation": "standard deviation over the ensemble",
    "error": "standard error of the ensemble mean",
}


def run_members(problem: Problem, size: float, members: int, seed: int, kind: str) -> np.ndarray:
    """Return the norms l2 and l-infinity of each member, (norm, member, quantity, time)."""
    drawn = draw_members(problem, size, members, seed, kind)
    runs = [simulate(member, energy=False) for member in drawn]
    return np.array([[norm(run) for run in runs] for norm in NORMS.values()])


def sweep_members(
    problem: Problem, half_widths, windows, size: float, members: int, seed: int, kind: str
) -> np.ndarray:
    """Return the swept l2 and l-infinity of each member, (norm, member, *shape of a Sweep).

    Each half-width has draws of its own. The same data would give the same motion on all chains
    that are too long for the front, so that their means would not be independent of each other.
    """
    columns = []
    for half_width in half_widths:
        drawn = draw_members(problem, size, members, [seed, half_width], kind)
        runs = [sweep(member, [half_width], windows) for member in drawn]
        columns.append([[getattr(run, norm) for run in runs] for norm in NORMS])
    return np.concatenate(columns, axis=2)


def measure_ensembles(
    problems: dict[str, Problem], members: int, swept: Mapping[str, Mapping], windows,
    size: float, seed: int, kind: str,
) -> Contents:  # fmt: skip
    """Return quantile bands of the norms of cases, which may be none, and the moments of sweeps.

    `swept` gives by sweep its problem as plain values, half-widths and members at each of them.
    """
    own = by_name({name: one["problem"] for name, one in swept.items()})
    shared, variables = describe_cases(own)[1], {}
    if problems:
        variables, shared = describe_cases(problems)
        shared |= {"members": members, "band_share": QUANTILES[-1] - QUANTILES[0]}
        drawn = [run_members(one, size, members, seed, kind) for one in problems.values()]
        tau = next(iter(problems.values())).times
        variables["quantile"] = Variable(
            ("quantile",), np.array(QUANTILES), "quantile over the ensemble"
        )
        variables["quantity"] = Variable(("quantity",), list(QUANTITIES))
        variables["tau"] = Variable(("tau",), tau)
        for name, norms in zip(NORMS, zip(*drawn, strict=True), strict=True):
            variables[name] = Variable(
                ("case", "quantile", "quantity", "tau"),
                np.array([bands(norm, QUANTILES) for norm in norms]),
                f"{NAMES[name]}, quantiles over the ensemble",
            )
    about = {"ensemble": f"{kind} in n", "perturbation": size, "seed": seed}
    title = "Ensembles of the chaotic cases and sweeps, from almost equal data"
    variables |= sweep_moments(own, swept, windows, size, seed, kind)
    return variables, {"title": title, **shared, **about}


def sweep_moments(
    problems: dict[str, Problem], swept: Mapping[str, Mapping], windows,
    size: float, seed: int, kind: str,
) -> dict[str, Variable]:  # fmt: skip
    """Return mean, deviation and standard error of every swept norm of each sweep by name.

    They are NaN at the half-widths that another sweep has alone.
    """
    half_widths = sorted({width for one in swept.values() for width in one["half_widths"]})
    shape = (len(swept), len(half_widths), len(QUANTITIES), len(STATISTICS), len(windows))
    values = {(norm, key): np.full(shape, np.nan) for norm in NORMS for key in MOMENTS}
    for i, (name, one) in enumerate(swept.items()):
        widths, members = one["half_widths"], one["members"]
        found = sweep_members(problems[name], widths, windows, size, members, seed, kind)
        row = np.searchsorted(half_widths, widths)
        for norm, numbers in zip(NORMS, found, strict=True):
            for key, moment in moments(numbers).items():
                values[norm, key][i, row] = moment
    grid = ("sweep", "half_width", "quantity", "statistic", "window")
    return {
        "sweep": Variable(("sweep",), list(swept)),
        "half_width": Variable(("half_width",), np.array(half_widths)),
        "quantity": Variable(("quantity",), list(QUANTITIES)),
        "statistic": Variable(("statistic",), list(STATISTICS)),
        "window": Variable(("window",), [name_window(window) for window in windows]),
        "swept_members": Variable(
            ("sweep",), [one["members"] for one in swept.values()], "members at each half-width"
        ),
        **{
            f"{norm}_{key}": Variable(grid, each, f"{MOMENTS[key]} of the {NAMES[norm]}; NaN: none")
            for (norm, key), each in values.items()
        },
    }
