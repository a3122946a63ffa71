"""The keys of config/certified.yaml: precision of the proofs for each case, and breathers."""

from typing import Annotated

from latticode.configuration.values import (
    Count,
    Model,
    Name,
    Number,
    Positive,
    Whole,
    model,
)
from pydantic import Field

from pendula.configuration.schema import Configuration, Faults
from pendula.models.pairs import FAMILIES, pair

# Precision of a curve of integers, and how often its error bound changes frames.
Frames = model(
    bits=Annotated[Whole, Field(ge=32, le=4096)],
    order=Annotated[Whole, Field(ge=8, le=400)],
    outputs_per_frame=Count,
)


class ProofSection(Model):
    """A steady breather by its family, its Omega and its coupling."""

    family: str
    omega: Number
    epsilon: Positive


class Breathers(Model):
    """Steady breathers whose existence is proved."""

    gamma: Positive
    half_width: Annotated[Whole, Field(ge=2, le=200)]  # at the largest a proof takes minutes
    proofs: Annotated[list[ProofSection], Field(min_length=1)]
    control_omegas: Annotated[
        list[Number], Field(min_length=2, max_length=2)
    ]  # tests of the first state

    def faults(self) -> Faults:
        """Yield faults of states that a single pair of pendula does not have."""
        named = {family.name: family for family in FAMILIES}
        for i, state in enumerate(self.proofs):
            if state.family not in named:
                yield f"proofs.{i}.family", f"is none of {', '.join(named)}"
            elif pair(named[state.family], self.gamma, state.omega) is None:
                fault = f"no pair of pendula has a state {state.family} at {state.omega:g}"
                yield f"proofs.{i}.omega", fault


class Settings(Model):
    """Section `certified` of the configuration."""

    frames: dict[Name, Frames]  # by case
    default_frames: Frames  # of cases that `frames` does not list
    breathers: Breathers

    def faults(self, settings: Configuration) -> Faults:
        """Yield faults of missing cases, and of states that do not exist."""
        yield from settings.absent("cases", "frames", self.frames)
        for key, fault in self.breathers.faults():
            yield f"breathers.{key}", fault
