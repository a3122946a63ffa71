"""What was computed, as attributes of a dataset: the problem, and what else its job was given.

So every file says with which constants, initial conditions, seeds and grids it was computed, or
names the datasets that have them.
"""

import json
from collections.abc import Callable, Iterable, Mapping
from typing import Any

import numpy as np

from latticode.equations.initial_values import write_initial
from latticode.simulation.problem import Problem

COMPUTED_BY, COMPUTED_FROM = "computed_by", "computed_from"
"""The attributes that name the function of a job, and the datasets that it has read."""


OF_A_PROBLEM = ("half_width", "boundary", "end_time", "output_step", "snapshot_every")


def describe_run(name: str, problem: Problem, solver: Mapping) -> dict[str, Any]:
    """Return the attributes that say what was solved, and by which controls."""
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
    """Return the attributes that have one value in all descriptions, but for those `without`.

    Of runs and sweeps that are read again they say what problem all of them solve.
    """
    first, *later = descriptions
    return {
        key: value
        for key, value in first.items()
        if key not in without and all(description.get(key) == value for description in later)
    }


def stated(
    arguments: Mapping[str, Any], variables: Iterable[str], read: list[str], function: Callable
) -> dict[str, Any]:
    """Return what the function of a job was given as attributes, which are numbers and text.

    A list is written as JSON. A table of single values with names becomes an attribute for each
    entry, any other table JSON. Several problems have an attribute for each value that all of them
    share, and one for the values in which they differ. What the `variables` of the dataset hold is
    left out. `read` names the datasets that the `function` has read.
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
    known = {
        name: value for name, value in attributes.items() if value is not None
    }  # an infinite chain
    attributes = {name: value for name, value in known.items() if name not in variables}
    attributes[COMPUTED_BY] = f"{function.__module__}.{function.__name__}"
    return attributes | ({COMPUTED_FROM: ", ".join(read)} if read else {})


def _problems(value: Any) -> dict[str, Problem]:
    """Return problems by name, none where the value is something else."""
    if isinstance(value, Mapping):
        named = {str(key): value_or_problem for key, value_or_problem in value.items()}
    else:
        named = {
            str(k): value_or_problem
            for k, value_or_problem in enumerate(value if isinstance(value, list) else [value])
        }
    return (
        named
        if all(isinstance(value_or_problem, Problem) for value_or_problem in named.values())
        else {}
    )


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
    """Return whether an entry is a single value whose name can stand in that of an attribute."""
    single = value is None or isinstance(value, str | int | float | complex | np.generic)
    return single and f"_{key}".isidentifier()


def _json(value: Any) -> str:
    """Return JSON, and what it has no word for, such as a complex number, as Python writes it."""
    return json.dumps(
        value,
        default=lambda value_or_array: getattr(value_or_array, "tolist", value_or_array.__repr__)(),
    )
