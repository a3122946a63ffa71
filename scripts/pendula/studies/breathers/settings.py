"""What the configuration says of breathers: constants, grids, members, seeds."""

from typing import Annotated

import numpy as np
from pydantic import Field

from pendula.configuration.cost import estimate
from pendula.configuration.schema import Configuration, Faults
from pendula.configuration.values import Distinct, Model, Name, Positive, Steps, Whole
from pendula.models.pairs import FAMILIES

Count = Annotated[Whole, Field(ge=1)]
Seed = Annotated[Whole, Field(ge=0)]
Tolerance = Annotated[Positive, Field(ge=1e-15, lt=1)]
Number = Annotated[float, Field(allow_inf_nan=False)]
Numbers = Annotated[list[Number], Field(min_length=1), Distinct]
Positives = Annotated[list[Positive], Field(min_length=1), Distinct]


class PositiveSteps(Steps):
    """Equally spaced values above zero."""

    first: Positive
    last: Positive


class Stability(Model):
    """Where families of steady states turn stable: the interval searched, and to what distance."""

    between: dict[str, tuple[Number, Number]]
    to: Positive


class Steady(Model):
    """Steady states."""

    omegas: Numbers
    half_width: Annotated[Whole, Field(ge=4)]
    stability: Stability


class HalfWidths(Model):
    """The least and the largest half-width of the chain of a periodic breather."""

    least: Annotated[Whole, Field(ge=2)]
    most: Count


class LongPeriodic(Model):
    """Long runs from stable breathers with a small relative change."""

    frequencies: Positives
    change: Tolerance
    end_time: Positive
    tolerance: Tolerance


class Periodic(Model):
    """Periodic breathers."""

    omegas: Numbers
    frequencies: Positives
    half_widths: HalfWidths
    long: LongPeriodic


class GrowthWidths(Model):
    """Half-widths of the free breather and of the driven chain."""

    profile: Annotated[Whole, Field(ge=2)]
    chain: Count


class Growth(Model):
    """How the drive feeds a localised motion."""

    omega: Number
    start: Positive
    frequencies: PositiveSteps
    end_times: Annotated[dict[Positive, Positive], Field(min_length=1)]
    half_widths: GrowthWidths
    outputs: Annotated[Whole, Field(ge=2)]
    tolerance: Tolerance


class LongSensitivity(Model):
    """Its longer study."""

    members: Count
    scan: PositiveSteps


class Sensitivity(Model):
    """Which of almost equal data spread."""

    case: Name
    end_time: Positive
    sizes: Positives
    members: Count
    scan: PositiveSteps
    long: LongSensitivity
    tolerance: Tolerance
    seed: Seed


class Phases(Model):
    """The map over A_0 and the phase of B_0: how many of each."""

    amplitudes: Annotated[Whole, Field(ge=2)]
    points: Annotated[Whole, Field(ge=2)]


class FullPhases(Phases):
    """The same, with the size of B_0."""

    ratio: Positive  # |B_0| / |A_0|


class LongFates(Model):
    """Its longer study."""

    points: Annotated[Whole, Field(ge=3)]
    phases: Phases
    checked: Count


class Fates(Model):
    """What becomes of data on one pair."""

    omegas: Numbers
    half_width: Annotated[Whole, Field(ge=4)]
    end_time: Positive
    largest: Positive
    points: Annotated[Whole, Field(ge=3)]
    phases: FullPhases
    checked: Count
    long: LongFates
    tolerance: Tolerance

    def amplitudes(self, points: int) -> list[float]:
        """Return so many amplitudes, the middles of equal parts of what is below the largest."""
        return [float(f"{one:.12g}") for one in self.largest * (np.arange(points) + 0.5) / points]

    def turns(self, points: int) -> list[float]:
        """Return so many phases up to pi; 0 is one of them if their number is even."""
        return [float(one) for one in 2.0 * np.pi * np.arange(1, points + 1) / points - np.pi]


class Needs(Model):
    """The largest error that each part may have."""

    steady: Positive
    thresholds: Positive
    periodic: Positive
    law: Positive
    shares: Positive
    fates: Positive


class Settings(Model):
    """Section `breathers` of the configuration."""

    needs: Needs
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
                yield (
                    f"steady.stability.between.{name}",
                    f"[{low:g}, {high:g}] does not run forward",
                )
        if self.periodic.half_widths.least > self.periodic.half_widths.most:
            yield "periodic.half_widths.least", "is larger than `most`"
        for key, steps in (
            ("growth.frequencies", self.growth.frequencies),
            ("sensitivity.scan", self.sensitivity.scan),
            ("sensitivity.long.scan", self.sensitivity.long.scan),
        ):
            if not steps.first < steps.last:
                yield key, f"does not run forward from {steps.first:g} to {steps.last:g}"
        for key, given in (("fates", self.fates), ("fates.long", self.fates.long)):
            if 2 * given.checked > given.points:
                yield f"{key}.checked", f"leaves fewer than two of {given.points} amplitudes"
        absent = list(settings.absent("cases", "sensitivity.case", [self.sensitivity.case]))
        yield from absent
        if not absent:
            given = self.sensitivity
            one = [estimate(settings.problem(given.case, end_time=given.end_time))]
            runs = given.members * len(given.sizes)
            yield from settings.excess("sensitivity.members", one, runs)
            phases = self.fates.phases
            runs = len(self.fates.omegas) * self.fates.points**2
            yield from settings.excess("fates.points", one, runs)
            runs = len(self.fates.omegas) * phases.amplitudes * phases.points
            yield from settings.excess("fates.phases.points", one, runs)
