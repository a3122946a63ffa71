"""What makes a new dataset doubtful, so that it may not be accepted without a thought.

A trajectory or a sweep has a name of the configuration, which says of what problem it is. A run
with a stale or a misnamed file would make that file the accepted one, and every later run wrong.
"""

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from pendula.datasets.netcdf import DatasetError
from pendula.problem import write_initial

from . import hashes

OF_A_CASE = ("omega", "gamma", "epsilon", "boundary", "half_width", "end_time", "output_step")
"""Entries of a case that its datasets repeat as attributes."""


def doubts(
    name: str, content: hashes.Content, accepted: Path | None, configuration: Mapping[str, Any]
) -> list[str]:
    """Return in words what is doubtful about the dataset `name` with this content.

    `accepted` is what the baseline keeps of it, or None where lost numbers are no doubt.
    """
    said = _unlike_the_case(content.attributes, problem_of(name, configuration))
    try:
        lost = [] if accepted is None else _lost(content, hashes.read(accepted))
    except DatasetError:  # a damaged or lost copy is about to be written anew
        return said
    stem = name.removesuffix(".nc")
    way_out = f"if this is meant, name it: --config accept={stem}, or all files: accept='*'"
    return said + [f"{each} ({way_out})" for each in lost]


def problem_of(name: str, configuration: Mapping[str, Any]) -> dict[str, Any]:
    """Return the attributes that the dataset `name` must have; of another kind of dataset, none."""
    room, _, file = name.partition("/")
    stem, _, solver = file.removesuffix(".nc").partition(".")
    cases, sweeps = (configuration.get(key, {}) for key in ("cases", "sweeps"))
    if room == "trajectories" and stem in cases:
        case = cases[stem]
    elif room == "sweeps" and stem in sweeps:
        sweep = sweeps[stem]
        end_time = max(window[1] for window in sweep["windows"])
        own = {"solver": sweep["solver"]} if sweep["solver"] else {}
        case = {**cases[sweep["case"]], **own, "end_time": end_time}
        case.pop("half_width", None)
    else:
        return {}
    solver = solver or case.get("solver", {}).get("name")
    expected = {key: case[key] for key in OF_A_CASE if key in case}
    if "initial" in case:
        sites = {int(site): tuple(map(complex, pair)) for site, pair in case["initial"].items()}
        expected["initial"] = write_initial(sites)
    return expected | ({"solver": solver} if solver and solver != "auto" else {})


def _unlike_the_case(attributes: Mapping[str, Any], expected: Mapping[str, Any]) -> list[str]:
    said = []
    for key, right in expected.items():
        if (found := attributes.get(key, "absent")) != right:
            said.append(f"{key} is {found}, but {right} in the configuration")
    return said


def _lost(new: hashes.Content, accepted: hashes.Content) -> list[str]:
    """Return in words which variables hold NaN where the accepted ones held numbers."""
    said = []
    for name, was in accepted.variables.items():
        now = new.variables.get(name)
        if now is None or now.values.shape != was.values.shape or was.values.dtype.kind != "f":
            continue
        lost = int((np.isnan(now.values.astype(float)) & ~np.isnan(was.values)).sum())
        if lost:
            said.append(f"{name} has NaN in place of {lost} numbers")
    return said
