"""Trajectories and sweeps beside the bounds of Theorems 1 to 3, and which theorem covers each."""

from collections.abc import Iterator, Mapping

import numpy as np
import xarray as xr

from pendula.datasets.checks import columns, describe, table, tabulate, variable
from pendula.ends import DIRICHLET, kind_of
from pendula.measures.norms import power_of, total_power
from pendula.models.bounds import (
    best_bound,
    proven_region,
    theorem_1_bound,
    theorem_2_bound,
    theorem_3_bound,
    widened_bound,
)
from pendula.problem import Constants, on_sites, place, read_initial

from .equations import total_energy

NUMBERS = {
    "region": ("region of the theorem that covers the case", None),
    "ratio": ("largest P over its smallest bound", 1.0),
    "energy": ("conserved energy H of equation (8), at the start", None),
    "start": ("P at the start, delta", None),
    "observed": ("largest P", None),
    "theorem_1": ("C of Theorem 1", None),
    "theorem_2": ("bound on P from the barrier of (25)", None),
    "widened": ("the same with the bonds kept", None),
    "theorem_3": ("C_N of Theorem 3", None),
    "best": ("smallest bound that holds", None),
}
"""The numbers of a trajectory, each with its long name and its tolerance."""


def case_numbers(trajectory: xr.Dataset) -> dict[str, float | str]:
    """Return the numbers of one trajectory that NUMBERS describes."""
    constants, boundary = Constants.of(trajectory.attrs), str(trajectory.attrs["boundary"])
    sites = 2 * int(trajectory.attrs["half_width"]) + 1
    energy, power = float(trajectory["energy"][0]), total_power(trajectory)
    start, observed = float(power[0]), np.float64(power.max())
    at_rest = kind_of(boundary) == DIRICHLET
    best = best_bound(energy, start, sites, constants, boundary)
    numbers = {
        "energy": energy,
        "start": start,
        "observed": observed,
        "theorem_1": theorem_1_bound(energy, constants),
        "theorem_2": theorem_2_bound(energy, start, constants),
        "widened": widened_bound(energy, start, constants) if at_rest else np.inf,
        "theorem_3": theorem_3_bound(energy, sites, constants),
        "best": best,
        "ratio": observed / best,
    }
    region = proven_region(energy, start, constants, boundary)
    return {"region": region, **{name: float(value) for name, value in numbers.items()}}


def labels(datasets, dim: str) -> dict:
    """Return the detuning and the initial data of each dataset, by which a figure names it."""
    omegas = [float(ds.attrs["omega"]) for ds in datasets]
    initials = [str(ds.attrs["initial"]) for ds in datasets]
    return {
        "omega": variable(omegas, (dim,), "detuning Omega"),
        "initial": variable(initials, (dim,), "initial {site: [A, B]}"),
    }


def check_cases(trajectories: Mapping[str, xr.Dataset]) -> dict:
    """Set each of the paper's trajectories (by the name of its case) beside its bounds."""
    return tabulate(
        "The paper's cases beside the bounds of its theorems",
        {"case": list(trajectories)},
        map(case_numbers, trajectories.values()),
        NUMBERS,
        **labels(trajectories.values(), "case"),
    )


def check_sweeps(sweeps: Mapping[str, xr.Dataset]) -> dict:
    """Set the largest P of each swept chain beside its bounds, that of Theorem 3 growing with N."""
    half_widths = np.unique(np.concatenate([s["half_width"].values for s in sweeps.values()]))
    shape, dims = (len(sweeps), len(half_widths)), ("sweep", "half_width")
    observed, finite, best = (np.full(shape, np.nan) for _ in range(3))
    for i, sweep in enumerate(sweeps.values()):
        constants, boundary = Constants.of(sweep.attrs), str(sweep.attrs["boundary"])
        peaks = sweep["l2"].sel(quantity="pair", statistic="max").max("window").values ** 2
        for half_width, peak in zip(sweep["half_width"].values, peaks, strict=True):
            j, sites = np.searchsorted(half_widths, half_width), 2 * int(half_width) + 1
            amplitudes = place(on_sites(read_initial(sweep.attrs["initial"])), int(half_width))
            energy, start = total_energy(constants, boundary, amplitudes), power_of(amplitudes)
            observed[i, j] = peak
            finite[i, j] = theorem_3_bound(energy, sites, constants)
            best[i, j] = best_bound(energy, start, sites, constants, boundary)
    ratio = np.nanmax(observed / best)
    return table(
        "The paper's sweeps beside the bounds of its theorems",
        {"sweep": list(sweeps), "half_width": half_widths},
        swept_observed=variable(observed, dims, "largest P in the windows"),
        **columns(dims, NUMBERS, {"theorem_3": finite, "best": best}),
        **labels(sweeps.values(), "sweep"),
        swept_ratio=variable(ratio, (), "largest P of all over its bound", tolerance=1.0),
    )


def check_observed(
    trajectories: Mapping[str, xr.Dataset], sweeps: Mapping[str, xr.Dataset]
) -> Iterator[xr.Dataset]:
    """Yield the checks of the paper's cases and of its sweeps, each by name."""
    for name, check in (("cases", check_cases(trajectories)), ("sweeps", check_sweeps(sweeps))):
        print(describe(name, check))
        yield xr.Dataset.from_dict(check)
