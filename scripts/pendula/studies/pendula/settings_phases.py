"""What the configuration says of the paper's phases in the real pendula."""

from collections.abc import Iterable
from typing import Annotated, ClassVar

from pydantic import Field

from pendula.configuration.cost import estimate
from pendula.configuration.schema import PAPER_CASES, Configuration, Faults
from pendula.configuration.values import (
    Count,
    Model,
    Name,
    Names,
    Natural,
    Positive,
    Positives,
    Tolerance,
    Whole,
    Window,
    model,
)
from pendula.problem import Constants

from .mathieu import strength, strings_grow

STRONGEST = 10.0
"""The largest q of Mathieu's equation: the drive makes pendula e^11 times faster in a period."""


class Followed(Model):
    """What all topics share: a tolerance, and the runs that they make of cases."""

    may_lose: ClassVar[bool] = False
    """Whether a run may end where a pendulum is lost (see followed.until_lost)."""
    tolerance: Tolerance

    def unfit(
        self, settings: Configuration, cases: Iterable[str], mus: Iterable[float], key: str,
        times: float = 1.0, where: str = "case", **changes,
    ) -> Faults:  # fmt: skip
        """Yield where a case is missing or has no pendula at a mu, or what takes too long."""
        absent = list(settings.absent("cases", where, cases))
        if absent:
            yield from absent
            return
        solver = {"name": "taylor", "rtol": self.tolerance, "atol": self.tolerance}
        runs = {
            (name, mu): {**settings.problem(name, snapshot_step=None), "solver": solver,
                         "model": "pendula", "mu": mu, **changes}
            for name in cases for mu in mus
        }  # fmt: skip
        for (name, mu), run in runs.items():
            if why := self._endless(Constants.of(run), mu):
                yield key, f"has {mu:g}, and {why.format(case=name)}"
                return
        yield from settings.excess(key, [estimate(run) for run in runs.values()], times)

    def _endless(self, constants: Constants, mu: float) -> str:
        """Return why no run of the pendula at mu may end, or nothing."""
        if 1.0 + mu * mu * constants.omega <= 0.0:
            return "1 + mu^2 Omega must be positive"
        if strength(constants, mu) > STRONGEST:
            return "the drive of {case} there is too strong: take a smaller gamma or mu"
        if not self.may_lose and strings_grow(constants, mu):
            return (
                "pendula of {case} that swing over the top are driven ever faster there: "
                "take a smaller gamma, epsilon or mu"
            )
        return ""


class Drawn(Model):
    """Members of one case: how many, and how far apart their data are."""

    case: Name
    size: Positive
    members: Count
    seed: Natural


class Phases(Followed):
    """The paper's cases as pendula."""

    may_lose = True
    mus: Positives
    output_step: Positive
    look_every: Count
    ensemble: Drawn

    def faults(self, settings: Configuration) -> Faults:
        """Yield what does not fit the paper's cases."""
        ends = [settings.cases[name].end_time for name in PAPER_CASES if name in settings.cases]
        times = {"end_time": max(ends, default=1.0)}  # all cases are run to the last end
        yield from self.unfit(settings, PAPER_CASES, self.mus, "mus", **times)
        drawn = self.ensemble
        if drawn.case in PAPER_CASES:
            of_one = settings, [drawn.case], [max(self.mus)], "ensemble.members", drawn.members
            yield from self.unfit(*of_one, **times)
        else:
            yield "ensemble.case", f"is {drawn.case}; take one of {', '.join(PAPER_CASES)}"


class Ensemble(Drawn, Followed):
    """Members of one case at several mu."""

    mus: Positives


class Sea(Ensemble):
    """The state that fills the chain."""

    window: Window
    output_step: Positive
    long: model(mus=Positives, members=Count)

    def faults(self, settings: Configuration) -> Faults:
        """Yield what does not fit the case."""
        if not 0 <= self.window[0] < self.window[1]:
            yield "window", "does not run forward from a time >= 0"
        length = {"end_time": self.window[1], "output_step": self.output_step}
        for key, size in (("mus", self), ("long.mus", self.long)):
            yield from self.unfit(settings, [self.case], size.mus, key, size.members, **length)


class OverTheTop(Ensemble):
    """When the first pendulum turns over."""

    may_lose = True
    per_period: Annotated[Whole, Field(ge=4)]
    settled: Positive
    end_time: Annotated[Positive, Field(ge=1)]
    long: model(members=Count, end_time=Positive)

    def faults(self, settings: Configuration) -> Faults:
        """Yield what does not fit the case."""
        if not self.settled < self.end_time:
            yield "settled", f"is {self.settled:g}, and must lie before the end time"
        length = {"end_time": self.long.end_time}
        times = self.long.members
        yield from self.unfit(settings, [self.case], self.mus, "mus", times, **length)


class Film(Followed):
    """Pendula to look at."""

    cases: Names
    mu: Positive
    reach: Natural
    periods: Count
    per_period: Annotated[Whole, Field(ge=4)]

    def faults(self, settings: Configuration) -> Faults:
        """Yield what does not fit the cases."""
        yield from self.unfit(settings, self.cases, [self.mu], "mu", where="cases")
