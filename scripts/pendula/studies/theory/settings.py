"""What the configuration says of the checks of the theory: each check by name with its arguments.

The function that takes an argument says what it does there, and config/theory.yaml why it has its
value.
"""

from typing import Annotated

from latticode.configuration.solvers import Solver
from latticode.configuration.values import (
    Count,
    Model,
    Natural,
    Number,
    Positive,
    Whole,
    Window,
    model,
)
from pydantic import Field, create_model


class Grid(Model):
    """Equally spaced numbers from `first` to `last`."""

    first: Number
    last: Number
    points: Annotated[Whole, Field(ge=2, le=1000)]


Size = Annotated[Count, Field(le=100_000)]
"""A number of sites: more of them take hours in every check."""
Sizes = Annotated[list[Size], Field(min_length=3)]
TwoSizes = Annotated[list[Size], Field(min_length=2, max_length=2)]
Time = Annotated[Positive, Field(le=10_000)]
Widths = Annotated[list[Size], Field(min_length=1)]

CHECKS = {
    # alone, since `snakemake paper` needs no other check of the theory
    "not_shown": {
        "not_shown": model(half_widths=Widths, window=Window, omega=Number, solver=Solver)
    },
    "theory": {
        "errata": model(longest=Size),
        "chart": model(omegas=Grid, gammas=Grid, sites=Size, end_time=Time, seed=Natural),
        "threshold": model(sizes=Sizes, above=Positive, end_time=Time, seed=Natural),
        "sharpness": model(sites=Size),
        "chain_growth": model(sizes=TwoSizes),
    },
}
"""The checks of each job: starting one costs more than most checks."""

GROUPS = {group: tuple(checks) for group, checks in CHECKS.items()}

PROVED = ("identities",)
"""What algebra proves, for which there is nothing to set."""


class Section(Model):
    """Section `theory` of the configuration."""

    def arguments(self, group: str) -> dict[str, dict]:
        """Return the arguments of each check of a group as plain values."""
        return {name: getattr(self, name).model_dump() for name in GROUPS[group]}


Settings = create_model(
    "Settings",
    __base__=Section,
    **{name: (kind, ...) for checks in CHECKS.values() for name, kind in checks.items()},
)
