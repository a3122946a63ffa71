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
    about = {key: getattr(problem, key) for key in OF_A_PROBLEM}
    if problem.site_count is not None:
        del about["half_width"]
        about["sites"] = problem.site_count
    about |= {"start_time": problem.start_time} if problem.start_time else {}
    about |= problem.equations.describe()
    return {
        "case": name,
        **{key: about[key] for key in sorted(about)},
        "initial": write_initial(problem.data_by_site),
        "solver": solver["name"],
        **{f"solver_{key}": solver[key] for key in solver if key not in ("name", "by_default")},
    }


def shared_by(descriptions: Iterable[Mapping[str, Any]], *without: str) -> dict[str, Any]:
    """Return the attributes that have one value in all descriptions, but for those `without`.

    Of runs and sweeps that are read again they say what problem all of them solve.
    """
    first, *others = descriptions
    return {
        key: value
        for key, value in first.items()
        if key not in without and all(other.get(key) == value for other in others)
    }


def stated(
    given: Mapping[str, Any], variables: Iterable[str], read: list[str], function: Callable
) -> dict[str, Any]:
    """Return what the function of a job was given as attributes, which are numbers and text.

    A list is written as JSON. A table of single values with names becomes an attribute for each
    entry, any other table JSON. Several problems have an attribute for each value that all of them
    share, and one for the values in which they differ. What the `variables` of the dataset hold is
    left out. `read` names the datasets that the `function` has read.
    """
    variables, found = set(variables), {}
    for name, value in given.items():
        problems = _problems(value)
        if not problems:
            found |= _plain(name, value)
            continue
        each = {key: describe_run("", one, one.solver) for key, one in problems.items()}
        shared = shared_by(each.values(), "case")
        own = {
            key: {part: one for part, one in about.items() if part not in {"case", *shared}}
            for key, about in each.items()
        }
        told = {part for one in own.values() for part in one} <= variables
        found |= shared | ({} if told else {name: _json(own)})
    known = {name: value for name, value in found.items() if value is not None}  # an infinite chain
    found = {name: value for name, value in known.items() if name not in variables}
    found[COMPUTED_BY] = f"{function.__module__}.{function.__name__}"
    return found | ({COMPUTED_FROM: ", ".join(read)} if read else {})


def _problems(value: Any) -> dict[str, Problem]:
    """Return problems by name, none where the value is something else."""
    if isinstance(value, Mapping):
        named = {str(key): one for key, one in value.items()}
    else:
        named = {str(k): one for k, one in enumerate(value if isinstance(value, list) else [value])}
    return named if all(isinstance(one, Problem) for one in named.values()) else {}


def _plain(name: str, value: Any) -> dict[str, Any]:
    if value is None:
        return {}
    if isinstance(value, Mapping) and all(map(_is_named, value, value.values())):
        start = "" if name == "constants" else f"{name}_"
        names = {key: name if key == "name" else f"{start}{key}" for key in value}
        return {names[key]: said for key, one in value.items() for said in _plain("", one).values()}
    as_it_is = isinstance(value, str | int | float | np.number) and not isinstance(value, bool)
    return {name: value if as_it_is else _json(value)}


def _is_named(key: Any, value: Any) -> bool:
    """Return whether an entry is a single value whose name can stand in that of an attribute."""
    single = value is None or isinstance(value, str | int | float | complex | np.generic)
    return single and f"_{key}".isidentifier()


def _json(value: Any) -> str:
    """Return JSON, and what it has no word for, such as a complex number, as Python writes it."""
    return json.dumps(value, default=lambda one: getattr(one, "tolist", one.__repr__)())
