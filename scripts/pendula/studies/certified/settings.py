"""What the configuration says of the proofs: which cases, and which errors they need."""

from typing import Annotated

from pydantic import Field

from pendula.configuration.schema import Configuration, Faults
from pendula.configuration.values import Distinct, Model, Name, Number, Positive


class WrongCurve(Model):
    """A curve of a case, made with other constants than its own, which the proof must find out."""

    case: Name
    end_time: Positive
    epsilon: Number | None = None
    gamma: Number | None = None
    omega: Number | None = None


class Curves(Model):
    """Curves with a proven distance to the true ones."""

    cases: Annotated[list[Name], Field(min_length=1), Distinct]
    wrong: WrongCurve


class Needs(Model):
    """The largest error that each part bears."""

    curves: Positive


class Settings(Model):
    """Section `certified` of the configuration."""

    curves: Curves
    needs: Needs

    def faults(self, settings: Configuration) -> Faults:
        """Yield the cases that the configuration has not."""
        yield from settings.absent("cases", "curves.cases", self.curves.cases)
        yield from settings.absent("cases", "curves.wrong.case", [self.curves.wrong.case])
