"""The section of the configuration on infinite chains, and the problems that follow from it.

A full run makes the study of `short`, and `snakemake unbounded` that of `long`.
"""

from collections.abc import Mapping
from math import inf
from typing import Annotated, Any, Literal

from pydantic import Field

from pendula.configuration.cases import is_multiple
from pendula.configuration.cost import Cost, estimate
from pendula.configuration.schema import Configuration, Faults
from pendula.configuration.solvers import Dop853, Taylor
from pendula.configuration.values import (
    Count,
    Counts,
    Distinct,
    Model,
    Name,
    Names,
    Natural,
    Number,
    Numbers,
    Positive,
    Whole,
    model,
)

SPEED = 5.0
"""Sites per unit of tau and of the coupling: no front of the paper's cases is faster."""

Nodes = Annotated[Whole, Field(ge=8, le=100)]


class Size(Model):
    """How far everything is run, and by which solver.

    The maps are of maxima over [10, T] on chains of half-width M, for each of the paper's sweeps.
    """

    solver: Annotated[Dop853 | Taylor, Field(discriminator="name")]
    rest: Positive
    runs: dict[Name, model(end_time=Positive, members=Count)]
    maps: model(
        half_widths=Counts,
        end_time=Positive,
        output_step=Positive,
        rest=Positive,
        members=dict[Name, Count],
    )


class Settings(Model):
    """Section `unbounded` of the configuration."""

    output_step: Positive
    perturbation: Positive
    seed: Natural
    cases: Names
    # one parameter of a case: Omega, A_0 (with B_0 = A_0 / 5), or the tolerance
    varied: dict[
        Name,
        model(case=Name, parameter=Literal["omega", "amplitude", "tolerance"], values=Numbers),
    ]
    # the states that the bulk is compared with: at each Omega without energy, and at the Omega of
    # the warm case each with an energy per site
    thermal: model(
        nodes=Nodes,
        density_nodes=Nodes,
        omegas=Numbers,
        warm=model(case=Name, energies=Annotated[list[Number], Field(min_length=3), Distinct]),
    )
    short: Size
    long: Size

    def faults(self, settings: Configuration) -> Faults:
        """Yield what does not fit the cases and sweeps of the configuration, or takes too long."""
        used = [(f"varied.{name}.case", varied.case) for name, varied in self.varied.items()]
        used += [("thermal.warm.case", self.thermal.warm.case)]
        used += [("cases", case) for case in self.cases]
        absent = [fault for key, case in used for fault in settings.absent("cases", key, [case])]
        sizes = {"short": self.short, "long": self.long}
        for label, size in sizes.items():
            unknown = [name for name in size.runs if name not in {*self.names, *settings.cases}]
            missing = [name for name in self.names if name not in size.runs]
            said = "is no ensemble of cases or varied"
            absent += [(f"{label}.runs.{name}", said) for name in unknown]
            absent += [(f"{label}.runs.{name}", "is missing") for name in missing]
            absent += settings.absent("sweeps", f"{label}.maps.members", list(size.maps.members))
        yield from absent
        for label, size in {} if absent else sizes.items():
            yield from self._faults_of_size(settings, label, size)

    def _faults_of_size(self, settings: Configuration, label: str, size: Size) -> Faults:
        ends = [(f"runs.{name}", one.end_time, self.output_step) for name, one in size.runs.items()]
        ends.append(("maps", size.maps.end_time, size.maps.output_step))
        for key, end, step in ends:
            if not is_multiple(end, step):
                text = f"{end:g} is not a whole number of output steps of {step:g}"
                yield f"{label}.{key}.end_time", text
        for name in self.names:
            run, case = size.runs[name], settings.problem(self.case_of(name))
            many = len(self.varied[name].values) if name in self.varied else 1
            cost = _cost(self.problem(case, size, run.end_time))
            key = "end_time" if cost.seconds * many > run.members else "members"
            yield from settings.excess(f"{label}.runs.{name}.{key}", [cost], many * run.members)
        for name, members in size.maps.members.items():
            case = settings.problem(settings.sweeps[name].case)
            cost = _cost(self.map_problem(case, size), max(size.maps.half_widths))
            key = "end_time" if cost.seconds > members else f"members.{name}"
            yield from settings.excess(f"{label}.maps.{key}", [cost], members)

    @property
    def names(self) -> list[str]:
        """The ensembles: those of cases, and those of a case with one parameter varied."""
        return [*self.cases, *self.varied]

    def case_of(self, name: str) -> str:
        """Return the case of the paper that an ensemble starts from."""
        return self.varied[name].case if name in self.varied else name

    def problems(self, case: Mapping[str, Any], name: str, size: Size) -> list[dict]:
        """Return the problems of an ensemble as plain values, one for each value that is varied.

        `case` is the case that it starts from, as plain values of a Problem.
        """
        base = self.problem(case, size, size.runs[name].end_time)
        if name not in self.varied:
            return [base]
        changes = {
            "omega": lambda value: {"omega": value},
            "amplitude": lambda value: {"initial": {0: (value, value / 5.0)}},
            "tolerance": lambda value: {"solver": base["solver"] | {"rtol": value, "atol": value}},
        }
        varied = self.varied[name]
        return [base | changes[varied.parameter](value) for value in varied.values]

    def map_problem(self, case: Mapping[str, Any], size: Size) -> dict:
        """Return the case of a map over half-widths on an infinite chain."""
        return self.problem(case, size, size.maps.end_time) | {"output_step": size.maps.output_step}

    def problem(self, case: Mapping[str, Any], size: Size, end_time: float) -> dict:
        """Return a case on an infinite chain."""
        kept = {key: case[key] for key in ("epsilon", "gamma", "omega", "initial")}
        return {
            **kept,
            "half_width": None,
            "boundary": "dirichlet",
            "end_time": end_time,
            "output_step": self.output_step,
            "solver": size.solver.model_dump(),
        }


def _cost(problem: dict, most: float = inf) -> Cost:
    """Return what one run takes: the front moves at SPEED, half of its reach is the mean."""
    reach = min(most, 0.5 * SPEED * abs(problem["epsilon"]) * problem["end_time"])
    return estimate({**problem, "half_width": max(1.0, reach), "snapshot_every": 0})
