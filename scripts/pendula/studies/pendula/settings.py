"""What the configuration says of the pendula, a model for each topic."""

from typing import Annotated

from pydantic import Field

from pendula.configuration.schema import Configuration, Faults
from pendula.configuration.values import Distinct, Model, Needs, Number, Positive, Steps, Whole

from .mathieu import second_tongue
from .threshold import squared_frequency

Count = Annotated[Whole, Field(ge=1)]
Numbers = Annotated[list[Number], Field(min_length=1), Distinct]
Positives = Annotated[list[Positive], Field(min_length=1), Distinct]


class Growth(Model):
    """Rates of growth: at which detunings, by how strong a drive."""

    omegas: Numbers
    gammas: Steps


class Threshold(Model):
    """Lemma 1 for the pendula."""

    epsilon: Positive
    omegas: Numbers
    mus: Positives
    half_width: Count
    growth: Growth
    curve: Steps

    def faults(self) -> Faults:
        """Yield what does not run forward, or where Mathieu's equation is not known well enough."""
        for key, steps in (("growth.gammas", self.growth.gammas), ("curve", self.curve)):
            if not steps.first < steps.last:
                yield key, f"does not run forward from {steps.first:g} to {steps.last:g}"
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


class Settings(Model):
    """Section `pendula` of the configuration."""

    needs: Needs
    threshold: Threshold

    def faults(self, settings: Configuration) -> Faults:
        """Yield the faults of each topic."""
        for topic in ("threshold",):
            for key, text in getattr(self, topic).faults():
                yield f"{topic}.{key}", text
