"""Many runs of one problem, with values that vary along axes, and with members of an ensemble.

An axis names what it changes: a parameter of the model ("omega"), "half_width", "end_time", or the
initial value of a field at a site ("initial.0.1": site 0, the second field). Names separated by
commas vary together; each value of such an axis is a tuple. In the order of runs the member varies
fastest, then the last axis. A run depends only on its number. `survey_runs` executes the runs.
"""

import inspect
from collections.abc import Callable, Collection, Mapping, Sequence
from math import prod
from types import MappingProxyType
from typing import Any, NamedTuple

import numpy as np

from latticode.equations.ensembles import perturbed

from .problem import Problem

STATISTICS, NORMS = ("max", "mean", "final"), ("l2", "linf")
OF_FIELDS = tuple(f"{statistic}_{norm}" for statistic in STATISTICS for norm in NORMS)
OF_RUNS = ("exponent", "divergence")
"""OF_FIELDS: names of results with one number per field. OF_RUNS: one number per run."""
NAMES = (*OF_FIELDS, *OF_RUNS)
"""Names of all results that a survey can keep."""


class Members(NamedTuple):
    """An ensemble: `count` runs, whose initial data have relative perturbations of size `size`."""

    count: int
    size: float
    seed: int
    kind: str = "even"  # a key of PERTURBATIONS


class Survey(NamedTuple):
    """The runs of a survey of one problem, and the results that are kept of each run."""

    axes: Mapping[str, Sequence]
    keep: tuple[str | Callable[..., Any], ...] = ("max_l2",)
    """Names of results, or functions of the problem and the trajectory of a run."""
    window: tuple[float, float] | None = None
    """Time window of maxima, means and exponents, both ends included; None for the whole run."""
    members: Members | None = None
    by_half_width: Mapping[int, Mapping[str, Any]] = MappingProxyType({})
    """Values of the parameters that are functions of the site, by half-width."""

    @property
    def shape(self) -> tuple[int, ...]:
        """The lengths of all axes, followed by the number of members if there are any."""
        sizes = tuple(len(values) for values in self.axes.values())
        return (*sizes, self.members.count) if self.members else sizes


class Surveyed(Sequence):
    """The sequence of problems of a survey, each created when it is read."""

    def __init__(self, problem: Problem, survey: Survey) -> None:
        self.problem, self.survey = problem, survey
        self.shape, self.names = survey.shape, [names_of_axis(axis) for axis in survey.axes]

    def __len__(self) -> int:
        return prod(self.shape)

    def values_of(self, number: int) -> dict[str, Any]:
        """Return the values that vary along the axes, by name, in one run."""
        place = np.unravel_index(number, self.shape) if self.shape else ()
        values: dict[str, Any] = {}
        for names, axis, i in zip(self.names, self.survey.axes.values(), place, strict=False):
            values |= zip(names, axis[i] if len(names) > 1 else [axis[i]], strict=True)
        return values

    def place_of(self, number: int) -> str:
        """Return a description of a run such as "omega = 2, member 5"."""
        named = [f"{name} = {value:g}" for name, value in self.values_of(number).items()]
        members = self.survey.members
        return ", ".join([*named, *([f"member {number % members.count}"] if members else [])])

    def __getitem__(self, number: int) -> Problem:
        if not 0 <= number < len(self):
            raise IndexError(f"there is no run {number}")
        values = self.values_of(number)
        changes: dict[str, Any] = {**self.survey.by_half_width.get(values.get("half_width"), {})}
        initial = None
        for name, value in values.items():
            if name.startswith("initial."):
                initial = np.array(self.problem.initial) if initial is None else initial
                site, field = map(int, name.split(".")[1:])
                initial[field, site - self.problem.first_site_of_data] = value
            else:
                changes[name] = value
        if members := self.survey.members:
            data = self.problem.initial if initial is None else initial
            rng = np.random.default_rng([members.seed, number])
            initial = perturbed(self.problem, data, members.size, rng, members.kind)
        return self.problem.changed(**changes, **({} if initial is None else {"initial": initial}))


def names_of_axis(axis: str) -> list[str]:
    """Return the names of the values that vary along an axis."""
    return [name.strip() for name in axis.split(",")]


def names_of(survey: Survey) -> list[str]:
    """Return the names of the kept results; raise ValueError for an unknown one."""
    for quantity in survey.keep:
        if not callable(quantity) and quantity not in NAMES:
            raise ValueError(f"keep: unknown result {quantity!r}; give one of {', '.join(NAMES)}")
        if callable(quantity) and (reason := _why_invalid(quantity)):
            raise ValueError(f"keep: {reason}")
    return [
        quantity if isinstance(quantity, str) else quantity.__name__ for quantity in survey.keep
    ]


def _why_invalid(function: Callable) -> str | None:
    name = getattr(function, "__name__", "")
    if not name.isidentifier():
        return "a function is stored under its name, and this one has none (a lambda?): use def"
    try:
        inspect.signature(function).bind(None, None)
    except TypeError:
        return f"{name} must accept the arguments (problem, run)"
    return None


def fault_of_axis(
    name: str, parameters: Collection[str], sites: Collection[int], fields: int
) -> str | None:
    """Return the reason why the name of an axis is invalid, or None if it is valid.

    `sites` are the sites with initial values; `fields` is the number of fields.
    """
    if name in parameters or name in ("half_width", "end_time"):
        return None
    head, *place = name.split(".")
    if (
        head != "initial"
        or len(place) != 2
        or not all(number.lstrip("-").isdigit() for number in place)
    ):
        options = ", ".join([*parameters, "half_width", "end_time"])
        return f"{name!r} cannot be varied; give one of {options}, or initial.SITE.FIELD"
    site, field = map(int, place)
    if site not in sites or not 0 <= field < fields:
        known = ", ".join(map(str, sorted(sites)))
        allowed = f"SITE is one of {known}, and FIELD one of 0..{fields - 1}"
        return f"{name!r} has no initial value: {allowed}"
    return None
