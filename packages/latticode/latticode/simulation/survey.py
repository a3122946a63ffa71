"""Many runs of one problem: over axes of its values, and for members of an ensemble.

An axis names what it changes: a parameter of the model ("omega"), "half_width", "end_time", or the
initial value of a field at a site ("initial.0.1": site 0, the second field). Runs are numbered, the
last axis first and members fastest, and each depends on its number alone. `survey_runs` makes them.
"""

from collections.abc import Callable, Collection, Mapping, Sequence
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


def names_of(survey: Survey) -> list[str]:
    """Return the names of what is kept; raise ValueError for what there is not."""
    for kept in survey.keep:
        if not callable(kept) and kept not in NAMES:
            raise ValueError(f"keep: there is no {kept!r}; there are {', '.join(NAMES)}")
    return [kept if isinstance(kept, str) else kept.__name__ for kept in survey.keep]


def fault_of_axis(
    name: str, parameters: Collection[str], sites: Collection[int], fields: int
) -> str | None:
    """Return why nothing has the name of an axis, None if it has a meaning.

    `sites` have initial values, of so many fields.
    """
    if name in parameters or name in ("half_width", "end_time"):
        return None
    head, *place = name.split(".")
    if head != "initial" or len(place) != 2 or not all(one.lstrip("-").isdigit() for one in place):
        options = ", ".join([*parameters, "half_width", "end_time"])
        return f"{name!r} names nothing to change; give one of {options}, or initial.SITE.FIELD"
    site, field = map(int, place)
    if site not in sites or not 0 <= field < fields:
        known = ", ".join(map(str, sorted(sites)))
        return f"{name!r} has no initial value: the sites {known} do, in the fields 0..{fields - 1}"
    return None
