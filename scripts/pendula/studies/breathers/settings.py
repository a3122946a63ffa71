"""What the configuration says of breathers: constants, grids, members, seeds."""

from typing import Annotated, Any

import numpy as np
from pydantic import Field

from pendula.configuration.cost import estimate
from pendula.configuration.schema import Configuration, Faults
from pendula.configuration.values import (
    Count,
    Model,
    Name,
    Natural,
    Number,
    Numbers,
    Positive,
    Positives,
    Steps,
    Tolerance,
    Whole,
    Window,
    model,
)
from pendula.models.pairs import FAMILIES


class PositiveSteps(Steps):
    """Equally spaced values above zero."""

    first: Positive
    last: Positive


Steady = model(
    omegas=Numbers,
    half_width=Annotated[Whole, Field(ge=4)],
    # where families turn stable: the interval searched, and to what distance
    stability=model(between=dict[str, Window], to=Positive),
)

Periodic = model(
    omegas=Numbers,
    frequencies=Positives,
    half_widths=model(least=Annotated[Whole, Field(ge=2)], most=Count),
)

# How the drive feeds a localised motion.
Growth = model(
    omega=Number,
    start=Positive,
    frequencies=PositiveSteps,
    end_times=Annotated[dict[Positive, Positive], Field(min_length=1)],
    # of the free breather and of the driven chain
    half_widths=model(profile=Annotated[Whole, Field(ge=2)], chain=Count),
    outputs=Annotated[Whole, Field(ge=2)],
    tolerance=Tolerance,
)

# Share of runs that spread, by the size of a random change of the data.
Sensitivity = model(
    case=Name,
    end_time=Positive,
    sizes=Positives,
    members=Count,
    scan=PositiveSteps,
    long=model(members=Count, scan=PositiveSteps),
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
    checked: Count
    long: model(points=Annotated[Whole, Field(ge=3)], phases=model(**PHASES), checked=Count)
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
            "checked": size.checked,
        }


class Settings(Model):
    """Section `breathers` of the configuration."""

    epsilon: Positive
    gamma: Positive
    steady: Steady
    periodic: Periodic
    growth: Growth
    sensitivity: Sensitivity
    fates: Fates

    def faults(self, settings: Configuration) -> Faults:
        """Yield what does not fit the families and cases, or takes too long."""
        names = [family.name for family in FAMILIES]
        for name, (low, high) in self.steady.stability.between.items():
            if name not in names:
                yield f"steady.stability.between.{name}", f"is none of {', '.join(names)}"
            elif not low < high:
                says = f"[{low:g}, {high:g}] does not run forward"
                yield f"steady.stability.between.{name}", says
        if self.periodic.half_widths.least > self.periodic.half_widths.most:
            yield "periodic.half_widths.least", "is larger than `most`"
        for key, given in (("fates", self.fates), ("fates.long", self.fates.long)):
            if 2 * given.checked > given.points:
                yield f"{key}.checked", f"leaves fewer than two of {given.points} amplitudes"
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
