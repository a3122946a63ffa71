"""What the configuration says of breathers: constants, grids, members, seeds."""

from typing import Annotated, Any

import numpy as np
from latticode.configuration.values import (
    Count,
    Model,
    Name,
    Natural,
    Numbers,
    Positive,
    Positives,
    Tolerance,
    Whole,
    model,
)
from pydantic import Field

from pendula.configuration.cost import estimate
from pendula.configuration.schema import Configuration, Faults

Steady = model(omegas=Numbers, half_width=Annotated[Whole, Field(ge=4)])

Periodic = model(
    omegas=Numbers,
    frequencies=Positives,
    half_widths=model(least=Annotated[Whole, Field(ge=2)], most=Count),
)

# Share of runs that spread, by the size of a random change of the data.
Sensitivity = model(
    case=Name,
    end_time=Positive,
    sizes=Positives,
    members=Count,
    long=model(members=Count),
    tolerance=Tolerance,
    seed=Natural,
)

# A map over A_0 and the phase of B_0: how many of each.
PHASES = {"amplitudes": Annotated[Whole, Field(ge=2)], "points": Annotated[Whole, Field(ge=2)]}


class Fates(Model):
    """What becomes of data on one pair; `ratio` is |B_0| / |A_0|."""

    omegas: Numbers
    half_width: Annotated[Whole, Field(ge=4)]
    end_time: Positive
    largest: Positive
    points: Annotated[Whole, Field(ge=3)]
    phases: model(**PHASES, ratio=Positive)
    long: model(points=Annotated[Whole, Field(ge=3)], phases=model(**PHASES))
    tolerance: Tolerance

    def grid(self, size: Model) -> dict[str, Any]:
        """Return the data of both maps, of this size or of that of the long study.

        Amplitudes are the middles of equal parts of what is below the largest. Phases go up to pi;
        0 is one of them if their number is even.
        """

        def amplitudes(points: int) -> list[float]:
            middles = (np.arange(points) + 0.5) / points
            return [float(f"{one:.12g}") for one in self.largest * middles]

        points = size.phases.points
        return {
            "amplitudes": amplitudes(size.points),
            "turned": amplitudes(size.phases.amplitudes),
            "phases": (2.0 * np.pi * np.arange(1, points + 1) / points - np.pi).tolist(),
            "ratio": self.phases.ratio,
        }


class Settings(Model):
    """Section `breathers` of the configuration."""

    epsilon: Positive
    gamma: Positive
    steady: Steady
    periodic: Periodic
    sensitivity: Sensitivity
    fates: Fates

    def faults(self, settings: Configuration) -> Faults:
        """Yield what does not fit the families and cases, or takes too long."""
        if self.periodic.half_widths.least > self.periodic.half_widths.most:
            yield "periodic.half_widths.least", "is larger than `most`"
        absent = list(settings.absent("cases", "sensitivity.case", [self.sensitivity.case]))
        yield from absent
        if not absent:
            given, fates, phases = self.sensitivity, self.fates, self.fates.phases
            one = [estimate(settings.problem(given.case, end_time=given.end_time))]
            for key, runs in (
                ("sensitivity.members", given.members * len(given.sizes)),
                ("fates.points", len(fates.omegas) * fates.points**2),
                ("fates.phases.points", len(fates.omegas) * phases.amplitudes * phases.points),
            ):
                yield from settings.excess(key, one, runs)
