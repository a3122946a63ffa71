"""The numbers of this study that the article prints, measured again with each choice changed."""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
import xarray as xr
from latticode.datasets.netcdf import as_xarray
from latticode.measures.confidence import ConfidenceInterval, share_limits

from pendula.problem import Constants, PaperProblem
from pendula.varied import NamedNumber, as_dataset, vary, vary_several

from .fates import FATES, map_fates
from .periodic import find_breather, power, quarter_later
from .sensitivity import measure_sensitivity


def with_choices(
    problem: PaperProblem, tolerance: float, end_time: float, half_width: int
) -> PaperProblem:
    """Return a problem with another tolerance, end time and length, and one output."""
    solver = problem.solver | {"rtol": tolerance, "atol": tolerance}
    changed = problem.changed(solver=solver, end_time=end_time, output_step=end_time)
    return changed.changed(half_width=int(half_width))


def choices_of(chosen: Mapping[str, float], variations: Mapping[str, Sequence]) -> dict[str, list]:
    """Return all values of each choice, first the one of the printed number."""
    return {name: [value, *variations.get(name, ())] for name, value in chosen.items()}


def vary_areas(
    problem: PaperProblem,
    amplitudes: Sequence[float],
    chosen: Mapping[str, float],
    variations: Mapping[str, Sequence],
) -> xr.Dataset:
    """Return the share of each fate in the map without its diagonal, (kind,).

    Confidence limits count the points of half of the map as independent initial conditions.
    """

    def measure(majority: float, stride: float, **settings: Any) -> ConfidenceInterval:
        grid = amplitudes[:: int(stride)]
        changed = {problem.constants.omega: with_choices(problem, **settings)}
        fates = map_fates(changed, grid, majority=majority).make()[0]["fate"].values[0]
        half = fates[np.tril_indices(len(grid), -1)]
        counts = [int((half == place).sum()) for place in range(len(FATES))]
        return ConfidenceInterval(
            *np.transpose([share_limits(count, half.size) for count in counts])
        )

    area = vary(measure, choices_of(chosen, variations))
    kinds = ("kind", np.array(FATES, object), {"long_name": "fate of initial conditions"})
    printed = {"area": NamedNumber(("kind",), area, "part of the map")}
    data = as_dataset(printed, {"kind": kinds})
    return data.assign_attrs(title="Parts of the map of fates, with other choices")


def vary_shares(
    name: str,
    problem: PaperProblem,
    sizes: Sequence[float],
    members: int,
    chosen: Mapping[str, float],
    variations: Mapping[str, Sequence],
) -> xr.Dataset:
    """Return the share of runs that spread, by the relative perturbation, (size,)."""

    def measure(majority: float, seed: float, **settings: Any) -> ConfidenceInterval:
        changed = with_choices(problem, **settings)
        study = measure_sensitivity(name, changed, sizes, members, int(seed), majority=majority)
        data = as_xarray(*study.make())
        return ConfidenceInterval(*(data[f"share{end}"].values for end in ("", "_low", "_high")))

    share = vary(measure, choices_of(chosen, variations))
    by_size = (
        "size",
        np.array(sizes),
        {"long_name": "size of a random change of the data, relative"},
    )
    data = as_dataset(
        {"share": NamedNumber(("size",), share, "share of runs that spread")}, {"size": by_size}
    )
    return data.assign_attrs(
        title="Shares of runs that spread, with other choices", members=members
    )


def vary_least_power(
    constants: Mapping[str, float],
    frequencies: Sequence[float],
    chosen: Mapping[str, float],
    variations: Mapping[str, Sequence],
) -> xr.Dataset:
    """Return the least P that a breather "A only" has within a period, and its frequency.

    `frequencies` are the first and the last of a scan in equal steps.
    """

    def measure(
        frequency_step: float, half_width: float, steps: float
    ) -> dict[str, tuple[float, float]]:
        scan = np.arange(frequencies[0], frequencies[1] + 0.5 * frequency_step, frequency_step)
        powers = []
        for frequency in scan:
            breather = find_breather(
                "A only", Constants(**constants), float(frequency), int(half_width)
            )
            late = quarter_later(breather, int(steps))[0, 1::2]
            powers.append(float(power(late).sum()))
        least = int(np.argmin(powers))
        return {
            "least_power": (powers[least], 0.0),
            "least_frequency": (scan[least], frequency_step),
        }

    numbers = vary_several(measure, choices_of(chosen, variations))
    words = {
        "least_power": "least P of the breathers in which A swings more than B, within a period",
        "least_frequency": "frequency of the breather with the least P",
    }
    printed = {name: NamedNumber((), number, words[name]) for name, number in numbers.items()}
    return as_dataset(printed, {}).assign_attrs(
        title="The least P of breathers, with other choices"
    )
