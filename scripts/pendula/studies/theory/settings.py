"""What the configuration says of the checks of the theory: each check by name with its arguments.

An argument has one type, whichever check it stands in. The function that takes it says what it does
there, and config/theory.yaml why it has its value.
"""

from typing import Annotated, Literal

from pydantic import Field, create_model

from pendula.configuration.solvers import Solver
from pendula.configuration.values import (
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
from pendula.ends import ENDS

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
    "points": Annotated[list[tuple[Number, Number]], Field(min_length=1)],  # (Omega, gamma)
    "boundary": Literal[tuple(ENDS)],
    "solver": Solver,
    # chains and their data
    **dict.fromkeys(("sites", "ring_sites"), Size),
    **dict.fromkeys(("sizes", "half_widths"), Sizes),  # `sizes` are numbers of sites
    "pair": tuple[Complex, Complex],  # (A_0, B_0)
    **dict.fromkeys(("norm", "above", "mu", "amplitude", "longest"), Positive),
    **dict.fromkeys(("distances", "mus"), Annotated[list[Positive], Field(min_length=2)]),
    "decays": Annotated[list[Annotated[Number, Field(gt=0.5)]], Field(min_length=1)],
    "ratios": Annotated[list[Positive], Field(min_length=1)],
    "part": Annotated[Number, Field(gt=0, lt=1)],
    # times
    "end_time": Annotated[Positive, Field(le=10_000)],
    "foldings": Positive,
    "times": Annotated[list[Positive], Field(min_length=1)],
    "long_times": Annotated[list[Positive], Field(min_length=3)],  # each twice the one before
    "window": Window,
    "panels": Size,
    # random data
    "seed": Natural,
    **dict.fromkeys(("samples", "count", "generations", "starts"), Size),
    "members": Annotated[Whole, Field(ge=2)],
    "population": Annotated[Whole, Field(ge=4)],
    # what a wrong statement has in place of the right one
    **dict.fromkeys(("omega_off", "gamma_times", "sign", "root"), Number),
    **dict.fromkeys(("scale", "span_times"), Positive),
    "turn": Complex,
    "below_barrier": bool,
}


def check(names: str, **own) -> type[Model]:
    """Return the model of what a check takes: some of ARGUMENTS, and what has a type of its own."""
    return model(**{name: ARGUMENTS[name] for name in names.split()} | own)


CHART = "gammas epsilon sites boundary end_time seed"

CHECKS = {
    "equations": {
        # Section 2
        "gradient": check("constants sites samples seed"),
        "symmetries": check("constants sites end_time seed"),
        "opposite": check("constants sites end_time seed"),
        "pt_form": check("constants sites end_time seed"),
        "conservation": check("epsilon gamma omegas sites end_time seed"),
        # Newton's equations
        "expansion": check("constants sites end_time mus pair"),
        "pendula_synchrony": check("constants sites mu end_time seed"),
        "inherited_energy": check("constants sites end_time mus seed"),
        "resonance": check("gamma mus ratios"),
        # errors and gaps of the paper
        "theorem_3_constant": check("constants amplitude", longest=Size),
        "theorem_2_case": check("constants pair sites"),
        "negative_depth": check("constants count seed"),
        "bootstrap": check("constants part longest"),
    },
    # alone, since `snakemake paper` needs no other check of the theory
    "not_shown": {"not_shown": check("half_widths window omega solver")},
    "stability": {
        "dispersion": check("points epsilon sites"),
        "chart": check(CHART, omegas=Grid),
        "short_chart": check(f"{CHART} foldings", omegas=Grid),
        "windows": check("epsilon boundary half_widths gammas"),
        "measured_windows": check("gamma epsilon sites boundary end_time seed"),
        "sharp_threshold": check("epsilon omegas sizes"),
        "unstable_waves": check("epsilon omegas above sites end_time seed"),
        "threshold": check("epsilon sites omegas times decays long_times ring_sites"),
    },
    "bounds": {
        "picard": check("constants sites norm seed"),
        "dependence": check("constants sites end_time distances samples seed"),
        "balance": check("constants sites end_time panels seed"),
        "growth": check("constants sites end_time samples seed"),
        "inequalities": check("count seed"),
        "samples": check("count sizes end_time seed"),
        "worst": check("epsilon gamma sites end_time generations population starts seed"),
        "sharpness": check("epsilon gamma sizes"),
        "chain_growth": check("constants sizes pair end_time members seed"),
        "energy_shell": check("constants sizes pair"),
    },
}
"""The checks of each job: starting one costs more than most checks."""

GROUPS = {group: tuple(checks) for group, checks in CHECKS.items()}

WRONG = (
    *("gradient", "conservation", "no_drive", "phase_turned", "symmetries", "pt_form"),
    "pt_no_drive",
    *("expansion", "pendula_synchrony", "inherited_energy", "negative_depth"),
    *("bootstrap", "dispersion", "chart", "measured_windows", "sharp_threshold"),
    *("unstable_waves", "threshold", "picard", "picard_at_rest", "dependence", "balance", "growth"),
    *("inequalities", "samples", "worst", "sharpness", "chain_growth", "energy_shell"),
)
"""The wrong statements that the negative controls of the claims are fed."""

WRONG_FOLDER = "wrong/"
"""Before the name of a check that is asked about a wrong statement: it must not hold."""

Omegas = Grid | Annotated[list[Number], Field(min_length=1)]

Changes = create_model(
    "Changes",
    __base__=Model,
    check=(Literal[tuple(name for names in GROUPS.values() for name in names)] | None, None),
    **{name: (kind | None, None) for name, kind in (ARGUMENTS | {"omegas": Omegas}).items()},
)
"""The arguments of a check that a wrong statement changes; `check` says which, if not its name."""

OBSERVED = ("cases", "sweeps")
"""The checks of the paper's own trajectories and sweeps, which need their datasets."""


class Section(Model):
    """Section `theory` of the configuration."""

    def arguments(self, group: str) -> dict[str, dict]:
        """Return the arguments of each check of a group as plain values."""
        return {name: getattr(self, name).model_dump() for name in GROUPS[group]}

    def wrong_arguments(self) -> dict[str, dict]:
        """Return the arguments of each wrong statement: those of its check, some changed."""
        found = {}
        for name in WRONG:
            given = getattr(self.wrong, name)
            changes = {"check": name} | given.model_dump(include=given.model_fields_set)
            right = getattr(self, changes["check"]).model_dump()
            found[f"{WRONG_FOLDER}{name}"] = right | changes
        return found


Settings = create_model(
    "Settings",
    __base__=Section,
    wrong=(model(**dict.fromkeys(WRONG, Changes)), ...),
    **{name: (kind, ...) for checks in CHECKS.values() for name, kind in checks.items()},
)
