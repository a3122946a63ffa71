"""Many runs of one problem: over axes of its values, and for members of an ensemble.

An axis names what it changes: a parameter of the model ("omega"), "half_width", "end_time", or the
initial value of a field at a site ("initial.0.1": site 0, the second field). Runs are numbered, the
last axis first and members fastest, and each depends on its number alone. `survey_runs` makes them.
"""

from collections.abc import Callable, Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np

from .ensembles import PERTURBATIONS
from .problem import Problem

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
    keep: tuple[str | Callable[..., float], ...] = ("max_l2",)
    window: tuple[float, float] | None = None
    """The span of time, both ends included, of maxima, means and exponents; None is the whole."""
    members: Members | None = None

    @property
    def shape(self) -> tuple[int, ...]:
        """The numbers of values of all axes, and of members where there are any."""
        sizes = tuple(len(values) for values in self.axes.values())
        return (*sizes, self.members.count) if self.members else sizes


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


def names_of(problem: Problem, survey: Survey) -> list[str]:
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
