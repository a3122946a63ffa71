"""Section `chaos` of the configuration: cases, lengths of runs, tolerances and seeds."""

from typing import Annotated

from latticode.configuration.values import (
    Count,
    Counts,
    Distinct,
    Model,
    Name,
    Names,
    Natural,
    Positive,
    Tolerance,
    Whole,
    Window,
    model,
)
from pydantic import Field

from pendula.configuration.cost import Cost, estimate
from pendula.configuration.schema import PAPER_CASES, Configuration, Faults


class Spectrum(Model):
    """All Lyapunov exponents, on short chains; `lengths` are by half-width.

    The shortest chain is followed without a drive too, for `undriven_lengths`.
    """

    cases: Names
    tolerance: Tolerance
    undriven_lengths: Positive
    lengths: Annotated[dict[Natural, Positive], Field(min_length=1)]


RANDOM = {"tolerance": Tolerance, "size": Positive, "seed": Natural}
"""What all ensembles have: the solver's tolerance, the size of a change, and the seed."""

# The largest exponents of every case, on spans of time.
Lyapunov = model(
    spans=Annotated[list[Window], Field(min_length=2, max_length=2), Distinct],
    members=Annotated[Whole, Field(ge=2)],
    spectrum=Spectrum,
    **RANDOM,
)

SWEPT = ("sweeps", "uneven", "second")
"""Ensembles of sweeps: even in n, not even, and by the paper's second solver."""

# Those of one kind: so many members on chains of each half-width.
Swept = Annotated[
    dict[Name, model(half_widths=Counts, members=Annotated[Whole, Field(ge=2)])],
    Field(min_length=1),
]


# Cases and sweeps from data that differ in their last digits.
Ensembles = model(cases=Names, **dict.fromkeys(SWEPT, Swept), members=Count, **RANDOM)

# Ensembles of every case, each member reduced to numbers over windows of time.
Members = model(
    windows=Annotated[list[Window], Field(min_length=2, max_length=2), Distinct],
    members=Annotated[Whole, Field(ge=3)],
    every=Count,
    **RANDOM,
)


class Lifetimes(Model):
    """How long the central pair stays excited, against its initial amplitude."""

    case: Name
    amplitudes: Annotated[list[Positive], Field(min_length=2), Distinct]
    ratio: Positive
    members: Count
    size: Positive
    tolerance: Tolerance
    end_time: Positive
    output_step: Positive
    seed: Natural


class Settings(Model):
    """Section `chaos` of the configuration."""

    lyapunov: Lyapunov
    ensembles: Ensembles
    members: Members
    lifetimes: Lifetimes

    def faults(self, settings: Configuration) -> Faults:
        """Yield what does not fit the cases and sweeps of the configuration, or takes too long."""
        absent = [
            *settings.absent("cases", "lyapunov.spectrum.cases", self.lyapunov.spectrum.cases),
            *settings.absent("cases", "ensembles.cases", self.ensembles.cases),
            *(
                fault
                for kind in SWEPT
                for fault in settings.absent(
                    "sweeps", f"ensembles.{kind}", list(getattr(self.ensembles, kind))
                )
            ),
            *settings.absent("cases", "lifetimes.case", [self.lifetimes.case]),
        ]
        yield from absent
        spans = {"lyapunov.spans": self.lyapunov.spans, "members.windows": self.members.windows}
        for key, given in spans.items():
            for i, (start, end) in enumerate(given):
                if not 0 <= start < end:
                    yield f"{key}.{i}", f"[{start:g}, {end:g}] does not run forward"
        if not absent:
            yield from self._too_long(settings)

    def shorter_chains(self, settings: Configuration, case: str) -> dict[str, int]:
        """Return the least half-width on which each ensemble integrates a case, by its key."""
        spectrum = self.lyapunov.spectrum
        found = {"lyapunov.spectrum": min(spectrum.lengths)} if case in spectrum.cases else {}
        for kind in SWEPT:
            for name, swept in getattr(self.ensembles, kind).items():
                if name in settings.sweeps and settings.sweeps[name].case == case:
                    found[f"ensembles.{kind}.{name}"] = min(swept.half_widths)
        return found

    def _too_long(self, settings: Configuration) -> Faults:
        """Yield the sizes of ensembles and the lengths of runs that nobody would wait for.

        A tangent vector costs about as much as its trajectory.
        """
        paper = [case for case in PAPER_CASES if case in settings.cases]
        longest = max((settings.cases[case].end_time for case in paper), default=1.0)
        runs = [estimate(settings.problem(case, end_time=longest)) for case in paper]
        drawn = [estimate(settings.problem(case)) for case in self.ensembles.cases]
        followed = max(end for _, end in self.lyapunov.spans) / longest
        yield from settings.excess("lyapunov.members", runs, 2.0 * followed * self.lyapunov.members)
        yield from settings.excess("lyapunov.spectrum.lengths", self._spectra(settings))
        yield from settings.excess("ensembles.members", drawn, self.ensembles.members)
        for kind in SWEPT:
            for name, drawn in getattr(self.ensembles, kind).items():
                one = [settings.cost_of_sweep(name)]
                yield from settings.excess(f"ensembles.{kind}.{name}.members", one, drawn.members)
        yield from settings.excess("members.members", runs, 2.0 * self.members.members)
        given = self.lifetimes
        times = {"end_time": given.end_time, "output_step": given.output_step}
        lives = [
            estimate(settings.problem(given.case, **times, initial={0: (a, given.ratio * a)}))
            for a in given.amplitudes
        ]
        key = "members" if max(lives).seconds < 60.0 else "end_time"
        yield from settings.excess(f"lifetimes.{key}", lives, given.members)

    def _spectra(self, settings: Configuration) -> list[Cost]:
        """Return what exponents of short chains take: half as many tangent vectors as numbers."""
        spectrum, found = self.lyapunov.spectrum, []
        runs = [*spectrum.lengths.items(), (min(spectrum.lengths), spectrum.undriven_lengths)]
        for case in spectrum.cases:
            for half_width, lengths in runs:
                one = estimate(settings.problem(case, half_width=half_width))
                found.append(Cost(lengths * 2 * (2 * half_width + 1) * one.seconds, one.memory))
        return found
