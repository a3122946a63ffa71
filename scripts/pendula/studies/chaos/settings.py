"""What the configuration says of chaos: which cases, how long, at which tolerance, which seeds."""

from typing import Annotated

from pydantic import Field

from pendula.configuration.schema import Model, Name, Positive, Whole

Count = Annotated[Whole, Field(ge=1)]
Seed = Annotated[Whole, Field(ge=0)]
Names = Annotated[list[Name], Field(min_length=1)]


class Spectrum(Model):
    """All Lyapunov exponents, on short chains."""

    cases: Names
    half_width: Annotated[Whole, Field(ge=0)]
    lengths: Positive


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


class Settings(Model):
    """Section `chaos` of the configuration."""

    lyapunov: Lyapunov
    symmetry: Symmetry
    ensembles: Ensembles
