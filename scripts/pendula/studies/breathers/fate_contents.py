"""The dataset of fates: two maps, shares of area, the paper's data, and runs on other terms."""

from collections.abc import Mapping
from typing import NamedTuple

import numpy as np
import xarray as xr

from pendula.datasets.checks import rounded
from pendula.datasets.netcdf import Variable, as_xarray
from pendula.datasets.trajectories import Contents, describe_run
from pendula.problem import Problem

from .fates import FATES, End, ends, map_of_amplitudes, map_of_phases, on_one_pair, shares_of_area
from .nearest import Families

DIGITS = 6
"""Significant digits of what is read off the end of a run."""
PLANES = ("amplitudes", "phases")
PERIODIC = ("unknown", "no", "yes")
"""What the numbers from -1 on of a variable `periodic` stand for."""


class Grid(NamedTuple):
    """The data of both maps."""

    amplitudes: np.ndarray  # A_0 and B_0 of the first map
    turned: np.ndarray  # A_0 of the second map
    phases: np.ndarray  # those of B_0 there
    ratio: float  # |B_0| / |A_0| there
    checked: int  # every so many amplitudes of the first map are run on other terms too


def map_fates(
    periodic: xr.Dataset, problems: Mapping[float, Problem], case_problems: Mapping[str, Problem],
    fine: xr.Dataset | None = None, **grid,
) -> Contents:  # fmt: skip
    """Return `fates_contents` of a grid of plain values, those of a `Grid`."""
    arrays = {name: np.array(grid.pop(name)) for name in ("amplitudes", "turned", "phases")}
    return fates_contents(problems, Grid(**arrays, **grid), case_problems, periodic, fine)


def fates_contents(
    problems: Mapping[float, Problem], grid: Grid, cases: Mapping[str, Problem],
    periodic: xr.Dataset, fine: xr.Dataset | None = None,
) -> Contents:  # fmt: skip
    """Return the fate of the data at each detuning, beside the families of periodic breathers.

    `problems` are by detuning, `cases` those of the paper, with data of their own. With `fine`, the
    maps of another run, it is counted at how many common data both runs find the same.
    """
    families = {omega: Families.of(periodic, omega) for omega in problems}
    first = [
        map_of_amplitudes(one, grid.amplitudes, families[omega]) for omega, one in problems.items()
    ]
    second = [
        map_of_phases(one, grid.turned, grid.phases, grid.ratio, families[omega])
        for omega, one in problems.items()
    ]
    variables = {
        "omega": Variable(("omega",), np.array(list(problems))),
        "a0": Variable(("a0",), grid.amplitudes, "initial amplitude A_0 of the centre"),
        "b0": Variable(("b0",), grid.amplitudes, "initial amplitude B_0 of the centre"),
        "turned_a0": Variable(
            ("turned_a0",), grid.turned, "initial amplitude A_0 of the centre, B_0 turned in phase"
        ),
        "phase": Variable(("phase",), grid.phases, "initial phase of B_0 beside A_0", "rad"),
        **_map("", ("a0", "b0"), first, periodic),
        **_map("turned_", ("turned_a0", "phase"), second, periodic),
        **_shares(first, second),
        **_of_cases(cases, periodic),
        **_checked(problems, grid, first, families),
    }
    (one, *_) = problems.values()
    described = describe_run("pairs", one, one.solver)
    about = {
        key: value for key, value in described.items() if key not in ("omega", "initial", "case")
    }
    about |= {"ratio": grid.ratio, "title": "What becomes of data on one pair"}
    if fine is not None:
        variables |= _beside(as_xarray(variables, about), fine)
    return variables, about


def _flags(names, first: int = 0) -> dict:
    """Return the attributes of a variable of numbers that stand for names, as CF has them."""
    words = " ".join(str(name).replace(" ", "") for name in names)
    values = np.arange(first, first + len(names), dtype=np.int8)
    return {"flag_values": values, "flag_meanings": words}


def _map(start: str, over: tuple[str, ...], found: list[End], periodic: xr.Dataset) -> dict:
    """Return what one map shows at each detuning, under names that begin with `start`."""
    about = " (B_0 turned in phase)" if start else ""
    along = ("omega", *over)
    families = _flags(["none", *periodic["family"].values])
    fate = np.array([one.fate for one in found], dtype=np.int8)
    return {
        f"{start}fate": Variable(
            along, fate, f"fate of the data{about}", attributes=_flags(FATES)
        ),
        f"{start}held": _kept(
            along, [one.held for one in found], f"share of P on the three central pairs{about}"
        ),
        f"{start}unreturned": _kept(
            along, [one.unreturned for one in found],
            f"P that does not return after half periods, over the most that waves explain{about}",
        ),
        f"{start}periodic": Variable(
            along, np.array([one.periodic for one in found]),
            f"whether what stays is periodic, a breather{about}",
            attributes=_flags(PERIODIC, first=-1),
        ),
        f"{start}breather_frequency": _kept(
            along, [one.frequency for one in found], f"frequency of the final breather{about}"
        ),
        f"{start}breather_family": Variable(
            along, np.array([one.family for one in found], dtype=np.int8),
            f"family whose symmetry the final breather has{about}", attributes=families,
        ),
        f"{start}family_distance": _kept(
            along, [one.distance for one in found],
            f"relative distance of the final breather from this family{about}",
        ),
    }  # fmt: skip


def _kept(dimensions: tuple[str, ...], values, words: str) -> Variable:
    about = {"significant_digits": DIGITS}
    return Variable(dimensions, rounded(values, DIGITS), words, attributes=about)


def _shares(first: list[End], second: list[End]) -> dict[str, Variable]:
    """Return the share of each fate in the area of each map."""
    found = np.array(
        [
            [shares_of_area(one.fate, mirrored=plane == "amplitudes") for one in maps]
            for plane, maps in zip(PLANES, (first, second), strict=True)
        ]
    )  # (plane, omega, limit, fate)
    along, words = ("plane", "omega", "fate_name"), "share of the area of data with this fate"
    return {
        "plane": Variable(("plane",), list(PLANES), "what varies over a map of fates"),
        "fate_name": Variable(("fate_name",), list(FATES), "fate"),
        "area": Variable(along, found[:, :, 0], words),
        "area_low": Variable(along, found[:, :, 1], f"{words}, lower confidence limit"),
        "area_high": Variable(along, found[:, :, 2], f"{words}, upper confidence limit"),
    }


TERMS = ("boundary", "end_time", "epsilon", "gamma", "half_width", "ratio", "solver", "solver_rtol")
"""What two maps must have in common to be compared."""


def _beside(coarse: xr.Dataset, fine: xr.Dataset) -> dict[str, Variable]:
    """Return how many data both maps have on each plane, and of how many they find the same.

    None are common to maps of other terms.
    """
    alike = all(coarse.attrs[name] == fine.attrs.get(name) for name in TERMS)
    counts = np.zeros((2, len(PLANES), coarse.sizes["omega"]), dtype=int)
    for i, start in enumerate(("", "turned_") if alike else ()):
        names = [f"{start}fate", f"{start}periodic"]
        here = coarse[names].to_array()
        there = fine[names].reindex_like(here, method="nearest", tolerance=1e-9).to_array()
        common, same = there.notnull().all("variable"), (here == there).all("variable")
        for j, both in enumerate((common, common & same)):
            counts[j, i] = both.sum([name for name in both.dims if name != "omega"])
    along = ("plane", "omega")
    return {
        "common": Variable(along, counts[0], "data of this map on the committed fine one too"),
        "agreed": Variable(along, counts[1], "data of these of which both maps find the same"),
    }


def _of_cases(cases: Mapping[str, Problem], periodic: xr.Dataset) -> dict[str, Variable]:
    """Return what becomes of the paper's data."""
    found = [ends([one], Families.of(periodic, one.constants.omega)) for one in cases.values()]
    centres = [one.initial[:, one.initial.shape[1] // 2] for one in cases.values()]
    along = ("case",)
    return {
        "case": Variable(along, list(cases)),
        "case_omega": Variable(
            along, [one.constants.omega for one in cases.values()], "detuning Omega of the case"
        ),
        "case_a0": Variable(along, [a.real for a, _ in centres], "A_0 of the case"),
        "case_b0": Variable(along, [b.real for _, b in centres], "B_0 of the case"),
        "case_fate": Variable(
            along, np.array([int(one.fate[0]) for one in found], dtype=np.int8),
            "fate of the data of the case", attributes=_flags(FATES),
        ),
        "case_periodic": Variable(
            along, np.array([one.periodic[0] for one in found]),
            "whether the case, if it stays, is periodic, a breather",
            attributes=_flags(PERIODIC, first=-1),
        ),
        "case_breather_frequency": _kept(
            along, [one.frequency[0] for one in found],
            "frequency of the final breather of the case",
        ),
        "family": Variable(
            ("family",), [str(name) for name in periodic["family"].values],
            "family of periodic breathers",
        ),
        "case_distance": _kept(
            (*along, "family"), [one.distances[0] for one in found],
            "relative distance of the final breather of the case from each family",
        ),
    }  # fmt: skip


LONGEST, TIMES = "ten times the time", 10.0
"""The name of the longest runs, and how many times the end time of the maps they last."""
OTHERWISE = {
    "twice the chain": lambda one: one.changed(half_width=2 * one.half_width),
    "twice the time": lambda one: one.changed(
        end_time=2.0 * one.end_time, output_step=2.0 * one.output_step
    ),
    LONGEST: lambda one: one.changed(
        end_time=TIMES * one.end_time, output_step=TIMES * one.output_step
    ),
    "a hundredth of the tolerance": lambda one: one.changed(
        solver={**one.solver, "rtol": 0.01 * one.solver["rtol"], "atol": 0.01 * one.solver["atol"]}
    ),
}
"""How some data are run once more, to see what of their fates the choice of a run decides."""


def _checked(
    problems: Mapping[float, Problem], grid: Grid, first: list[End],
    families: Mapping[float, Families],
) -> dict[str, Variable]:  # fmt: skip
    """Return the fates of some data by the map's runs, and by runs on other terms."""
    some = np.arange(grid.checked - 1, len(grid.amplitudes), grid.checked)
    rows, columns = (some[numbers] for numbers in np.tril_indices(len(some), -1))
    data = list(zip(grid.amplitudes[rows], grid.amplitudes[columns], strict=True))

    def again(change) -> list[np.ndarray]:
        return [
            ends((change(on_one_pair(one, a, b)) for a, b in data), families[omega]).fate
            for omega, one in problems.items()
        ]

    found = [[one.fate[rows, columns] for one in first], *map(again, OTHERWISE.values())]
    return {
        "conditions": Variable(
            ("conditions",), ["as on the map", *OTHERWISE],
            "how long, where and how finely data are run"
        ),
        "checked_a0": Variable(
            ("checked",), grid.amplitudes[rows], "A_0 of data that are run on several terms"
        ),
        "checked_b0": Variable(
            ("checked",), grid.amplitudes[columns], "B_0 of data that are run on several terms"
        ),
        "checked_fate": Variable(
            ("conditions", "omega", "checked"), np.array(found, dtype=np.int8),
            "fate of data that are run on several terms", attributes=_flags(FATES),
        ),
    }  # fmt: skip
