"""What the configuration says of the chains without ends, and the problems that follow from it.

The full run does what `short` says, `snakemake unbounded` what `long` says.
"""

from collections.abc import Mapping
from math import inf
from typing import Annotated, Any, Literal

from pydantic import Field

from pendula.configuration.cases import is_multiple
from pendula.configuration.cost import Cost, estimate
from pendula.configuration.schema import Configuration, Faults
from pendula.configuration.values import Distinct, Model, Name, Number, Positive, Whole

Count = Annotated[Whole, Field(ge=1)]


SPEED = 5.0
"""Sites per unit of tau and of the coupling: no front of the paper's cases is faster."""


class Varied(Model):
    """One parameter of a case, varied: Omega, A_0 (with B_0 = A_0 / 5), or the tolerance."""

    case: Name
    parameter: Literal["omega", "amplitude", "tolerance"]
    values: Annotated[list[Number], Field(min_length=1), Distinct]


class Extent(Model):
    """How long an ensemble of runs is, and how many members it has."""

    end_time: Positive
    members: Count


class Maps(Model):
    """Maxima over [10, T] on chains of half-width M, for each of the paper's sweeps."""

    half_widths: Annotated[list[Count], Field(min_length=1), Distinct]
    end_time: Positive
    output_step: Positive
    rest: Positive
    members: dict[Name, Count]


class Size(Model):
    """How far everything is run."""

    rest: Positive
    runs: dict[Name, Extent]
    maps: Maps


class Warm(Model):
    """Thermal states at the Omega of a case, each with an energy per site."""

    case: Name
    energies: Annotated[list[Number], Field(min_length=3), Distinct]


class Thermal(Model):
    """The thermal states that the bulk is compared with: at each Omega without energy, and warm."""

    nodes: Annotated[Whole, Field(ge=8, le=100)]
    omegas: Annotated[list[Number], Field(min_length=1), Distinct]
    warm: Warm


class Settings(Model):
    """Section `unbounded` of the configuration."""

    tolerance: Annotated[Positive, Field(ge=1e-15, lt=1)]
    output_step: Positive
    cases: Annotated[list[Name], Field(min_length=1), Distinct]
    varied: dict[Name, Varied]
    thermal: Thermal
    short: Size
    long: Size

    def faults(self, settings: Configuration) -> Faults:
        """Yield what does not fit the cases and sweeps of the configuration, or takes too long."""
        used = [(f"varied.{name}.case", varied.case) for name, varied in self.varied.items()]
        used += [("thermal.warm.case", self.thermal.warm.case)]
        used += [("cases", case) for case in self.cases]
        absent = [fault for key, case in used for fault in settings.absent("cases", key, [case])]
        for label, size in (("short", self.short), ("long", self.long)):
            unknown = [name for name in size.runs if name not in {*self.names, *settings.cases}]
            absent += [
                (f"{label}.runs.{name}", "is no ensemble of cases or varied") for name in unknown
            ]
            missing = [name for name in self.names if name not in size.runs]
            absent += [(f"{label}.runs.{name}", "is missing") for name in missing]
            members = size.maps.members
            absent += settings.absent("sweeps", f"{label}.maps.members", list(members))
        yield from absent
        if absent:
            return
        for label, size in (("short", self.short), ("long", self.long)):
            yield from self._faults_of_size(settings, label, size)

    def _faults_of_size(self, settings: Configuration, label: str, size: "Size") -> Faults:
        ends = [(f"runs.{name}", one.end_time, self.output_step) for name, one in size.runs.items()]
        ends.append(("maps", size.maps.end_time, size.maps.output_step))
        for key, end, step in ends:
            if not is_multiple(end, step):
                text = f"{end:g} is not a whole number of output steps of {step:g}"
                yield f"{label}.{key}.end_time", text
        for name, one in size.runs.items():
            if name not in self.names:
                continue
            many = len(self.varied[name].values) if name in self.varied else 1
            cost = self._cost(settings.problem(self.case_of(name)), one.end_time)
            key = "end_time" if cost.seconds * many > one.members else "members"
            yield from settings.excess(f"{label}.runs.{name}.{key}", [cost], many * one.members)
        longest = max(size.maps.half_widths)
        for name, members in size.maps.members.items():
            case = settings.problem(settings.sweeps[name].case)
            cost = self._cost(case, size.maps.end_time, longest)
            key = "end_time" if cost.seconds > members else f"members.{name}"
            yield from settings.excess(f"{label}.maps.{key}", [cost], members)

    def _cost(self, case: Mapping[str, Any], end_time: float, most: float = inf) -> Cost:
        """Return what one run takes: the front moves at SPEED, half of its reach is the mean."""
        reach = min(most, 0.5 * SPEED * abs(case["epsilon"]) * end_time)
        problem = self.problem(case, end_time, self.output_step)
        return estimate({**problem, "half_width": max(1.0, reach), "snapshot_every": 0})

    @property
    def names(self) -> list[str]:
        """The ensembles: those of cases, and those of a case with one parameter varied."""
        return [*self.cases, *self.varied]

    def case_of(self, name: str) -> str:
        """Return the case of the paper that an ensemble starts from."""
        return self.varied[name].case if name in self.varied else name

    def problems(self, case: Mapping[str, Any], name: str, end_time: float) -> list[dict]:
        """Return the problems of an ensemble as plain values, one for each value that is varied.

        `case` is the case that it starts from, as plain values of a Problem.
        """
        base = self.problem(case, end_time, self.output_step)
        if name not in self.varied:
            return [base]
        varied = self.varied[name]
        return [base | _change(varied.parameter, value) for value in varied.values]

    def problem(self, case: Mapping[str, Any], end_time: float, output_step: float) -> dict:
        """Return a case on a chain without ends."""
        kept = {key: case[key] for key in ("epsilon", "gamma", "omega", "initial")}
        return {
            **kept,
            "half_width": None,
            "boundary": "dirichlet",
            "end_time": end_time,
            "output_step": output_step,
            "solver": _dop853(self.tolerance),
        }


def _change(parameter: str, value: float) -> dict:
    if parameter == "omega":
        return {"omega": value}
    if parameter == "amplitude":
        return {"initial": {0: (value, value / 5.0)}}
    return {"solver": _dop853(value)}


def _dop853(tolerance: float) -> dict:
    return {"name": "dop853", "rtol": tolerance, "atol": tolerance}
