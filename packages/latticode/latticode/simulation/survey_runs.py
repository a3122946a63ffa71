"""The runs of a survey, in parts, and what is kept of each.

What is kept of a run is reduced as soon as the run is over, so that the memory of a survey is that
of its results. A part is every so many-th run, so that parts take alike long, and a survey has the
same bits in any number of parts.
"""

import threading
from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import FIRST_EXCEPTION, ThreadPoolExecutor, wait
from math import prod
from typing import Any

import numpy as np

from latticode.measures.difference import VISIBLE, first_above, norm_difference
from latticode.measures.spreading import lay_line
from latticode.numerics.elementary import log

from .problem import Problem
from .simulate import IntegrationError, Trajectory, simulate
from .survey import CHAINS, Survey, fault_of_axis, names_of, problem_at
from .sweep import mean_of, within


def run_part(
    problem: Problem,
    survey: Survey,
    part: int = 0,
    parts: int = 1,
    progress: Callable[[int, int], None] = lambda done, count: None,
) -> dict[str, np.ndarray]:
    """Return what is kept of every `parts`-th run from number `part` on, each (run, ...).

    `progress` is called with the number of runs that are done, and of all in the part. A run that
    cannot be made to its end has NaN. Raises ValueError for what cannot be kept or
    changed.
    """
    names = names_of(survey)
    known = {**problem.model.parameters, **problem.parameters}
    reach, fields = problem.initial.shape[1] // 2, len(problem.initial)
    for axis in survey.axes:
        if fault := fault_of_axis(axis, known, range(-reach, reach + 1), fields):
            raise ValueError(f"axes: {fault}")
    numbers = range(part, prod(survey.shape), parts)
    found: dict[str, list] = {name: [] for name in names}
    for done, number in enumerate(numbers, 1):
        for name, value in _kept_of(problem_at(problem, survey, number), survey).items():
            found[name].append(value)
        progress(done, len(numbers))
    return {name: np.array(values) for name, values in found.items()}


def joined(survey: Survey, parts: Sequence[Mapping[str, np.ndarray]]) -> dict[str, np.ndarray]:
    """Return what all parts of a survey hold, each of the survey's shape and behind it fields."""
    found = {}
    for name, first in parts[0].items():
        values = np.empty((prod(survey.shape), *first.shape[1:]))
        for number, part in enumerate(parts):
            values[number :: len(parts)] = part[name]
        found[name] = values.reshape(*survey.shape, *first.shape[1:])
    return found


def run_survey(problem: Problem, survey: Survey, cores: int = 1) -> dict[str, np.ndarray]:
    """Return the whole survey, in a part for each core: kernels run beside each other in threads.

    Ctrl-C ends it when the runs that are at work are over.
    """
    ended = threading.Event()

    def go_on(done: int, count: int) -> None:
        if ended.is_set():
            raise KeyboardInterrupt

    parts = max(1, min(cores, prod(survey.shape)))
    with ThreadPoolExecutor(parts) as pool:
        made = [pool.submit(run_part, problem, survey, n, parts, go_on) for n in range(parts)]
        try:
            over, _ = wait(made, return_when=FIRST_EXCEPTION)
        finally:
            ended.set()
        for part in over:  # what ended one is told, and not that it ended the others
            part.result()
        return joined(survey, [part.result() for part in made])


def _kept_of(problem: Problem, survey: Survey) -> dict[str, Any]:
    """Return what is kept of one run."""
    fields = len(problem.initial)
    try:
        run = simulate(problem, energy=False)
    except IntegrationError:
        run = None
    found = {}
    for kept in survey.keep:
        if callable(kept):
            found[kept.__name__] = np.nan if run is None else float(kept(run))
        elif run is None:
            found[kept] = np.nan if kept in CHAINS else np.full(fields, np.nan)
        elif kept == "divergence":
            found[kept] = _divergence(problem, run)
        elif kept == "exponent":
            found[kept] = _exponent(run, survey.window)
        else:
            found[kept] = _statistic(run, survey.window, *kept.split("_"))
    return found


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
    other = "dop853" if problem.solver["name"] in ("taylor", "auto") else "taylor"
    try:
        again = simulate(
            problem.changed(solver={"name": other, "rtol": 1e-13, "atol": 1e-13}), energy=False
        )
    except IntegrationError:
        return np.nan
    apart = norm_difference(run.linf, run.l2, again.linf, again.l2)
    return float(first_above(run.tau, apart, VISIBLE))
