"""Many runs of one problem: over axes of its values, for members of an ensemble, in parts.

An axis names what it changes: a parameter of the model ("omega"), "half_width", "end_time", or the
initial value of a field at a site ("initial.0.1": site 0, the second field). What is kept of a run
is reduced as soon as the run is over, so that the memory of a survey is that of its results.

Runs are numbered, the last axis first and members fastest. A part of a survey is every so many-th
run, so that parts take alike long; each run depends on its number alone, and a survey has the same
bits in any number of parts.
"""

from collections.abc import Callable, Mapping, Sequence
from math import prod
from typing import Any, NamedTuple

import numpy as np

from latticode.measures.difference import VISIBLE, first_above, norm_difference
from latticode.measures.spreading import lay_line
from latticode.numerics.elementary import log

from .ensembles import PERTURBATIONS
from .problem import Problem
from .simulate import IntegrationError, Trajectory, simulate
from .sweep import mean_of, within

STATISTICS, NORMS = ("max", "mean", "final"), ("l2", "linf")
CHAINS = ("exponent", "divergence")
"""Names of what is one number for the whole chain; all others are one for each field."""
NAMES = (*(f"{statistic}_{norm}" for statistic in STATISTICS for norm in NORMS), *CHAINS)
"""What can be kept of a run by name."""


class Members(NamedTuple):
    """An ensemble: so many copies of each run, with data that differ by a relative `size`."""

    count: int
    size: float
    seed: int
    kind: str = "even"  # a key of PERTURBATIONS


class Survey(NamedTuple):
    """Which runs are made of a problem, and what is kept of each."""

    axes: Mapping[str, Sequence]
    keep: tuple[str | Callable[[Trajectory], float], ...] = ("max_l2",)
    window: tuple[float, float] | None = None
    """The span of time, both ends included, of maxima, means and exponents; None is the whole."""
    members: Members | None = None

    @property
    def shape(self) -> tuple[int, ...]:
        """The numbers of values of all axes, and of members where there are any."""
        sizes = tuple(len(values) for values in self.axes.values())
        return (*sizes, self.members.count) if self.members else sizes


def run_part(
    problem: Problem,
    survey: Survey,
    part: int = 0,
    parts: int = 1,
    progress: Callable[[str], None] = lambda message: None,
) -> dict[str, np.ndarray]:
    """Return what is kept of every `parts`-th run from number `part` on, each (run, ...).

    A run that cannot be made to its end has NaN. Raises ValueError for what cannot be kept or
    changed.
    """
    names = _checked(problem, survey)
    numbers = range(part, prod(survey.shape), parts)
    found: dict[str, list] = {name: [] for name in names}
    for done, number in enumerate(numbers, 1):
        for name, value in _kept_of(problem_at(problem, survey, number), survey).items():
            found[name].append(value)
        if done % 1000 == 0:
            progress(f"{done} of {len(numbers)} runs done")
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


def run_survey(problem: Problem, survey: Survey) -> dict[str, np.ndarray]:
    """Return the whole survey, made in one part."""
    return joined(survey, [run_part(problem, survey)])


def problem_at(problem: Problem, survey: Survey, number: int) -> Problem:
    """Return the problem of one run."""
    place = np.unravel_index(number, survey.shape) if survey.shape else ()
    values = {name: axis[i] for (name, axis), i in zip(survey.axes.items(), place, strict=False)}
    changes: dict[str, Any] = {"snapshot_every": 0}
    initial = None
    for name, value in values.items():
        if name.startswith("initial."):
            initial = np.array(problem.initial) if initial is None else initial
            site, field = map(int, name.split(".")[1:])
            initial[field, initial.shape[1] // 2 + site] = value
        else:
            changes[name] = value
    if survey.members:
        data = problem.initial if initial is None else initial
        rng = np.random.default_rng([survey.members.seed, number])
        initial = PERTURBATIONS[survey.members.kind](data, survey.members.size, rng)
    return problem.changed(**changes, **({} if initial is None else {"initial": initial}))


def _checked(problem: Problem, survey: Survey) -> list[str]:
    """Return the names of what is kept; raise ValueError for what cannot be kept or changed."""
    for name in survey.axes:
        _require_axis(problem, name)
    for kept in survey.keep:
        if not callable(kept) and kept not in NAMES:
            raise ValueError(f"keep: there is no {kept!r}; there are {', '.join(NAMES)}")
    return [kept if isinstance(kept, str) else kept.__name__ for kept in survey.keep]


def _require_axis(problem: Problem, name: str) -> None:
    known = {**problem.model.parameters, **problem.parameters}
    if name in known or name in ("half_width", "end_time"):
        return
    head, *place = name.split(".")
    reach, fields = problem.initial.shape[1] // 2, len(problem.initial)
    if head != "initial" or len(place) != 2 or not all(one.lstrip("-").isdigit() for one in place):
        options = f"{', '.join(known)}, half_width, end_time, or initial.SITE.FIELD"
        raise ValueError(f"axes: {name!r} names nothing to change; give one of {options}")
    site, field = map(int, place)
    if abs(site) > reach or not 0 <= field < fields:
        raise ValueError(
            f"axes: {name!r} is outside the initial data, which have the sites -{reach}..{reach} "
            f"and the fields 0..{fields - 1}"
        )


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
