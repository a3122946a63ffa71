"""What the configuration gives for the pendula: a model for each topic."""

from collections.abc import Iterable
from itertools import pairwise
from typing import Annotated, ClassVar

import numpy as np
from latticode.configuration.cases import is_multiple
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
    Window,
    model,
)
from pydantic import Field

from pendula.configuration.cost import Cost, estimate, integrated_pairs
from pendula.configuration.schema import PAPER_CASES, Configuration, Faults
from pendula.problem import Constants

from .mathieu import squared_frequency, strength, strings_grow

PERIOD_SECONDS = 2e-6
"""Computing time of a period of a pair of pendula."""
STRONGEST = 10.0
"""The largest q of Mathieu's equation: the drive makes pendula e^11 times faster in a period."""


class Threshold(Model):
    """Lemma 1 for the pendula."""

    epsilon: Positive
    omegas: Numbers
    mus: Positives

    def faults(self, settings: Configuration) -> Faults:
        """Yield where Mathieu's equation is not known well enough."""
        mu, omega = max(self.mus), min(self.omegas)
        if 4.0 * squared_frequency(omega, mu) <= 1.0:
            where = f"has {omega:g}, and at mu = {mu:g} every wave there lies"
            way_out = f"take an Omega above {-0.75 / (mu * mu):.4g}, or a smaller mu"
            yield "omegas", f"{where} above the second resonance of the drive: {way_out}"


class Remainder(Model):
    """The error of the expansion (3), and of its next order."""

    mus: Annotated[list[Positive], Field(min_length=3)]
    ends: list[Positive]
    end_step: Positive
    spacing: Positive
    tolerance: Tolerance

    @property
    def run_ends(self) -> dict[float, float]:
        """How far the pendula are run, by mu."""
        return dict(zip(self.mus, self.ends, strict=True))

    def faults(self, settings: Configuration) -> Faults:
        """Yield what gives no order in mu, or is no whole number of steps."""
        if any(abs(2.0 * fine / coarse - 1.0) > 1e-9 for coarse, fine in pairwise(self.mus)):
            yield "mus", "must each be half of the one before: orders are read off such pairs"
        if not is_multiple(self.end_step, self.spacing):
            yield "end_step", f"is not a whole number of `spacing`, {self.spacing:g}"
        for end in self.ends:
            if not is_multiple(end, self.end_step):
                yield "ends", f"{end:g} is not a whole number of {self.end_step:g}"
        if len(self.ends) != len(self.mus):
            told = f"has {len(self.ends)} ends for {len(self.mus)} values of mu"
            yield "ends", f"{told}: give one for each"
            return
        mu, cases = self.mus[0], [name for name in PAPER_CASES if name in settings.cases]
        for case in cases:
            omega = float(settings.cases[case].omega)
            if not squared_frequency(omega, mu) > 0.0:
                where = f"has {mu:g}, at which the pendula of {case} have no frequency"
                way_out = f"take a mu below {np.sqrt(-1.0 / omega):.4g}"
                yield "mus", f"{where}, since 1 + mu^2 Omega is not positive: {way_out}"
        pairs = sum(integrated_pairs(settings.problem(case)) for case in cases)
        periods = sum(end / (mu * mu) for mu, end in self.run_ends.items()) / 3.0
        yield from settings.excess("ends", [Cost(PERIOD_SECONDS * periods * pairs, 0.0)])


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
        """Return why a run of the pendula at mu may never end, or nothing.

        Of a negative epsilon the case itself tells, since no figure of the paper has one.
        """
        if constants.epsilon < 0.0:
            return ""
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


class Settings(Model):
    """Section `pendula` of the configuration."""

    threshold: Threshold
    remainder: Remainder
    sea: Sea
    over_the_top: OverTheTop

    def faults(self, settings: Configuration) -> Faults:
        """Yield the faults of each topic."""
        for topic in ("threshold", "remainder", "sea", "over_the_top"):
            for key, text in getattr(self, topic).faults(settings):
                yield f"{topic}.{key}", text
