"""Many runs of one problem: over axes of its values, and for members of an ensemble.

An axis names what it changes: a parameter of the model ("omega"), "half_width", "end_time", or the
initial value of a field at a site ("initial.0.1": site 0, the second field). Names separated by
commas vary together; each value of such an axis is a tuple. Runs are numbered with the members
fastest, then the last axis, and each depends only on its number. `survey_runs` executes them.
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
CHAINS = ("exponent", "divergence")
"""Names of results with one number per field, and of those with one number per run."""
NAMES = (*OF_FIELDS, *CHAINS)
"""Names of all results that a survey can keep."""


class Members(NamedTuple):
    """An ensemble: `count` copies of each run with a relative perturbation `size` of the data."""

    count: int
    size: float
    seed: int
    kind: str = "even"  # a key of PERTURBATIONS


class Survey(NamedTuple):
    """The runs of a survey of one problem, and the results kept of each."""

    axes: Mapping[str, Sequence]
    keep: tuple[str | Callable[..., Any], ...] = ("max_l2",)
    """Names, and functions that take the problem of a run and its trajectory."""
    window: tuple[float, float] | None = None
    """Time window of maxima, means and exponents, both ends included; None for the whole run."""
    members: Members | None = None
    by_half_width: Mapping[int, Mapping[str, Any]] = MappingProxyType({})
    """Values at all sites of the parameters that are functions of the site, by half-width."""

    @property
    def shape(self) -> tuple[int, ...]:
        """The lengths of all axes, followed by the number of members if there are any."""
        sizes = tuple(len(values) for values in self.axes.values())
        return (*sizes, self.members.count) if self.members else sizes


class Surveyed(Sequence):
    """The sequence of problems of a survey, each created when it is read."""

    def __init__(self, problem: Problem, survey: Survey):
        self.problem, self.survey = problem, survey
        self.shape, self.names = survey.shape, [names_of_axis(axis) for axis in survey.axes]

    def __len__(self) -> int:
        return prod(self.shape)

    def values_of(self, number: int) -> dict[str, Any]:
        """Return the values on the axes of a run, by name."""
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
            raise ValueError(f"keep: there is no {quantity!r}; there are {', '.join(NAMES)}")
        if callable(quantity) and (fault := _fault_of_function(quantity)):
            raise ValueError(f"keep: {fault}")
    return [
        quantity if isinstance(quantity, str) else quantity.__name__ for quantity in survey.keep
    ]


def _fault_of_function(function: Callable) -> str | None:
    name = getattr(function, "__name__", "")
    if not name.isidentifier():
        return "a function is kept under its name, and this one has none: make it by def"
    try:
        inspect.signature(function).bind(None, None)
    except TypeError:
        return f"{name} must take (problem, run)"
    return None


def fault_of_axis(
    name: str, parameters: Collection[str], sites: Collection[int], fields: int
) -> str | None:
    """Return why the name of an axis is invalid, None if it is valid.

    `sites` are those with initial values, and `fields` is the number of fields.
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
        return f"{name!r} names nothing to change; give one of {options}, or initial.SITE.FIELD"
    site, field = map(int, place)
    if site not in sites or not 0 <= field < fields:
        known = ", ".join(map(str, sorted(sites)))
        return f"{name!r} has no initial value: the sites {known} do, in the fields 0..{fields - 1}"
    return None
