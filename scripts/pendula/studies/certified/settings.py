"""The keys of config/certified.yaml: precision of the proofs for each case, and breathers."""

from typing import Annotated

from latticode.configuration.files import ConfigurationError
from latticode.configuration.values import (
    Count,
    Integer,
    Name,
    Number,
    Positive,
    Section,
    section_of,
)
from pydantic import Field

from pendula.configuration.schema import Faults, PaperConfiguration
from pendula.models.pairs import FAMILIES, pair
from pendula.problem import AMPLITUDES

# Precision of a curve of integers, and how often its error bound changes frames.
Frames = section_of(
    bits=Annotated[Integer, Field(ge=32, le=4096)],
    order=Annotated[Integer, Field(ge=8, le=400)],
    outputs_per_frame=Count,
)


class ProofSection(Section):
    """A steady breather by its family, its Omega and its coupling."""

    family: str
    omega: Number
    epsilon: Positive


class Breathers(Section):
    """Steady breathers whose existence is proved."""

    gamma: Positive
    half_width: Annotated[Integer, Field(ge=2, le=200)]  # a proof with 200 takes minutes
    proofs: Annotated[list[ProofSection], Field(min_length=1)]
    control_omegas: Annotated[
        list[Number], Field(min_length=2, max_length=2)
    ]  # at which the proof of the first state must fail

    def faults(self) -> Faults:
        """Yield an error for each state that a single pair of pendula does not have."""
        named = {family.name: family for family in FAMILIES}
        for i, state in enumerate(self.proofs):
            if state.family not in named:
                yield f"proofs.{i}.family", f"must be one of {', '.join(named)}"
            elif pair(named[state.family], self.gamma, state.omega) is None:
                fault = f"a pair of pendula has no state {state.family} at {state.omega:g}"
                yield f"proofs.{i}.omega", fault


class Settings(Section):
    """Section `certified` of the configuration."""

    frames: dict[Name, Frames]  # by case
    default_frames: Frames  # of cases that `frames` does not list
    breathers: Breathers

    def frames_of(self, case: str) -> Section:
        """Return the precision and the frames for the curve of a case."""
        return self.frames.get(case, self.default_frames)

    def problem(self, settings: PaperConfiguration, case: str) -> dict:
        """Return a case as plain values of a Problem of a certified curve, which needs no solver.

        Raises ConfigurationError for a case to which the proofs do not apply.
        """
        from pendula.problem import (
            PaperProblem,  # imported here: only a certified curve needs kernels
        )

        from .fixed_point import NotEvenError, make_half_chain

        values = settings.problem(case, snapshot_step=None)
        if values.get("model", AMPLITUDES) != AMPLITUDES:
            text = "proofs require the amplitude equations (4)"
            raise ConfigurationError(f"cases.{case}.model: {text}")
        problem = {**values, "solver": {"name": "polynomials"}}
        try:
            make_half_chain(PaperProblem.of(problem), 1)
        except NotEvenError as error:
            raise ConfigurationError(f"cases.{case}: {error}") from None
        return problem

    def faults(self, settings: PaperConfiguration) -> Faults:
        """Yield the errors of missing cases, and of states that do not exist."""
        yield from settings.absent("cases", "frames", self.frames)
        for key, fault in self.breathers.faults():
            yield f"breathers.{key}", fault
