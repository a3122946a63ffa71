"""A survey as a user writes it: its case, axes, members, kept results and number of chunks."""

from collections.abc import Collection, Iterator
from math import prod
from typing import Annotated, Any

import numpy as np
from pydantic import BeforeValidator, Field, ValidationError, model_validator

from latticode.equations.ensembles import PERTURBATIONS
from latticode.simulation import survey

from .cases import CaseSection
from .messages import lines_of
from .values import (
    Complex,
    Count,
    Distinct,
    Integer,
    Name,
    Number,
    Positive,
    Section,
    Window,
    excerpt_of,
    fault,
    faults,
)

MOST_RUNS = 10_000_000
FARTHEST = 5.0
"""Largest expected random number, in standard deviations; normal ones are rarely larger."""
MOST_CHECKED = 1000
"""Axes up to this length are checked in full before the runs; longer ones only at both ends."""


class GridSection(Section):
    """Equally spaced values of an axis, both ends included."""

    first: Number
    last: Number
    points: Annotated[Integer, Field(ge=2, le=MOST_RUNS)]

    @property
    def values(self) -> list[float]:
        """The values, each rounded to twelve digits."""
        return [float(f"{x:.12g}") for x in np.linspace(self.first, self.last, self.points)]


def _as_axis(value: Any) -> Any:
    """Return the values of an axis; rejects an array in place of a number."""
    if isinstance(value, dict):
        return GridSection.model_validate(value).values
    if isinstance(value, list) and any(isinstance(item, list | np.ndarray) for item in value):
        raise fault(
            "has a list where each run needs one number; to vary values by site, vary a number"
            " that multiplies them in the equations, such as p.strength in p.strength * p.disorder"
        )
    return value


def _one_of(known: Collection[str]) -> BeforeValidator:
    def check(name: Any) -> Any:
        if name not in known:
            raise fault(f"is {excerpt_of(name)}; give one of {', '.join(known)}")
        return name

    return BeforeValidator(check)


Column = Annotated[list[Complex], BeforeValidator(_as_axis), Field(min_length=1)]
Axis = Annotated[Column, Distinct]
KeptName = Annotated[str, _one_of(survey.NAMES)]


class MembersSection(Section):
    """An ensemble: copies of each run from randomly perturbed initial data."""

    count: Count
    size: Positive
    seed: Integer
    kind: Annotated[str, _one_of(PERTURBATIONS)] = "even"


class SurveySection(Section):
    """Many runs of a case: over axes of values, and for members of an ensemble."""

    case: Name
    axes: dict[str, Axis] = {}
    together: dict[str, Column] = {}
    """Lists of equal length, by name, that vary together along one more axis, which is the last."""
    members: MembersSection | None = None
    keep: Annotated[list[KeptName], Field(min_length=1), Distinct] = ["max_l2"]
    window: Window | None = None
    chunks: Count | None = None

    @model_validator(mode="after")
    def _consistent(self) -> "SurveySection":
        if len({len(values) for values in self.together.values()}) > 1:
            counts = ", ".join(f"{len(values)} of {name}" for name, values in self.together.items())
            raise faults([("together", f"has {counts}; give the same number of values for each")])
        all_faults, runs = [], prod(self.plan.shape)
        if twice := self.axes.keys() & self.together.keys():
            all_faults.append(("together", f"varies {min(twice)}, which is listed under axes too"))
        if not (self.axes or self.together or self.members):
            all_faults.append(("axes", "is empty, and there are no members: give an axis"))
        if runs > MOST_RUNS:
            all_faults.append(("axes", f"make {runs} runs; at most {MOST_RUNS} are allowed"))
        if self.window and not 0 <= self.window[0] < self.window[1]:
            text = f"[{self.window[0]:g}, {self.window[1]:g}] must satisfy 0 <= start < end"
            all_faults.append(("window", text))
        if all_faults:
            raise faults(all_faults)
        return self

    @property
    def plan(self) -> survey.Survey:
        """The survey for `latticode.simulation`; complex values become real or whole if exact."""
        columns = self._columns()
        axes = {name: columns[name] for name in self.axes}
        if rows := [columns[name] for name in self.together]:
            values = list(zip(*rows, strict=True)) if len(rows) > 1 else rows[0]
            axes[", ".join(self.together)] = values
        members = self.members and survey.Members(**self.members.model_dump())
        return survey.Survey(axes, tuple(self.keep), self.window, members)

    def _columns(self) -> dict[str, list]:
        """Return the values of all parameters, lengths and initial values that vary, by name."""
        columns = {**self.axes, **self.together}
        return {name: [_plain_number(name, z) for z in values] for name, values in columns.items()}

    @property
    def half_widths(self) -> list[int]:
        """The half-widths in the axes; empty if half_width does not vary."""
        return sorted(set(self._columns().get("half_width", [])))

    def faults_of(self, case: CaseSection) -> list[tuple[str, str]]:
        """Return pairs (key, error) if a case cannot be surveyed in this way."""
        all_faults = []
        for key, names in (("axes", self.axes), ("together", self.together)):
            for name in names:
                text = survey.fault_of_axis(name, case.varied, case.data, len(case.fields))
                if name == "half_width" and case.sites is not None:
                    text = "half_width: the case has the key sites; replace it by half_width"
                all_faults += [(key, text)] if text else []
        twice = {name for name in [*self.axes, *self.together] if name in self.keep}
        all_faults += [
            ("keep", f"{name} is an axis too; the dataset cannot have both: leave one of them out")
            for name in twice
        ]
        if all_faults:
            return all_faults
        if self.members:
            all_faults = self._faults_of_members(case)
        if all_faults:
            return all_faults
        for point in [*self.corners(), *self._values_one_by_one()]:
            try:
                case.at(point)
            except ValidationError as error:
                at = ", ".join(f"{name} = {value:g}" for name, value in point.items())
                lines = lines_of(error, type(case))
                return [("axes", f"at {at}, {line.strip()}") for line in lines]
        span = min(self._columns().get("end_time", [case.end_time]))
        if self.window and self.window[1] > span + 1e-9:
            text = f"ends at {self.window[1]:g}, after the shortest run, which ends at {span:g}"
            all_faults.append(("window", text))
        return all_faults

    def _faults_of_members(self, case: CaseSection) -> list[tuple[str, str]]:
        """Return an error if the data of a member may be too large to be integrated."""
        factor = 1.0 + FARTHEST * self.members.size
        larger = {site: [factor * z for z in data] for site, data in case.data.items()}
        try:
            case.model_validate(
                {**case.model_dump(), "snapshot_step": None, "times": None, "initial": larger}
            )
        except ValidationError as error:
            texts = [text for fault in error.errors() for _, text in _texts(fault)]
            return [("members.size", f"is {self.members.size:g}: {texts[0]}")]
        return []

    def corners(self) -> list[dict[str, Any]]:
        """Return two runs to check: the first values of all axes, and the last values."""
        columns = self._columns()
        return [{name: values[end] for name, values in columns.items()} for end in (0, -1)]

    def _values_one_by_one(self) -> Iterator[dict[str, Any]]:
        """Yield the inner values of each axis, with the first values of the other axes."""
        columns = self._columns()
        first = {name: values[0] for name, values in columns.items()}
        for name in self.axes:
            if len(columns[name]) <= MOST_CHECKED:
                yield from ({**first, name: value} for value in columns[name][1:-1])
        if self.together:
            rows = list(zip(*(columns[name] for name in self.together), strict=True))[1:-1]
            yield from (
                first | dict(zip(self.together, row, strict=True)) for row in rows[:MOST_CHECKED]
            )


def _texts(fault: dict) -> list[tuple[str, str]]:
    return fault["ctx"]["found"] if fault["type"] == "faults" else [("", fault["msg"])]


def _plain_number(name: str, value: complex) -> Any:
    if value.imag:
        return value
    return int(value.real) if name == "half_width" and value.real.is_integer() else value.real
