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
from latticode.simulation.runs import Run, run_all
from latticode.simulation.simulate import simulate
from latticode.simulation.sweep import QUANTITIES, STATISTICS, pair_l2, pair_linf, windowed

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


def draw_swept(
    problem: Problem, half_widths, size: float, members: int, seed: int, kind: str
) -> list[Problem]:
    """Return the members of a sweep, all of one half-width and then of the next.

    Each half-width has draws of its own. The same data would give the same motion on all chains
    that are too long for the front, so that their means would not be independent of each other.
    """
    own = [(problem.changed(half_width=width), [seed, width]) for width in half_widths]
    return [m for one, seeds in own for m in draw_members(one, size, members, seeds, kind)]


def run_ensembles(
    cases: list[Problem], swept: list[Problem], windows, run: Run
) -> tuple[dict[str, np.ndarray], dict[str, np.ndarray]]:
    """Return the norms l2 and l-infinity of cases, (run, quantity, time), and of sweeps.

    Those of sweeps are statistics over windows, (run, quantity, statistic, window).
    """
    whole, shape = set(cases), (len(QUANTITIES), len(STATISTICS), len(windows))

    def make(problem: Problem) -> dict[str, np.ndarray]:
        made = simulate(problem, energy=False)
        if problem in whole:
            return {name: norm(made) for name, norm in NORMS.items()}
        found = windowed(made, windows)
        return {name: found[name].reshape(shape[0], -1) for name in NORMS}

    found, first, size = run([*cases, *swept], make), len(cases), shape[1] * shape[2]
    return (
        {name: found[name][:first] for name in NORMS},
        {name: found[name][first:, :, :size].reshape(-1, *shape) for name in NORMS},
    )


def measure_ensembles(
    problems: dict[str, Problem], members: int, swept: Mapping[str, Mapping], windows,
    size: float, seed: int, kind: str, run: Run = run_all,
) -> Contents:  # fmt: skip
    """Return quantile bands of the norms of cases, which may be none, and the moments of sweeps.

    `swept` gives by sweep its problem as plain values, half-widths and members at each of them.
    """
    own = by_name({name: one["problem"] for name, one in swept.items()})
    shared, variables = describe_cases(own)[1], {}
    drawn = [m for one in problems.values() for m in draw_members(one, size, members, seed, kind)]
    drawn_swept = [
        member
        for name, one in swept.items()
        for member in draw_swept(own[name], one["half_widths"], size, one["members"], seed, kind)
    ]
    of_cases, of_sweeps = run_ensembles(drawn, drawn_swept, windows, run)
    if problems:
        variables, shared = describe_cases(problems)
        shared |= {"members": members, "band_share": QUANTILES[-1] - QUANTILES[0]}
        tau = next(iter(problems.values())).times
        variables["quantile"] = Variable(
            ("quantile",), np.array(QUANTILES), "quantile over the ensemble"
        )
        variables["quantity"] = Variable(("quantity",), list(QUANTITIES))
        variables["tau"] = Variable(("tau",), tau)
        for name, runs in of_cases.items():
            norms = runs.reshape(len(problems), members, *runs.shape[1:])
            variables[name] = Variable(
                ("case", "quantile", "quantity", "tau"),
                np.array([bands(norm, QUANTILES) for norm in norms]),
                f"{NAMES[name]}, quantiles over the ensemble",
            )
    about = {"ensemble": f"{kind} in n", "perturbation": size, "seed": seed}
    title = "Ensembles of the chaotic cases and sweeps, from almost equal data"
    variables |= sweep_moments(swept, windows, of_sweeps)
    return variables, {"title": title, **shared, **about}


def sweep_moments(
    swept: Mapping[str, Mapping], windows, found: Mapping[str, np.ndarray]
) -> dict[str, Variable]:
    """Return mean, deviation and standard error of every norm `found` of each sweep by name.

    They are NaN at the half-widths that another sweep has alone.
    """
    half_widths = sorted({width for one in swept.values() for width in one["half_widths"]})
    shape = (len(swept), len(half_widths), len(QUANTITIES), len(STATISTICS), len(windows))
    values = {(norm, key): np.full(shape, np.nan) for norm in NORMS for key in MOMENTS}
    done = 0
    for i, one in enumerate(swept.values()):
        row, members = np.searchsorted(half_widths, one["half_widths"]), one["members"]
        own = slice(done, done := done + row.size * members)
        for norm, runs in found.items():
            numbers = runs[own].reshape(row.size, members, *shape[2:]).swapaxes(0, 1)
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
