"""What the configuration says of chaos: which cases, how long, at which tolerance, which seeds."""

from typing import Annotated, Literal

from pydantic import Field

from pendula.configuration.values import Model, Name, Positive, Whole, Window

Count = Annotated[Whole, Field(ge=1)]
Seed = Annotated[Whole, Field(ge=0)]
Names = Annotated[list[Name], Field(min_length=1)]


class Spectrum(Model):
    """All Lyapunov exponents, on short chains; `lengths` are by half-width."""

    cases: Names
    tolerance: Positive
    lengths: Annotated[dict[Annotated[Whole, Field(ge=0)], Positive], Field(min_length=1)]


class Lyapunov(Model):
    """The largest exponents of every case; `lengths` multiplies the end time of the longest."""

    lengths: Positive
    tolerance: Positive
    diverging_tolerances: Annotated[list[Positive], Field(min_length=1)]
    spectrum: Spectrum


class Symmetry(Model):
    """How even data lose their evenness."""

    tolerance: Positive
    size: Positive
    members: Count
    seed: Seed


class Ensembles(Model):
    """Cases and sweeps from data that differ in their last digits."""

    cases: Names
    sweeps: Names
    tolerance: Positive
    size: Positive
    members: Count
    swept_members: Annotated[Whole, Field(ge=2)]
    every: Count
    seed: Seed


class Members(Model):
    """Ensembles of every case, each member reduced to numbers over windows of time."""

    windows: Annotated[list[Window], Field(min_length=2, max_length=2)]
    tolerance: Positive
    size: Positive
    members: Annotated[Whole, Field(ge=3)]
    every: Count
    seed: Seed


class Compared(Model):
    """One amplitude again, by other tolerances and kinds of ensembles."""

    amplitude: Positive
    choices: Annotated[list[tuple[Positive, Literal["even", "uneven"]]], Field(min_length=1)]


class Lifetimes(Model):
    """How long the central pendulum stays localised, against its initial amplitude."""

    case: Name
    amplitudes: Annotated[list[Positive], Field(min_length=2)]
    ratio: Positive
    members: Count
    size: Positive
    tolerance: Positive
    end_time: Positive
    output_step: Positive
    settled: Positive
    seed: Seed
    compared: Compared


class Settings(Model):
    """Section `chaos` of the configuration."""

    lyapunov: Lyapunov
    symmetry: Symmetry
    ensembles: Ensembles
    members: Members
    lifetimes: Lifetimes
