"""Seeded ensembles of sweeps: many runs at each half-width, from slightly perturbed data.

Where the motion is chaotic one run is one draw; what another computer would draw as well is the
distribution.
"""

from collections.abc import Mapping, Sequence

import numpy as np
import xarray as xr
from latticode.datasets.netcdf import as_xarray
from latticode.datasets.registry import NAMES
from latticode.measures.levels import moments
from latticode.simulation.ensembles import draw_members
from latticode.simulation.problem import name_window
from latticode.simulation.runs import ManyRuns
from latticode.simulation.simulate import simulate
from latticode.simulation.sweep import QUANTITIES, STATISTICS, windowed
from replication.variables import CHAOTIC, FEW_CHOICES, SCATTERED, missing

from pendula.many_cases import describe_cases
from pendula.problem import Problem, by_name

NORMS = ("l2", "linf")
READINGS = {"text": "max", "caption": "mean"}
"""What the text of the paper says that its figures show, and what their captions say."""
MOMENTS = {
    "mean": "ensemble mean",
    "deviation": "standard deviation over the ensemble",
    "error": "standard error of the ensemble mean",
}


def draw_swept(
    problem: Problem, half_widths, size: float, members: int, seed: int
) -> list[Problem]:
    """Return the members of a sweep, all of one half-width and then of the next.

    Each half-width has draws of its own. The same data would give the same motion on all chains
    that are too long for the front, so that their means would not be independent of each other.
    """
    own = [(problem.changed(half_width=width), [seed, width]) for width in half_widths]
    return [m for one, seeds in own for m in draw_members(one, size, members, seeds)]


def read_norms(problem: Problem, windows) -> dict[str, np.ndarray]:
    """Return both READINGS of the pair's norms of a run, each over its own of the `windows`."""
    found, pair = windowed(simulate(problem, energy=False), windows), QUANTITIES.index("pair")
    places = [STATISTICS.index(statistic) for statistic in READINGS.values()]
    return {norm: found[norm][pair, places, range(len(places))] for norm in NORMS}


def measure_ensembles(swept: Mapping[str, Mapping], size: float, seed: int) -> ManyRuns:
    """Return the runs that give the moments of the norms of sweeps.

    They are NaN at half-widths that another sweep has alone.

    `swept` gives by sweep its problem as plain values, half-widths, members at each of them, and
    the windows of the READINGS.
    """
    own = by_name({name: one["problem"] for name, one in swept.items()})
    windows = {
        member: one["windows"]
        for name, one in swept.items()
        for member in draw_swept(own[name], one["half_widths"], size, one["members"], seed)
    }
    return ManyRuns(
        list(windows),
        lambda one: read_norms(one, windows[one]),
        lambda norms: _ensembles_of(norms, own, swept).assign_attrs(perturbation=size),
    )


def _ensembles_of(
    found: Mapping[str, np.ndarray], own: Mapping[str, Problem], swept: Mapping[str, Mapping]
) -> xr.Dataset:
    """Return the dataset of the norms of all runs, sweep by sweep."""
    done, parts = 0, []
    for one in swept.values():
        shape = len(one["half_widths"]), one["members"]
        kept = slice(done, done := done + shape[0] * shape[1])
        parts.append(_moments({norm: found[norm][kept].reshape(*shape, -1) for norm in NORMS}, one))
    described = as_xarray(*describe_cases(own)).rename(case="sweep")
    described["sweep"].attrs["long_name"] = NAMES["sweep"]
    data = xr.merge([described, xr.concat(parts, described["sweep"], join="outer")])
    title = "Ensembles of the chaotic sweeps, from almost equal data"
    return data.assign_attrs({**described.attrs, "title": title})


def measure_second_solver(
    first: Mapping,
    second: Sequence[Mapping],
    half_widths: Sequence[int],
    windows: Sequence[tuple[float, float]],
    size: float,
    members: int,
    first_members: int,
    seed: int,
) -> ManyRuns:
    """Return the runs by the paper's second solver that give the maxima of l2 over a window.

    `second` are its problems, which differ in the step, and `first` is that by the solver of the
    ensembles, as plain values. Each has draws of its own at each half-width: `members` of each of
    `second`, and `first_members` of `first`.
    """
    sizes = [first_members, *(members for _ in second)]
    drawn = [
        draw_swept(Problem.of(problem), half_widths, size, count, seed + number)
        for number, (problem, count) in enumerate(zip([first, *second], sizes, strict=True))
    ]
    about = {"perturbation": size, "seed": seed, "window": name_window(windows[0])}

    def conclude(norms: Mapping[str, np.ndarray]) -> xr.Dataset:
        values = np.split(norms["l2"][:, 0], np.cumsum([len(part) for part in drawn])[:-1])
        data = _second_solver_of(values, half_widths, second)
        _, shared = describe_cases({"sweep": Problem.of(first)})
        title = "A chaotic sweep by the paper's second solver, from almost equal data"
        return data.assign_attrs({**shared, **about, "title": title, **CHAOTIC})

    return ManyRuns(
        [member for part in drawn for member in part],
        lambda one: read_norms(one, windows),
        conclude,
    )


def _second_solver_of(
    values: Sequence[np.ndarray], half_widths: Sequence[int], second: Sequence[Mapping]
) -> xr.Dataset:
    """Return the maxima of l2 by both solvers, from those of the runs of each problem."""
    of_first, *of_second = (part.reshape(len(half_widths), -1) for part in values)
    says = f"{NAMES['l2']} of the pair, largest over the window"
    steps = [problem["solver"]["step"] for problem in second]
    return xr.Dataset(
        {
            "first_l2": (("half_width", "first_member"), of_first, {"long_name": says}),
            "l2": (
                ("solver_step", "half_width", "member"),
                np.array(of_second),
                {"long_name": f"{says}, by the second solver"},
            ),
        },
        {
            "half_width": ("half_width", list(half_widths), {"long_name": NAMES["half_width"]}),
            "solver_step": (
                "solver_step",
                steps,
                {"long_name": "step of the second solver", **FEW_CHOICES},
            ),
        },
    )


def _moments(norms: Mapping[str, np.ndarray], about: Mapping) -> xr.Dataset:
    """Return the MOMENTS of the norms (half-width, member, reading) of one sweep."""
    data = xr.Dataset(coords={"reading": list(READINGS), "half_width": about["half_widths"]})
    for norm, values in norms.items():
        for key, moment in moments(values.swapaxes(0, 1)).items():
            attributes = {
                "long_name": f"{MOMENTS[key]} of the {NAMES[norm]} of the pair",
                **missing("no run has this half-width"),
                **(SCATTERED if key != "mean" else {}),
            }
            data[f"{norm}_{key}"] = ("half_width", "reading"), moment, attributes
    says = {"long_name": "members at each half-width"}
    return data.assign(swept_members=((), about["members"], says))
