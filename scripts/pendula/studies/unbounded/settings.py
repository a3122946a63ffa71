"""What the configuration says of the chains without ends, and the problems that follow from it.

The full run does what `short` says, `snakemake unbounded` what `long` says.
"""

from collections.abc import Mapping
from typing import Annotated, Any, Literal

from pydantic import Field

from pendula.configuration.values import Model, Name, Number, Positive, Whole

Count = Annotated[Whole, Field(ge=1)]


class Varied(Model):
    """One parameter of a case, varied: Omega, A_0 (with B_0 = A_0 / 5), or the tolerance."""

    case: Name
    parameter: Literal["omega", "amplitude", "tolerance"]
    values: Annotated[list[Number], Field(min_length=1)]


class Extent(Model):
    """How long an ensemble of runs is, and how many members it has."""

    end_time: Positive
    members: Count


class Maps(Model):
    """Maxima over [10, T] on chains of half-width M, for each of the paper's sweeps."""

    half_widths: Annotated[list[Count], Field(min_length=1)]
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
    energies: Annotated[list[Number], Field(min_length=3)]


class Thermal(Model):
    """The thermal states that the bulk is compared with: at each Omega without energy, and warm."""

    nodes: Annotated[Whole, Field(ge=8)]
    omegas: Annotated[list[Number], Field(min_length=1)]
    warm: Warm


class Settings(Model):
    """Section `unbounded` of the configuration."""

    tolerance: Positive
    output_step: Positive
    cases: Annotated[list[Name], Field(min_length=1)]
    varied: dict[Name, Varied]
    thermal: Thermal
    short: Size
    long: Size

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
