"""Seeded ensembles of sweeps: many runs at each half-width, from slightly perturbed data.

A single run of a chaotic case is a random sample: another computer reproduces the distribution.
"""

from collections.abc import Mapping, Sequence

import numpy as np
import xarray as xr
from latticode.datasets.netcdf import as_xarray
from latticode.datasets.registry import NAMES
from latticode.equations.ensembles import draw_members
from latticode.equations.initial_values import name_window
from latticode.measures.levels import moments
from latticode.simulation.runs import ManyRuns
from latticode.simulation.simulate import simulate
from latticode.simulation.sweep import QUANTITIES, STATISTICS, windowed
from replication.variables import CHAOTIC, FEW_CHOICES, SCATTERED, missing

from pendula.many_cases import describe_cases
from pendula.problem import PaperProblem, by_name

NORMS = ("l2", "linf")
READINGS = {"text": "max", "caption": "mean"}
"""The statistic that the figures show, by the paper's text and by its captions."""
MOMENTS = {
    "mean": "ensemble mean",
    "deviation": "standard deviation over the ensemble",
    "error": "standard error of the ensemble mean",
}


def draw_swept(
    problem: PaperProblem, half_widths: Sequence[int], size: float, members: int, seed: int
) -> list[PaperProblem]:
    """Return the members of a sweep, ordered by half-width.

    Each half-width has its own draws. With equal draws the motion would be the same on all chains
    with ends that the front does not reach, and the means would not be independent.
    """
    chains = [(problem.changed(half_width=width), [seed, width]) for width in half_widths]
    return [m for chain, seeds in chains for m in draw_members(chain, size, members, seeds)]


def read_norms(
    problem: PaperProblem, windows: Sequence[tuple[float, float]]
) -> dict[str, np.ndarray]:
    """Return each norm of the pair in a run by name, reduced to both READINGS, (reading,)."""
    norms, pair = windowed(simulate(problem, conserved=False), windows), QUANTITIES.index("pair")
    places = [STATISTICS.index(statistic) for statistic in READINGS.values()]
    return {name: norms[name][pair, places, range(len(places))] for name in NORMS}


def measure_ensembles(swept: Mapping[str, Mapping], size: float, seed: int) -> ManyRuns:
    """Return the runs of all sweeps, for the dataset of moments of their norms.

    `swept` maps each sweep to its problem as plain values, half-widths, number of members at each,
    and windows of the READINGS. Moments are NaN at half-widths that only other sweeps have.
    """
    problem_of = by_name({name: sweep["problem"] for name, sweep in swept.items()})
    windows = {
        member: sweep["windows"]
        for name, sweep in swept.items()
        for member in draw_swept(
            problem_of[name], sweep["half_widths"], size, sweep["members"], seed
        )
    }
    return ManyRuns(
        list(windows),
        lambda member: read_norms(member, windows[member]),
        lambda norms: _ensembles_dataset(norms, problem_of, swept).assign_attrs(perturbation=size),
    )


def _ensembles_dataset(
    norms: Mapping[str, np.ndarray],
    problem_of: Mapping[str, PaperProblem],
    swept: Mapping[str, Mapping],
) -> xr.Dataset:
    """Return the dataset of the moments of the norms of all runs, sweep by sweep."""
    done, moments_by_sweep = 0, []
    for sweep in swept.values():
        shape = len(sweep["half_widths"]), sweep["members"]
        runs = slice(done, done := done + shape[0] * shape[1])
        moments_by_sweep.append(
            _moments({norm: norms[norm][runs].reshape(*shape, -1) for norm in NORMS}, sweep)
        )
    described = as_xarray(*describe_cases(problem_of)).rename(case="sweep")
    described["sweep"].attrs["long_name"] = NAMES["sweep"]
    data = xr.merge([described, xr.concat(moments_by_sweep, described["sweep"], join="outer")])
    title = "Ensembles of the chaotic sweeps, from slightly perturbed data"
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
    """Return the runs of a sweep by two solvers, for the dataset of maxima of l2 over a window.

    All problems are plain values: `first` has the solver of the ensembles, and `second` the paper's
    second solver with different steps. Each problem has its own draws at each half-width:
    `first_members` for `first`, and `members` for each of `second`.
    """
    sizes = [first_members, *(members for _ in second)]
    drawn = [
        draw_swept(PaperProblem.of(problem), half_widths, size, count, seed + number)
        for number, (problem, count) in enumerate(zip([first, *second], sizes, strict=True))
    ]
    attributes = {"perturbation": size, "seed": seed, "window": name_window(windows[0])}

    def conclude(norms: Mapping[str, np.ndarray]) -> xr.Dataset:
        values = np.split(norms["l2"][:, 0], np.cumsum([len(ensemble) for ensemble in drawn])[:-1])
        data = _second_solver_dataset(values, half_widths, second)
        _, shared = describe_cases({"sweep": PaperProblem.of(first)})
        title = "A chaotic sweep by the paper's second solver, from slightly perturbed data"
        return data.assign_attrs({**shared, **attributes, "title": title, **CHAOTIC})

    return ManyRuns(
        [member for ensemble in drawn for member in ensemble],
        lambda member: read_norms(member, windows),
        conclude,
    )


def _second_solver_dataset(
    values: Sequence[np.ndarray], half_widths: Sequence[int], second: Sequence[Mapping]
) -> xr.Dataset:
    """Return the dataset of the maxima of l2. In `values` the first solver's maxima come first."""
    of_first, *of_second = (maxima.reshape(len(half_widths), -1) for maxima in values)
    long_name = f"{NAMES['l2']} of the pair, largest over the window"
    steps = [problem["solver"]["step"] for problem in second]
    return xr.Dataset(
        {
            "first_l2": (("half_width", "first_member"), of_first, {"long_name": long_name}),
            "l2": (
                ("solver_step", "half_width", "member"),
                np.array(of_second),
                {"long_name": f"{long_name}, by the second solver"},
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


def _moments(norms: Mapping[str, np.ndarray], sweep: Mapping) -> xr.Dataset:
    """Return the MOMENTS of the norms (half-width, member, reading) of one sweep."""
    data = xr.Dataset(coords={"reading": list(READINGS), "half_width": sweep["half_widths"]})
    for norm, values in norms.items():
        for key, moment in moments(values.swapaxes(0, 1)).items():
            attributes = {
                "long_name": f"{MOMENTS[key]} of the {NAMES[norm]} of the pair",
                **missing("no run has this half-width"),
                **(SCATTERED if key != "mean" else {}),
            }
            data[f"{norm}_{key}"] = ("half_width", "reading"), moment, attributes
    members_attributes = {"long_name": "members at each half-width"}
    return data.assign(swept_members=((), sweep["members"], members_attributes))
