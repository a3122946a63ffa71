"""The keys of config/newton.yaml, one class for each topic."""

from collections.abc import Iterable
from typing import Annotated, Any, Literal

from latticode.configuration.cases import is_multiple
from latticode.configuration.values import (
    Count,
    Name,
    Natural,
    Numbers,
    Positive,
    Positives,
    Section,
    Tolerance,
    section_of,
)
from pydantic import Field

from pendula.configuration.runs import Runs
from pendula.configuration.schema import PAPER_CASES, Faults, PaperConfiguration
from pendula.problem import Constants

from .mathieu import squared_frequency, waves_on_strings_grow


class Threshold(Section):
    """Lemma 1 for the pendula."""

    epsilon: Positive
    omegas: Numbers
    mus: Positives

    def faults(self, settings: PaperConfiguration) -> Faults:
        """Yield an error if a wave comes near the second resonance of the drive, at a = 4."""
        mu, omega = max(self.mus), min(self.omegas)
        if mu * mu * (4.0 * self.epsilon - omega) > squared_frequency(omega, mu):
            least = 0.5 * (4.0 * self.epsilon - 1.0 / (mu * mu))
            where = f"has {omega:g}, but at mu = {mu:g} some waves of this Omega lie"
            way_out = f"give an Omega above {least:.4g} or a smaller mu"
            yield "omegas", f"{where} near the second resonance of the drive; {way_out}"


class PendulaRuns(Section):
    """Keys of topics that integrate pendula: mu and a tolerance."""

    mus: Positives
    tolerance: Tolerance

    def faults_of_cases(
        self,
        settings: PaperConfiguration,
        cases: Iterable[str],
        times: float = 1.0,
        size: float = 0.0,
        key: str = "mus",
        **changes: Any,
    ) -> Faults:
        """Yield an error if a case is missing, cannot be integrated at a mu, or takes too long.

        Relative perturbations of members are normal draws times `size`. `key` is the key of mu,
        "mus" or "long.mus".
        """
        mus = self.mus if key == "mus" else self.long.mus
        if absent := list(settings.absent("cases", "case", cases)):
            yield from absent
            return
        runs = []
        for name in cases:
            for mu in mus:
                run = settings.run_of(name, self.tolerance, model="pendula", mu=mu, **changes)
                if why := _why_endless(Constants.of(run), mu):
                    yield key, f"has {mu:g}, but {why.format(case=name)}"
                    return
                runs.append(run)
        yield from settings.faults_of_runs(Runs(key, "tolerance", runs, times, "size", size))


def _why_endless(constants: Constants, mu: float) -> str:
    """Return why a run of the pendula at this mu may never end, or an empty text.

    A case with a negative epsilon is rejected elsewhere.
    """
    if 1.0 + mu * mu * constants.omega <= 0.0:
        return "1 + mu^2 Omega must be positive"
    if constants.epsilon >= 0.0 and waves_on_strings_grow(constants, mu):
        return (
            "there the drive speeds up pendula of {case} without bound once they go over the top; "
            "give a smaller gamma, epsilon or mu"
        )
    return ""


class Remainder(PendulaRuns):
    """The error of the expansion (3)."""

    mus: Annotated[list[Positive], Field(min_length=2)]
    end_time: Positive
    output_step: Positive

    def faults(self, settings: PaperConfiguration) -> Faults:
        """Yield the errors of times and of runs of the paper's cases."""
        if not is_multiple(self.end_time, self.output_step):
            yield "end_time", f"is not a whole number of `output_step`, {self.output_step:g}"
        cases = [name for name in PAPER_CASES if name in settings.cases]
        yield from self.faults_of_cases(settings, cases, end_time=self.end_time)


class OverTheTop(PendulaRuns):
    """First passages over the top in an ensemble of one case."""

    case: Name
    size: Positive
    members: Count
    seed: Natural
    settled: Positive
    end_time: Annotated[Positive, Field(ge=1)]
    long: section_of(
        mus=Positives,
        members=Count,
        end_time=Positive,
        variations=dict[Literal["tolerance", "size", "seed", "settled"], Positives],
    )

    def faults(self, settings: PaperConfiguration) -> Faults:
        """Yield the errors of times and of runs of the case."""
        if not self.settled < self.end_time:
            yield "settled", f"is {self.settled:g}; it must be before the end time"
        if not (latest := max(self.long.variations.get("settled", [0.0]))) < self.long.end_time:
            key = "long.variations.settled"
            yield key, f"has {latest:g}; each must be before the end time, {self.long.end_time:g}"
        for key, runs in (("mus", self), ("long.mus", self.long)):
            many = runs.members, self.size, key
            if unfit := list(
                self.faults_of_cases(settings, [self.case], *many, end_time=runs.end_time)
            ):
                yield from unfit
                return


class Settings(Section):
    """Section `newton` of the configuration."""

    threshold: Threshold
    remainder: Remainder
    over_the_top: OverTheTop

    def faults(self, settings: PaperConfiguration) -> Faults:
        """Yield the errors of each topic."""
        for topic in ("threshold", "remainder", "over_the_top"):
            for key, text in getattr(self, topic).faults(settings):
                yield f"{topic}.{key}", text
