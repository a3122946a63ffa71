"""The keys of config/breathers.yaml: constants, grids, members, seeds."""

from collections.abc import Iterator
from typing import Annotated, Literal

import numpy as np
from latticode.configuration.values import (
    Count,
    Counts,
    Integer,
    Name,
    Natural,
    Number,
    Numbers,
    Positive,
    Positives,
    Section,
    Tolerance,
    Window,
    section_of,
)
from pydantic import Field

from pendula.configuration.runs import Runs
from pendula.configuration.schema import Faults, PaperConfiguration

OF_RUNS = ("tolerance", "end_time", "half_width", "majority")
"""Choices of runs that the long studies change."""

Steady = section_of(omegas=Numbers, half_width=Annotated[Integer, Field(ge=4)])

# Solitons A = B of the scalar equation, on two chains: rates that differ are due to the ends.
Solitons = section_of(
    omega=Number, frequencies=Numbers, half_widths=Annotated[Counts, Field(min_length=2)]
)

Periodic = section_of(
    omegas=Numbers,
    frequencies=Positives,
    half_width=Annotated[Integer, Field(ge=2)],
    solitons=Solitons,
    long=section_of(
        omega=Number,
        frequencies=Window,
        frequency_step=Positive,
        variations=dict[Literal["frequency_step", "half_width", "steps"], Positives],
    ),
)

# Share of runs that spread, by the size of a random perturbation of the data.
Sensitivity = section_of(
    case=Name,
    end_time=Positive,
    sizes=Positives,
    members=Count,
    long=section_of(members=Count, variations=dict[Literal[*OF_RUNS, "seed"], Positives]),
    tolerance=Tolerance,
    seed=Natural,
)


class Fates(Section):
    """The map of the fates of initial conditions on one pair."""

    omegas: Numbers
    half_width: Annotated[Integer, Field(ge=4)]
    end_time: Positive
    largest: Positive
    points: Annotated[Integer, Field(ge=3)]
    long: section_of(
        points=Annotated[Integer, Field(ge=3)],
        variations=dict[Literal[*OF_RUNS, "stride"], Positives],
    )
    tolerance: Tolerance

    def amplitudes(self, points: int) -> list[float]:
        """Return the midpoints of `points` equal intervals from 0 to the largest amplitude."""
        middles = (np.arange(points) + 0.5) / points
        return [float(f"{amplitude:.12g}") for amplitude in self.largest * middles]


class Settings(Section):
    """Section `breathers` of the configuration."""

    epsilon: Positive
    gamma: Positive
    steady: Steady
    periodic: Periodic
    sensitivity: Sensitivity
    fates: Fates

    def faults(self, settings: PaperConfiguration) -> Faults:
        """Yield the errors of frequencies and cases, and of runs that take too long."""
        solitons = self.periodic.solitons
        if not (lowest := min(solitons.frequencies)) > solitons.omega:
            text = f"has {lowest:g}; each must be above Omega = {solitons.omega:g}"
            yield "periodic.solitons.frequencies", text
        absent = list(settings.absent("cases", "sensitivity.case", [self.sensitivity.case]))
        yield from absent
        if not absent:
            for runs in self.runs_of(settings):
                yield from settings.faults_of_runs(runs)

    def runs_of(self, settings: PaperConfiguration) -> Iterator[Runs]:
        """Yield the runs of the ensembles, and those of the map from its least and largest data."""
        sensitivity, fates = self.sensitivity, self.fates
        run = settings.run_of(
            sensitivity.case, sensitivity.tolerance, end_time=sensitivity.end_time
        )
        yield Runs(
            "sensitivity.members",
            "sensitivity.tolerance",
            [run],
            sensitivity.members * len(sensitivity.sizes),
            "sensitivity.sizes",
            max(sensitivity.sizes),
        )
        chain = {"half_width": fates.half_width, "epsilon": self.epsilon, "gamma": self.gamma}
        times = {"end_time": fates.end_time, "output_step": fates.end_time}
        least = 0.5 * fates.largest / max(fates.points, fates.long.points)
        runs = [
            settings.run_of(
                "fig4_small", fates.tolerance, omega=omega, initial={0: (a, 0.0)}, **chain, **times
            )
            for omega in fates.omegas
            for a in (least, fates.largest)
        ]
        yield Runs("fates.points", "fates.largest", runs, fates.points**2 / 2)
