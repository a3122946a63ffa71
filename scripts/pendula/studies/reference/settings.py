"""What the configuration says of the references."""

from typing import Annotated

from pydantic import Field

from pendula.configuration.values import Model, Name, Positive, Whole

Bits = Annotated[Whole, Field(ge=64, le=4096)]


class Settings(Model):
    """Section `reference` of the configuration."""

    snapshots: Annotated[list[Positive], Field(min_length=1)]
    bits: dict[Name, tuple[Bits, Bits]]
