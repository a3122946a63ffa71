"""The runs of a survey, and what is kept of each by name."""

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
from .survey import CHAINS, Survey, Surveyed, fault_of_axis, names_of, names_of_axis
from .sweep import mean_of, within


def run_survey(problem: Problem, survey: Survey, run: Run = run_all) -> dict[str, np.ndarray]:
    """Return a whole survey, each of the survey's shape and behind it what is kept.

    A run that cannot be made to its end has NaN, and its reason in "failure"; a run that is not by
    the solver of the problem has its reason in "remark". A line is printed of each kind. Raises
    ValueError for what cannot be kept or changed.
    """
    return runs_of_survey(problem, survey).make(run)


def runs_of_survey(problem: Problem, survey: Survey) -> ManyRuns:
    """Return the runs of a survey, which conclude with what `run_survey` returns.

    Raises ValueError for what cannot be kept or changed.
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
    """Return what is kept of all runs in the survey's shape; print what failed."""
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
    "remark": "are by another solver",
    "unfinished": "are not made; to go on from the others, give the result as resume",
}
"""What is printed of runs by the kind of their text."""
TEXT = "text"
"""Under which name a run keeps why it failed, or why it is by another solver; empty if neither."""


def _measure_run(problem: Problem, survey: Survey) -> dict[str, Any]:
    """Return what is kept of one run."""
    fields = len(problem.initial)
    try:
        functions = any(map(callable, survey.keep))  # they may read what is conserved
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
            quantities[quantity] = np.nan if quantity in CHAINS else np.full(fields, np.nan)
        elif quantity == "divergence":
            quantities[quantity] = _divergence(problem, run)
        elif quantity == "exponent":
            quantities[quantity] = _exponent(run, survey.window)
        else:
            quantities[quantity] = _statistic(run, survey.window, *quantity.split("_"))
    return quantities


def _statistic(run: Trajectory, window, statistic: str, norm: str) -> np.ndarray:
    """Return the largest, the mean or the last value of a norm of each field, (field,)."""
    series = getattr(run, norm)
    if statistic == "final":
        return series[:, -1]
    inside = series if window is None else series[:, within(run.tau, window)]
    return inside.max(axis=1) if statistic == "max" else mean_of(inside)


def _exponent(run: Trajectory, window: tuple[float, float] | None) -> float:
    """Return the exponent of time with which the power of all fields grows in the window."""
    start, end = window or (run.tau[1], run.tau[-1])
    inside = within(run.tau, (start, end)) & (run.tau > 0.0)
    power = np.add.reduce(run.l2 * run.l2)[inside]
    if not power.all():
        return np.nan
    return lay_line(log(run.tau[inside]), log(power)).slope


def _divergence(problem: Problem, run: Trajectory) -> float:
    """Return the first time at which a run by another method differs by the visible part."""
    method = other_family(run.solver["name"], problem.equations.methods)
    try:
        second_run = simulate(
            problem.changed(solver={"name": method, "rtol": 1e-13, "atol": 1e-13}), conserved=False
        )
    except IntegrationError:
        return np.nan
    difference = norm_difference(run.linf, run.l2, second_run.linf, second_run.l2)
    return float(first_above(run.tau, difference, VISIBLE))
