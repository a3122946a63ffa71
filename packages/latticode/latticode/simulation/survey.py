"""Many runs of one problem: over axes of its values, and for members of an ensemble.

An axis names what it changes: a parameter of the model ("omega"), "half_width", "end_time", or the
initial value of a field at a site ("initial.0.1": site 0, the second field). Names with commas
between them vary together, and each value of their axis has as many numbers. Runs are numbered, the
last axis first and members fastest, and each depends on its number alone. `survey_runs` makes them.
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
"""Names of what is one number for each field, and of what is one for the whole chain."""
NAMES = (*OF_FIELDS, *CHAINS)
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
    keep: tuple[str | Callable[..., Any], ...] = ("max_l2",)
    """Names, and functions that take the problem of a run and its trajectory."""
    window: tuple[float, float] | None = None
    """The span of time, both ends included, of maxima, means and exponents; None is the whole."""
    members: Members | None = None
    by_half_width: Mapping[int, Mapping[str, Any]] = MappingProxyType({})
    """Values on all sites of the parameters that are functions of the sites, for each half-width
    of an axis."""

    @property
    def shape(self) -> tuple[int, ...]:
        """The numbers of values of all axes, and of members where there are any."""
        sizes = tuple(len(values) for values in self.axes.values())
        return (*sizes, self.members.count) if self.members else sizes


class Surveyed(Sequence):
    """The problems of the runs of a survey, each of which is made when it is asked for.

    They keep moduli as the first one does.
    """

    def __init__(self, problem: Problem, survey: Survey):
        self.problem, self.survey = problem, survey
        self.shape, self.names = survey.shape, [names_of_axis(axis) for axis in survey.axes]

    def __len__(self) -> int:
        return prod(self.shape)

    def values_of(self, number: int) -> dict[str, Any]:
        """Return what a run changes, by name; members are not among it."""
        place = np.unravel_index(number, self.shape) if self.shape else ()
        values: dict[str, Any] = {}
        for names, axis, i in zip(self.names, self.survey.axes.values(), place, strict=False):
            values |= zip(names, axis[i] if len(names) > 1 else [axis[i]], strict=True)
        return values

    def place_of(self, number: int) -> str:
        """Return where a run stands in the survey: "omega = 2, member 5"."""
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
    """Return what varies along an axis."""
    return [name.strip() for name in axis.split(",")]


def names_of(survey: Survey) -> list[str]:
    """Return the names of what is kept; raise ValueError for what there is not."""
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
    """Return why nothing has the name of an axis, None if it has a meaning.

    `sites` have initial values, of so many fields.
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
