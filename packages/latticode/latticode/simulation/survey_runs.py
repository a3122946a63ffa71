"""Execution of a survey, and the results that are kept of each run."""

from functools import partial
from typing import Any

import numpy as np

from latticode.integrators.families import other_family, remark_on
from latticode.measures.difference import VISIBLE, first_above, norm_difference
from latticode.measures.spreading import lay_line
from latticode.numerics.elementary import log

from .problem import Problem
from .runs import ManyRuns, Run, reshape_runs, run_all
from .simulate import IntegrationError, Trajectory, simulate
from .survey import OF_RUNS, Survey, Surveyed, fault_of_axis, names_of, names_of_axis
from .sweep import mean_of, within


def run_survey(problem: Problem, survey: Survey, run: Run = run_all) -> dict[str, np.ndarray]:
    """Return the results of a survey by name, each (*survey.shape, ...).

    A failed run has NaN and the reason in "failure". A run that used another solver than the
    problem's has the reason in "remark". Prints one line about all failures, and one about all
    remarks. Raises ValueError for an unknown result or axis.
    """
    return runs_of_survey(problem, survey).make(run)


def runs_of_survey(problem: Problem, survey: Survey) -> ManyRuns:
    """Return the runs of a survey; their conclusion is the result of `run_survey`.

    Raises ValueError for an unknown result or axis.
    """
    names_of(survey)
    known = {**problem.model.parameters, **problem.parameters}
    reach, fields = problem.initial.shape[1] // 2, len(problem.initial)
    for name in (name for axis in survey.axes for name in names_of_axis(axis)):
        if fault := fault_of_axis(name, known, range(-reach, reach + 1), fields):
            raise ValueError(f"axes: {fault}")
    problems = Surveyed(problem, survey)
    return ManyRuns(problems, partial(_measure_run, survey=survey), partial(_in_shape, problems))


def _in_shape(problems: Surveyed, table: dict[str, np.ndarray]) -> dict[str, np.ndarray]:
    """Return the results of all runs in the survey's shape; print a line for each of KINDS."""
    texts = table.pop(TEXT)
    for kind, outcome in KINDS.items():
        chosen = np.char.startswith(texts, kind)
        if chosen.any():
            table[kind] = np.char.replace(np.where(chosen, texts, ""), f"{kind}: ", "", 1)
            first = int(chosen.argmax())
            at = problems.place_of(first)
            count = f"{chosen.sum()} of {len(problems)} runs {outcome}"
            print(f"{count}; the first, {at}: {table[kind][first]}", flush=True)
    return reshape_runs(table, problems.survey.shape)


KINDS = {
    "failure": "failed and have NaN",
    "remark": "used another solver",
    "unfinished": "are unfinished; to continue, pass the result as resume",
}
"""Printed description of runs, by the key with which their text begins."""
TEXT = "text"
"""Name of the result that has the reason of a failure or remark, else an empty text."""


def _measure_run(problem: Problem, survey: Survey) -> dict[str, Any]:
    """Return the kept results of one run by name; NaN if it failed."""
    fields = len(problem.initial)
    try:
        functions = any(map(callable, survey.keep))  # they may read conserved quantities
        run, text = simulate(problem, conserved=functions), ""
        if remark := remark_on(run.solver):
            text = f"remark: {remark}"
    except IntegrationError as error:
        run, text = None, f"failure: {error}"
    quantities = {TEXT: text}
    for quantity in survey.keep:
        if callable(quantity):
            quantities[quantity.__name__] = np.nan if run is None else quantity(problem, run)
        elif run is None:
            quantities[quantity] = np.nan if quantity in OF_RUNS else np.full(fields, np.nan)
        elif quantity == "divergence":
            quantities[quantity] = _divergence(problem, run)
        elif quantity == "exponent":
            quantities[quantity] = _exponent(run, survey.window)
        else:
            quantities[quantity] = _statistic(run, survey.window, *quantity.split("_"))
    return quantities


def _statistic(
    run: Trajectory, window: tuple[float, float] | None, statistic: str, norm: str
) -> np.ndarray:
    """Return the maximum, mean or final value of a norm of each field, (field,)."""
    series = getattr(run, norm)
    if statistic == "final":
        return series[:, -1]
    inside = series if window is None else series[:, within(run.tau, window)]
    return inside.max(axis=1) if statistic == "max" else mean_of(inside)


def _exponent(run: Trajectory, window: tuple[float, float] | None) -> float:
    """Return the exponent q of the fit of a power law tau^q to the total power in the window."""
    start, end = window or (run.tau[1], run.tau[-1])
    inside = within(run.tau, (start, end)) & (run.tau > 0.0)
    power = np.add.reduce(run.l2 * run.l2)[inside]
    if not power.all():
        return np.nan
    return lay_line(log(run.tau[inside]), log(power)).slope


def _divergence(problem: Problem, run: Trajectory) -> float:
    """Return the first time at which a run by another method differs visibly; inf if never."""
    method = other_family(run.solver["name"], problem.equations.methods)
    solver = {"name": method, "rtol": 1e-13, "atol": 1e-13}
    try:
        second_run = simulate(problem.changed(solver=solver), conserved=False)
    except IntegrationError:
        return np.nan
    difference = norm_difference(run.linf, run.l2, second_run.linf, second_run.l2)
    return float(first_above(run.tau, difference, VISIBLE))
