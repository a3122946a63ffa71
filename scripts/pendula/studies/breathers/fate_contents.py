"""The dataset of fates: two maps, shares of area, the paper's data, and runs on other terms."""

from collections.abc import Iterable, Mapping

import numpy as np
import xarray as xr

from pendula.datasets.netcdf import Variable, as_xarray
from pendula.datasets.trajectories import Contents, describe_run
from pendula.problem import Problem

from .contents import kept
from .fates import FATES, End, ends, map_of_amplitudes, map_of_phases, on_one_pair, shares_of_area
from .nearest import Families

DIGITS = 6
"""Significant digits of what is read off the end of a run."""
PLANES = ("amplitudes", "phases")
PERIODIC = ("unknown", "no", "yes")
"""What the numbers from -1 on of a variable `periodic` stand for."""
TERMS = ("boundary", "end_time", "epsilon", "gamma", "half_width", "ratio", "solver", "solver_rtol")
"""What two maps must have in common to be compared."""
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


def map_fates(
    periodic: xr.Dataset, problems: Mapping[float, Problem], case_problems: Mapping[str, Problem],
    amplitudes: Iterable[float], turned: Iterable[float], phases: Iterable[float], ratio: float,
    checked: int, fine: xr.Dataset | None = None,
) -> Contents:  # fmt: skip
    """Return the fate of the data at each detuning, beside the families of periodic breathers.

    `problems` are by detuning, `case_problems` those of the paper, with data of their own. The
    first map is over `amplitudes`, those of A_0 and of B_0, the second one over A_0 from `turned`
    and the phase of B_0, with |B_0| = `ratio` A_0; of the first one every `checked` amplitudes are
    run on other terms too. With `fine`, the maps of another run, it is counted at how many common
    data both runs find the same.
    """
    amplitudes, turned, phases = (np.array(one) for one in (amplitudes, turned, phases))
    families = {omega: Families.of(periodic, omega) for omega in problems}
    first, second = [], []
    for omega, one in problems.items():
        first.append(map_of_amplitudes(one, amplitudes, families[omega]))
        second.append(map_of_phases(one, turned, phases, ratio, families[omega]))
    variables = {
        "omega": Variable(("omega",), np.array(list(problems))),
        "a0": Variable(("a0",), amplitudes, "initial amplitude A_0 of the centre"),
        "b0": Variable(("b0",), amplitudes, "initial amplitude B_0 of the centre"),
        "turned_a0": Variable(
            ("turned_a0",), turned, "initial amplitude A_0 of the centre, B_0 turned in phase"
        ),
        "phase": Variable(("phase",), phases, "initial phase of B_0 beside A_0", "rad"),
        **_map("", ("a0", "b0"), first, periodic),
        **_map("turned_", ("turned_a0", "phase"), second, periodic),
        **_shares(first, second),
        **_of_cases(case_problems, periodic),
        **_checked(problems, amplitudes, checked, first, families),
    }
    (one, *_) = problems.values()
    about = describe_run("pairs", one, one.solver)
    about = {key: value for key, value in about.items() if key not in ("omega", "initial", "case")}
    about |= {"ratio": ratio, "title": "What becomes of data on one pair"}
    if fine is not None:
        variables |= _beside(as_xarray(variables, about), fine)
    return variables, about


def _stored(dimensions: tuple[str, ...], values, words: str, names=None) -> Variable:
    """Return a variable of rounded values, or of numbers that stand for `names`, as CF has them."""
    if names is None:
        return kept(dimensions, values, words, DIGITS)
    first = -1 if names is PERIODIC else 0
    about = {
        "flag_values": np.arange(first, first + len(names), dtype=np.int8),
        "flag_meanings": " ".join(str(name).replace(" ", "") for name in names),
    }
    return Variable(dimensions, np.array(values, dtype=np.int8), words, attributes=about)


def _map(start: str, over: tuple[str, ...], found: list[End], periodic: xr.Dataset) -> dict:
    """Return what one map shows at each detuning, under names that begin with `start`."""
    about = " (B_0 turned in phase)" if start else ""
    families = ["none", *periodic["family"].values]
    rows = (
        ("fate", "fate", FATES, "fate of the data"),
        ("held", "held", None, "share of P on the three central pairs"),
        ("unreturned", "unreturned", None,
         "P that does not return after half periods, over the most that waves explain"),
        ("periodic", "periodic", PERIODIC, "whether what stays is periodic, a breather"),
        ("breather_frequency", "frequency", None, "frequency of the final breather"),
        ("breather_family", "family", families, "family whose symmetry the final breather has"),
        ("family_distance", "distance", None,
         "relative distance of the final breather from this family"),
    )  # fmt: skip
    return {
        f"{start}{name}": _stored(
            ("omega", *over), [getattr(one, field) for one in found], f"{words}{about}", names
        )
        for name, field, names, words in rows
    }


def _shares(first: list[End], second: list[End]) -> dict[str, Variable]:
    """Return the share of each fate in the area of each map."""
    found = np.array([
        [shares_of_area(one.fate, mirrored=plane == "amplitudes") for one in maps]
        for plane, maps in zip(PLANES, (first, second), strict=True)
    ])  # (plane, omega, limit, fate)  # fmt: skip
    along, words = ("plane", "omega", "fate_name"), "share of the area of data with this fate"
    return {
        "plane": Variable(("plane",), list(PLANES), "what varies over a map of fates"),
        "fate_name": Variable(("fate_name",), list(FATES), "fate"),
        "area": Variable(along, found[:, :, 0], words),
        "area_low": Variable(along, found[:, :, 1], f"{words}, lower confidence limit"),
        "area_high": Variable(along, found[:, :, 2], f"{words}, upper confidence limit"),
    }


def _beside(coarse: xr.Dataset, fine: xr.Dataset) -> dict[str, Variable]:
    """Return how many data both maps have on each plane, and of how many they find the same.

    None are common to maps of other terms.
    """
    alike = all(coarse.attrs[name] == fine.attrs.get(name) for name in TERMS)
    common, agreed = np.zeros((2, len(PLANES), coarse.sizes["omega"]), dtype=int)
    for i, start in enumerate(("", "turned_") if alike else ()):
        names = [f"{start}fate", f"{start}periodic"]
        here = coarse[names].to_array()
        there = fine[names].reindex_like(here, method="nearest", tolerance=1e-9).to_array()
        in_both, same = there.notnull().all("variable"), (here == there).all("variable")
        across = [name for name in in_both.dims if name != "omega"]
        common[i], agreed[i] = in_both.sum(across), (in_both & same).sum(across)
    along = ("plane", "omega")
    return {
        "common": Variable(along, common, "data of this map on the committed fine one too"),
        "agreed": Variable(along, agreed, "data of these of which both maps find the same"),
    }


def _of_cases(cases: Mapping[str, Problem], periodic: xr.Dataset) -> dict[str, Variable]:
    """Return what becomes of the paper's data."""
    omegas = [one.constants.omega for one in cases.values()]
    centres = [one.initial[:, one.initial.shape[1] // 2].real for one in cases.values()]
    a0, b0 = np.transpose(centres)
    found = [ends([one], Families.of(periodic, one.constants.omega)) for one in cases.values()]
    end, along = End(*map(np.concatenate, zip(*found, strict=True))), ("case",)
    return {
        "case": Variable(along, list(cases)),
        "case_omega": Variable(along, omegas, "detuning Omega of the case"),
        "case_a0": Variable(along, a0, "A_0 of the case"),
        "case_b0": Variable(along, b0, "B_0 of the case"),
        "case_fate": _stored(along, end.fate, "fate of the data of the case", FATES),
        "case_periodic": _stored(
            along, end.periodic, "whether the case, if it stays, is periodic, a breather", PERIODIC
        ),
        "case_breather_frequency": _stored(
            along, end.frequency, "frequency of the final breather of the case"
        ),
        "family": Variable(
            ("family",), [*map(str, periodic["family"].values)], "family of periodic breathers"
        ),
        "case_distance": _stored(
            (*along, "family"), end.distances,
            "relative distance of the final breather of the case from each family",
        ),
    }  # fmt: skip


def _checked(
    problems: Mapping[float, Problem], amplitudes: np.ndarray, step: int, first: list[End],
    families: Mapping[float, Families],
) -> dict[str, Variable]:  # fmt: skip
    """Return the fates of some data by the map's runs, and by runs on other terms."""
    some = np.arange(step - 1, len(amplitudes), step)
    rows, columns = (some[numbers] for numbers in np.tril_indices(len(some), -1))
    a0, b0 = amplitudes[rows], amplitudes[columns]
    found = [[one.fate[rows, columns] for one in first]]
    for change in OTHERWISE.values():
        found.append([
            ends((change(on_one_pair(one, *pair)) for pair in zip(a0, b0, strict=True)),
                 families[omega]).fate
            for omega, one in problems.items()
        ])  # fmt: skip
    return {
        "conditions": Variable(
            ("conditions",), ["as on the map", *OTHERWISE],
            "how long, where and how finely data are run"
        ),
        "checked_a0": Variable(("checked",), a0, "A_0 of data that are run on several terms"),
        "checked_b0": Variable(("checked",), b0, "B_0 of data that are run on several terms"),
        "checked_fate": _stored(
            ("conditions", "omega", "checked"), found,
            "fate of data that are run on several terms", FATES,
        ),
    }  # fmt: skip
