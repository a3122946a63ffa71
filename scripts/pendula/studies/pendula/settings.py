"""What the configuration says of the pendula, a model for each topic."""

from itertools import pairwise
from typing import Annotated

import numpy as np
from pydantic import Field

from pendula.configuration.cases import is_multiple
from pendula.configuration.cost import Cost, integrated_pairs
from pendula.configuration.schema import Configuration, Faults
from pendula.configuration.values import (
    Count,
    Model,
    Name,
    Needs,
    Numbers,
    Positive,
    Positives,
    Steps,
    Tolerance,
    model,
)

from .mathieu import second_tongue, squared_frequency
from .settings_phases import Film, OverTheTop, Phases, Sea

PERIOD_SECONDS = 2e-6
"""A period of a pair of pendula."""


class Threshold(Model):
    """Lemma 1 for the pendula."""

    epsilon: Positive
    omegas: Numbers
    mus: Positives
    half_width: Count
    growth: model(omegas=Numbers, gammas=Steps)
    curve: Steps

    def faults(self) -> Faults:
        """Yield where Mathieu's equation is not known well enough."""
        named = {"omegas": self.omegas, "growth.omegas": self.growth.omegas}
        for key, omegas in {**named, "curve.first": [self.curve.first]}.items():
            yield from self._too_low(key, min(omegas))
        if not list(self._too_low("growth.omegas", min(self.growth.omegas))):
            yield from self._too_strong()

    def _too_low(self, key: str, omega: float) -> Faults:
        mu = max(self.mus)
        if 4.0 * squared_frequency(omega, mu) <= 1.0:
            where = f"has {omega:g}, and at mu = {mu:g} every wave there lies"
            way_out = f"take an Omega above {-0.75 / (mu * mu):.4g}, or a smaller mu"
            yield key, f"{where} above the second resonance of the drive: {way_out}"

    def _too_strong(self) -> Faults:
        mu, gamma = max(self.mus), self.growth.gammas.last
        for omega in self.growth.omegas:
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
        absent = list(settings.absent("cases", "ends", list(self.ends)))
        yield from absent
        for case in () if absent else self.ends:
            yield from self._too_slow(case, float(settings.cases[case].omega))
        if not absent and all(len(ends) == len(self.mus) for ends in self.ends.values()):
            for key, run_ends in (("ends", self.run_ends), ("long", self.long_ends)):
                yield from settings.excess(key, [self._cost(settings, run_ends)])

    def _cost(self, settings: Configuration, run_ends: dict[str, dict[float, float]]) -> Cost:
        """Return what all runs take, from the periods of the pendula in them."""
        seconds = 0.0
        for case, by_mu in run_ends.items():
            pairs = integrated_pairs(settings.problem(case))
            periods = sum(end / (mu * mu) for mu, end in by_mu.items()) / 3.0
            seconds += PERIOD_SECONDS * periods * pairs
        return Cost(seconds, 0.0)

    def _too_slow(self, case: str, omega: float) -> Faults:
        mu = self.mus[0]
        if not squared_frequency(omega, mu) > 0.0:
            where = f"has {mu:g}, at which the pendula of {case} have no frequency"
            way_out = f"take a mu below {np.sqrt(-1.0 / omega):.4g}"
            yield "mus", f"{where}, since 1 + mu^2 Omega is not positive: {way_out}"


class Settings(Model):
    """Section `pendula` of the configuration."""

    needs: Needs
    threshold: Threshold
    remainder: Remainder
    phases: Phases
    sea: Sea
    over_the_top: OverTheTop
    film: Film

    def faults(self, settings: Configuration) -> Faults:
        """Yield the faults of each topic."""
        found = {
            "threshold": self.threshold.faults(),
            "remainder": self.remainder.faults(settings),
            "phases": self.phases.faults(settings),
            "sea": self.sea.faults(settings),
            "over_the_top": self.over_the_top.faults(settings),
            "film": self.film.faults(settings),
        }
        for topic, faults in found.items():
            for key, text in faults:
                yield f"{topic}.{key}", text
