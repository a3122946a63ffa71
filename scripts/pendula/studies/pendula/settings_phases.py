"""What the configuration says of the paper's phases in the real pendula."""

from collections.abc import Iterable
from typing import Annotated

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


class Followed(Model):
    """What all topics share: a tolerance, and the runs that they make of cases."""

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
        runs = [
            {**settings.problem(name, snapshot_step=None), "solver": solver, "model": "pendula",
             "mu": mu, **changes}
            for name in cases for mu in mus
        ]  # fmt: skip
        for run in runs:
            if 1.0 + run["mu"] ** 2 * run["omega"] <= 0.0:
                yield key, f"has {run['mu']:g}, and 1 + mu^2 Omega must be positive"
                return
        yield from settings.excess(key, [estimate(run) for run in runs], times)


class Drawn(Model):
    """Members of one case: how many, and how far apart their data are."""

    case: Name
    size: Positive
    members: Count
    seed: Natural


class Phases(Followed):
    """The paper's cases as pendula."""

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
