"""The dataset of fates: two maps, shares of area, and the paper's data."""

from collections.abc import Iterable, Mapping

import numpy as np
from latticode.datasets.netcdf import Variable
from latticode.datasets.stated import describe_run
from latticode.datasets.trajectories import Contents
from latticode.simulation.runs import Run, run_all

from pendula.problem import Problem

from .fates import FATES, keep_fate, run_maps, shares_of_area

PLANES = ("amplitudes", "phases")


def map_fates(
    problems: Mapping[float, Problem], case_problems: Mapping[str, Problem],
    amplitudes: Iterable[float], turned: Iterable[float], phases: Iterable[float], ratio: float,
    run: Run = run_all,
) -> Contents:  # fmt: skip
    """Return the fate of the data at each detuning, as `run_maps` finds it.

    `problems` are by detuning, `case_problems` those of the paper, with data of their own.
    """
    amplitudes, turned, phases = (np.array(one) for one in (amplitudes, turned, phases))
    first, second = run_maps(problems, amplitudes, turned, phases, ratio, run)
    variables = {
        "omega": Variable(("omega",), np.array(list(problems))),
        "a0": Variable(("a0",), amplitudes, "initial amplitude A_0 of the centre"),
        "b0": Variable(("b0",), amplitudes, "initial amplitude B_0 of the centre"),
        "turned_a0": Variable(
            ("turned_a0",),
            np.array(turned),
            "initial amplitude A_0 of the centre, B_0 turned in phase",
        ),
        "phase": Variable(("phase",), phases, "initial phase of B_0 beside A_0", "rad"),
        "fate": _fates(("omega", "a0", "b0"), first, "fate of the data"),
        "turned_fate": _fates(
            ("omega", "turned_a0", "phase"), second, "fate of the data (B_0 turned in phase)"
        ),
        **_shares(first, second),
        **_of_cases(case_problems),
    }
    (one, *_) = problems.values()
    about = describe_run("pairs", one, one.solver)
    about = {key: value for key, value in about.items() if key not in ("omega", "initial", "case")}
    return variables, about | {"ratio": ratio, "title": "What becomes of data on one pair"}


def _fates(dimensions: tuple[str, ...], values, words: str) -> Variable:
    """Return a variable of numbers that stand for FATES, as CF has them."""
    flags = np.arange(len(FATES), dtype=np.int8)
    about = {"flag_values": flags, "flag_meanings": " ".join(FATES)}
    return Variable(dimensions, np.array(values, dtype=np.int8), words, attributes=about)


def _shares(first: np.ndarray, second: np.ndarray) -> dict[str, Variable]:
    """Return the share of each fate in the area of each map."""
    found = np.array([
        [shares_of_area(one, mirrored=plane == "amplitudes") for one in maps]
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


def _of_cases(cases: Mapping[str, Problem]) -> dict[str, Variable]:
    """Return what becomes of the paper's data."""
    omegas = [one.constants.omega for one in cases.values()]
    centres = [one.initial[:, one.initial.shape[1] // 2].real for one in cases.values()]
    a0, b0 = np.transpose(centres)
    fates = [keep_fate(one)["fate"] for one in cases.values()]
    along = ("case",)
    return {
        "case": Variable(along, list(cases)),
        "case_omega": Variable(along, omegas, "detuning Omega of the case"),
        "case_a0": Variable(along, a0, "A_0 of the case"),
        "case_b0": Variable(along, b0, "B_0 of the case"),
        "case_fate": _fates(along, fates, "fate of the data of the case"),
    }
