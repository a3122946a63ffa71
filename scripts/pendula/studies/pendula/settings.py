"""What the configuration gives for the pendula: a model for each topic."""

from collections.abc import Iterable
from itertools import pairwise
from typing import Annotated, ClassVar

import numpy as np
from pydantic import Field

from pendula.configuration.cases import is_multiple
from pendula.configuration.cost import Cost, estimate, integrated_pairs
from pendula.configuration.schema import PAPER_CASES, Configuration, Faults
from pendula.configuration.values import (
    Count,
    Model,
    Name,
    Names,
    Natural,
    Numbers,
    Positive,
    Positives,
    Steps,
    Tolerance,
    Whole,
    Window,
    model,
)
from pendula.problem import Constants

from .mathieu import second_tongue, squared_frequency, strength, strings_grow

PERIOD_SECONDS = 2e-6
"""Computing time of a period of a pair of pendula."""
STRONGEST = 10.0
"""The largest q of Mathieu's equation: the drive makes pendula e^11 times faster in a period."""


class Threshold(Model):
    """Lemma 1 for the pendula."""

    epsilon: Positive
    omegas: Numbers
    mus: Positives
    half_width: Count
    growth: model(omegas=Numbers, gammas=Steps)
    curve: Steps

    def faults(self, settings: Configuration) -> Faults:
        """Yield where Mathieu's equation is not known well enough."""
        mu, gamma, driven = max(self.mus), self.growth.gammas.last, self.growth.omegas
        lowest = {"omegas": min(self.omegas), "growth.omegas": min(driven)}
        for key, omega in {**lowest, "curve.first": self.curve.first}.items():
            if 4.0 * squared_frequency(omega, mu) <= 1.0:
                where = f"has {omega:g}, and at mu = {mu:g} every wave there lies"
                way_out = f"take an Omega above {-0.75 / (mu * mu):.4g}, or a smaller mu"
                yield key, f"{where} above the second resonance of the drive: {way_out}"
        if 4.0 * squared_frequency(min(driven), mu) <= 1.0:
            return
        for omega in driven:
            square = squared_frequency(omega, mu) / (mu * mu)
            highest = (4.0 * self.epsilon - omega) / square
            if highest >= 3.0 or 2.0 * gamma / square >= second_tongue(highest):
                where = f"has {gamma:g}, at which waves of Omega = {omega:g} and mu = {mu:g} grow"
                way_out = "take a smaller gamma or mu"
                yield "growth.gammas", f"{where} by the second resonance of the drive: {way_out}"


class Remainder(Model):
    """The error of the expansion (3), and of its next order."""

    mus: Annotated[list[Positive], Field(min_length=3)]
    ends: Annotated[dict[Name, list[Positive]], Field(min_length=1)]
    end_step: Positive
    spacing: Positive
    tolerance: Tolerance
    long: Positive

    @property
    def run_ends(self) -> dict[str, dict[float, float]]:
        """How far the pendula are run, by case and mu."""
        return {case: dict(zip(self.mus, ends, strict=True)) for case, ends in self.ends.items()}

    @property
    def long_ends(self) -> dict[str, dict[float, float]]:
        """The same of the longer study."""
        return {case: dict.fromkeys(self.mus, self.long) for case in self.ends}

    def faults(self, settings: Configuration) -> Faults:
        """Yield what gives no order in mu, is no whole number of steps, or has no case."""
        if any(abs(2.0 * fine / coarse - 1.0) > 1e-9 for coarse, fine in pairwise(self.mus)):
            yield "mus", "must each be half of the one before: orders are read off such pairs"
        if not is_multiple(self.end_step, self.spacing):
            yield "end_step", f"is not a whole number of `spacing`, {self.spacing:g}"
        for case, ends in self.ends.items():
            if len(ends) != len(self.mus):
                told = f"has {len(ends)} ends for {len(self.mus)} values of mu"
                yield f"ends.{case}", f"{told}: give one for each"
            for end in ends:
                if not is_multiple(end, self.end_step):
                    yield f"ends.{case}", f"{end:g} is not a whole number of {self.end_step:g}"
        if not is_multiple(self.long, self.end_step):
            yield "long", f"is not a whole number of `end_step`, {self.end_step:g}"
        if absent := list(settings.absent("cases", "ends", list(self.ends))):
            yield from absent
            return
        mu = self.mus[0]
        for case in self.ends:
            omega = float(settings.cases[case].omega)
            if not squared_frequency(omega, mu) > 0.0:
                where = f"has {mu:g}, at which the pendula of {case} have no frequency"
                way_out = f"take a mu below {np.sqrt(-1.0 / omega):.4g}"
                yield "mus", f"{where}, since 1 + mu^2 Omega is not positive: {way_out}"
        if all(len(ends) == len(self.mus) for ends in self.ends.values()):
            for key, run_ends in (("ends", self.run_ends), ("long", self.long_ends)):
                seconds = 0.0
                for case, by_mu in run_ends.items():
                    periods = sum(end / (mu * mu) for mu, end in by_mu.items()) / 3.0
                    pairs = integrated_pairs(settings.problem(case))
                    seconds += PERIOD_SECONDS * periods * pairs
                yield from settings.excess(key, [Cost(seconds, 0.0)])


class Followed(Model):
    """What the other topics share: a tolerance, and the runs that they make of cases."""

    may_lose: ClassVar[bool] = False
    """Whether a run may end where a pendulum is lost (see runs.until_lost)."""
    tolerance: Tolerance

    def unfit(
        self, settings: Configuration, cases: Iterable[str], mus: Iterable[float], key: str,
        times: float = 1.0, where: str = "case", **changes,
    ) -> Faults:  # fmt: skip
        """Yield where a case is missing or has no pendula at a mu, or what takes too long."""
        if absent := list(settings.absent("cases", where, cases)):
            yield from absent
            return
        solver = {"name": "taylor", "rtol": self.tolerance, "atol": self.tolerance}
        costs = []
        for name in cases:
            for mu in mus:
                run = settings.problem(name, snapshot_step=None) | {"solver": solver}
                run |= {"model": "pendula", "mu": mu, **changes}
                if why := self._endless(Constants.of(run), mu):
                    yield key, f"has {mu:g}, and {why.format(case=name)}"
                    return
                costs.append(estimate(run))
        yield from settings.excess(key, costs, times)

    def _endless(self, constants: Constants, mu: float) -> str:
        """Return why a run of the pendula at mu may never end, or nothing."""
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
    """An ensemble of perturbed initial conditions of one case."""

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


class Sea(Drawn, Followed):
    """The chaotic state that fills the chain."""

    mus: Positives
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


class OverTheTop(Drawn, Followed):
    """When the first pendulum turns over."""

    may_lose = True
    mus: Positives
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


class Settings(Model):
    """Section `pendula` of the configuration."""

    threshold: Threshold
    remainder: Remainder
    phases: Phases
    sea: Sea
    over_the_top: OverTheTop
    film: Film

    def faults(self, settings: Configuration) -> Faults:
        """Yield the faults of each topic."""
        for topic in ("threshold", "remainder", "phases", "sea", "over_the_top", "film"):
            for key, text in getattr(self, topic).faults(settings):
                yield f"{topic}.{key}", text
