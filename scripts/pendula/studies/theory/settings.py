"""What the configuration says of the checks of the theory: each check by name with its arguments.

An argument has one type, whichever check it stands in. The function that takes it says what it does
there, and config/theory.yaml why it has its value.
"""

from typing import Annotated, Literal

from latticode.configuration.solvers import Solver
from latticode.configuration.values import (
    Complex,
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

from pendula.problem import BOUNDARIES

Size = Annotated[Count, Field(le=100_000)]
"""A number of sites, samples or members: more of them take hours in every check."""
Sizes = Annotated[list[Size], Field(min_length=1)]


class Constants(Model):
    """The constants of equations (4), all of them given."""

    epsilon: Number
    gamma: Number
    omega: Number


class Grid(Model):
    """Equally spaced numbers from `first` to `last`, or such numbers' logarithms."""

    first: Number
    last: Number
    points: Annotated[Whole, Field(ge=2, le=1000)]
    spacing: Literal["linear", "logarithmic"] = "linear"


ARGUMENTS = {
    "constants": Constants,
    **dict.fromkeys(("epsilon", "gamma", "omega"), Number),
    "omegas": Annotated[list[Number], Field(min_length=1)],
    "gammas": Grid,
    "boundary": Literal[BOUNDARIES],
    "solver": Solver,
    # chains and their data
    **dict.fromkeys(("sites", "ring_sites"), Size),
    **dict.fromkeys(("sizes", "half_widths"), Sizes),  # `sizes` are numbers of sites
    "pair": tuple[Complex, Complex],  # (A_0, B_0)
    **dict.fromkeys(("norm", "above", "amplitude", "longer", "longest"), Positive),
    "distances": Annotated[list[Positive], Field(min_length=2)],
    "decays": Annotated[list[Annotated[Number, Field(gt=0.5)]], Field(min_length=1)],
    "part": Annotated[Number, Field(gt=0, lt=1)],
    # times
    "end_time": Annotated[Positive, Field(le=10_000)],
    "foldings": Positive,
    "times": Annotated[list[Positive], Field(min_length=1)],
    "long_times": Annotated[list[Positive], Field(min_length=3)],  # each twice the one before
    "window": Window,
    # random data
    "seed": Natural,
    **dict.fromkeys(("samples", "count"), Size),
    "members": Annotated[Whole, Field(ge=2)],
}


def check(names: str, **own) -> type[Model]:
    """Return the model of what a check takes: some of ARGUMENTS, and what has a type of its own."""
    return model(**{name: ARGUMENTS[name] for name in names.split()} | own)


CHART = "gammas epsilon sites boundary end_time seed"

CHECKS = {
    # alone, since `snakemake paper` needs no other check of the theory
    "not_shown": {"not_shown": check("half_widths window omega solver")},
    "stability": {
        "chart": check(CHART, omegas=Grid),
        "short_chart": check(f"{CHART} foldings", omegas=Grid),
        "windows": check("epsilon boundary half_widths gammas"),
        "measured_windows": check("gamma epsilon sites boundary end_time seed"),
        "sharp_threshold": check("epsilon omegas sizes"),
        "unstable_waves": check("epsilon omegas above sites end_time seed"),
        "threshold": check("epsilon sites omegas times above decays long_times ring_sites"),
    },
    "bounds": {
        # errors and gaps of the proofs
        "theorem_3_constant": check("constants amplitude", longest=Size),
        "theorem_2_case": check("constants pair sites"),
        "bootstrap": check("constants part longest"),
        # Lemma 2 and Theorems 1 to 3
        "picard": check("constants sites norm longer seed"),
        "dependence": check("constants sites end_time distances samples seed"),
        "samples": check("count sizes end_time seed"),
        "sharpness": check("epsilon gamma sizes"),
        "chain_growth": check("epsilon gamma omegas sizes pair end_time members seed"),
        "energy_shell": check("epsilon gamma omegas sizes pair"),
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
