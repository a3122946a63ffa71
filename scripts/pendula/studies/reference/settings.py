"""The keys of config/reference.yaml."""

from typing import Annotated

from latticode.configuration.values import Model, Name, Positives, Whole
from pydantic import Field

from pendula.configuration.schema import Configuration, Faults

Bits = Annotated[Whole, Field(ge=64, le=4096)]


class Settings(Model):
    """Section `reference` of the configuration."""

    snapshots: Positives
    bits: dict[Name, tuple[Bits, Bits]]

    def faults(self, settings: Configuration) -> Faults:
        """Yield (key, message) for each of `bits` that is no case of the configuration."""
        yield from settings.absent("cases", "bits", list(self.bits))
