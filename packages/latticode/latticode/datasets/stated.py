"""Provenance as attributes of a dataset: its problem, and the other arguments of its job.

So every file records its constants, initial conditions, seeds and grids, or the names of the
datasets that do.
"""

import json
from collections.abc import Callable, Iterable, Mapping
from typing import Any

import numpy as np

from latticode.equations.initial_values import write_initial
from latticode.simulation.problem import Problem

COMPUTED_BY, COMPUTED_FROM = "computed_by", "computed_from"
"""Names of two attributes: the function of a job, and the datasets that the job has read."""
OF_A_PROBLEM = ("half_width", "boundary", "end_time", "output_step", "snapshot_every")


def describe_run(name: str, problem: Problem, solver: Mapping) -> dict[str, Any]:
    """Return attributes that describe a problem and the solver with its controls."""
    attributes = {key: getattr(problem, key) for key in OF_A_PROBLEM}
    if problem.site_count is not None:
        del attributes["half_width"]
        attributes["sites"] = problem.site_count
    attributes |= {"start_time": problem.start_time} if problem.start_time else {}
    attributes |= problem.equations.describe()
    return {
        "case": name,
        **{key: attributes[key] for key in sorted(attributes)},
        "initial": write_initial(problem.data_by_site),
        "solver": solver["name"],
        **{f"solver_{key}": solver[key] for key in solver if key not in ("name", "by_default")},
    }


def shared_by(descriptions: Iterable[Mapping[str, Any]], *without: str) -> dict[str, Any]:
    """Return the attributes that are equal in all descriptions, except the names in `without`."""
    first, *later = descriptions
    return {
        key: value
        for key, value in first.items()
        if key not in without and all(description.get(key) == value for description in later)
    }


def stated(
    arguments: Mapping[str, Any], variables: Iterable[str], read: list[str], function: Callable
) -> dict[str, Any]:
    """Return the arguments of the function of a job as attributes, which are numbers and strings.

    A mapping of single values becomes one attribute per entry; other mappings and lists become
    JSON. Several problems become one attribute for each value that they share, and one attribute
    in JSON for all values that differ. Values that the `variables` of the dataset contain are
    left out. `read` has the names of the datasets that the `function` has read.
    """
    variables, attributes = set(variables), {}
    for name, value in arguments.items():
        problems = _problems(value)
        if not problems:
            attributes |= _plain_attributes(name, value)
            continue
        each = {key: describe_run("", value, value.solver) for key, value in problems.items()}
        shared = shared_by(each.values(), "case")
        differing = {
            key: {key: value for key, value in description.items() if key not in {"case", *shared}}
            for key, description in each.items()
        }
        stored_as_variables = {key for value in differing.values() for key in value} <= variables
        attributes |= shared | ({} if stored_as_variables else {name: _json(differing)})
    attributes = {
        name: value
        for name, value in attributes.items()
        if value is not None and name not in variables  # None: the length of an infinite chain
    }
    attributes[COMPUTED_BY] = f"{function.__module__}.{function.__name__}"
    return attributes | ({COMPUTED_FROM: ", ".join(read)} if read else {})


def _problems(value: Any) -> dict[str, Problem]:
    """Return problems by name; {} if the value does not consist of problems."""
    if not isinstance(value, Mapping):
        value = dict(enumerate(value if isinstance(value, list) else [value]))
    named = {str(key): entry for key, entry in value.items()}
    return named if all(isinstance(entry, Problem) for entry in named.values()) else {}


def _plain_attributes(name: str, value: Any) -> dict[str, Any]:
    if value is None:
        return {}
    if isinstance(value, Mapping) and all(map(_is_named, value, value.values())):
        start = "" if name == "constants" else f"{name}_"
        names = {key: name if key == "name" else f"{start}{key}" for key in value}
        return {
            names[key]: text
            for key, entry in value.items()
            for text in _plain_attributes("", entry).values()
        }
    as_it_is = isinstance(value, str | int | float | np.number) and not isinstance(value, bool)
    return {name: value if as_it_is else _json(value)}


def _is_named(key: Any, value: Any) -> bool:
    """Return whether an entry is a single value, with a key that can be part of a name."""
    single = value is None or isinstance(value, str | int | float | complex | np.generic)
    return single and f"_{key}".isidentifier()


def _json(value: Any) -> str:
    """Return a value as JSON; an object that JSON does not know becomes a list or its `repr`."""
    return json.dumps(value, default=lambda item: getattr(item, "tolist", item.__repr__)())
