"""Surveys as datasets: each axis is a dimension, and each kept result a variable."""

import json
from collections.abc import Iterable, Mapping, Sequence
from math import prod
from typing import TYPE_CHECKING, Any

import numpy as np

from latticode.integrators.families import instead_of_taylor
from latticode.simulation.problem import Problem
from latticode.simulation.runs import ManyRuns, Retained
from latticode.simulation.survey import OF_FIELDS, OF_RUNS, Members, Survey, names_of_axis
from latticode.simulation.survey_runs import TEXT, runs_of_survey

from .netcdf import Variable
from .registry import NAMES
from .stated import describe_run
from .trajectories import Contents

if TYPE_CHECKING:
    from xarray import Dataset

LONG_NAMES = {
    "max": "largest {norm} in the window",
    "mean": "mean of the {norm} over the window",
    "final": "{norm} at the end time",
    "exponent": "exponent of time with which the power of all fields grows in the window",
    "divergence": "first time at which a run by another method differs visibly; infinite: never",
}
"""Long names of kept results."""
TEXTS = {
    "failure": "why a run failed, so its results are NaN; empty if it did not fail",
    "remark": "why a run is not by the solver of the case; empty if it is",
    "unfinished": "why a run was not executed; empty if it was",
}
"""Long names of the variables with messages on runs; most runs have empty messages."""
COUNTS = {
    "failure": "failed_runs",
    "remark": "runs_by_another_solver",
    "unfinished": "unfinished_runs",
}
"""Attributes with the number of runs that have a message, by the variable of the messages."""


def make_survey(name: str, problem: Problem, survey: Mapping[str, Any]) -> ManyRuns:
    """Return the runs of a survey in plain values; the result of the study is its `Contents`."""
    members = survey["members"] and Members(**survey["members"])
    plan = Survey(
        survey["axes"],
        tuple(survey["keep"]),
        survey["window"],
        members,
        survey["by_half_width"],
    )
    runs = runs_of_survey(problem, plan)

    def contents(retained: dict[str, np.ndarray]) -> Contents:
        return survey_contents(name, problem, plan, runs.conclude(retained))

    return runs._replace(conclude=contents)


def survey_contents(
    name: str, problem: Problem, survey: Survey, values: Mapping[str, np.ndarray]
) -> Contents:
    """Return the contents of the dataset of a survey of `problem`; `values` has its results."""
    axes = {axis: names_of_axis(axis) for axis in survey.axes}
    dimensions = [_without_index(names[0]) for names in axes.values()]
    variables = {}
    for (axis, names), dimension in zip(axes.items(), dimensions, strict=True):
        axis_values = survey.axes[axis]
        columns = [axis_values] if len(names) == 1 else zip(*axis_values, strict=True)
        for axis_name, column in zip(names, columns, strict=True):
            variables[_without_index(axis_name)] = _axis(
                axis_name, dimension, column, problem.model.fields
            )
    if survey.members:
        dimensions.append("member")
        variables["member"] = Variable(("member",), np.arange(survey.members.count))
    result_names = problem.equations.names
    variables["component"] = Variable(
        ("component",), list(result_names.components), result_names.component
    )
    texts = {kind: values[kind] for kind in TEXTS if kind in values}
    for kind, values_of_number in texts.items():
        variables[kind] = Variable(tuple(dimensions), values_of_number, TEXTS[kind])
    for name_of_number, values_of_number in values.items():
        if name_of_number in texts:
            continue
        more = values_of_number.ndim - len(dimensions)
        fields = (
            ("component",)
            if name_of_number in OF_FIELDS
            else tuple(f"{name_of_number}_{n}" for n in range(more))
        )
        units = result_names.units if name_of_number in OF_FIELDS else "1"
        variables[name_of_number] = Variable(
            (*dimensions, *fields), values_of_number, _long_name(name_of_number), units
        )
    remarks, solver = texts.get("remark", np.array("")), problem.solver
    solver = instead_of_taylor(solver) if (remarks != "").all() else solver
    run_attributes = describe_run(name, problem, solver)
    for names in axes.values():
        run_attributes = {key: value for key, value in run_attributes.items() if key not in names}
    drawn = survey.members._asdict() if survey.members else {}
    survey_attributes = {f"members_{key}": value for key, value in drawn.items()}
    survey_attributes |= {} if survey.window is None else {"window": list(survey.window)}
    if survey.by_half_width:
        survey_attributes["parameters_by_half_width"] = json.dumps(survey.by_half_width)
    survey_attributes["failed_runs"] = 0
    survey_attributes |= {COUNTS[kind]: int((texts[kind] != "").sum()) for kind in texts}
    return variables, {"title": f"The survey {name}", **run_attributes, **survey_attributes}


def runs_in(survey: "Dataset", names: Iterable[str], shape: Sequence[int]) -> Retained:
    """Return the kept results of the finished runs in the dataset of an interrupted survey."""
    texts = np.full(prod(shape), "", object)
    for kind in (kind for kind in TEXTS if kind in survey):
        messages = survey[kind].values.ravel()
        texts = np.where(messages == "", texts, [f"{kind}: {text}" for text in messages])
    columns = {name: survey[name].values for name in names}
    columns = {
        name: array.reshape(-1, *array.shape[len(shape) :]) for name, array in columns.items()
    }
    columns[TEXT] = texts.astype(str)
    done = np.flatnonzero(~np.char.startswith(columns[TEXT], "unfinished"))
    return {int(n): {name: array[n] for name, array in columns.items()} for n in done}


def _without_index(axis: str) -> str:
    """Return the name of an axis without dots and minus signs, so that it can name a variable."""
    return axis.replace(".-", "_minus_").replace(".", "_")


def _axis(axis: str, dimension: str, axis_values: Sequence, fields: Sequence[str]) -> Variable:
    """Return the variable of an axis; complex values become strings, as Python prints them."""
    values = np.asarray(axis_values)
    if np.iscomplexobj(values):
        values = values.real if not values.imag.any() else np.array([str(z) for z in values])
    if axis.startswith("initial."):
        site, field = axis.split(".")[1:]
        words = f"initial {fields[int(field)]} at site {site}"
    else:
        words = NAMES.get(axis, axis)
    return Variable((dimension,), values, words)


def _long_name(number: str) -> str:
    statistic, _, norm = number.partition("_")
    if number in OF_RUNS:
        return LONG_NAMES[number]
    if number in OF_FIELDS:
        return LONG_NAMES[statistic].format(norm=NAMES[norm])
    return f"result of the function {number}"
