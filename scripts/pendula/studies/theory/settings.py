"""What the configuration says of the checks of the theory: each check by name with its arguments.

Random data are drawn from the `seed` of each check.
"""

from typing import Annotated, Literal

from pydantic import Field

from pendula.configuration.schema import Complex, Model, Number, Positive, Solver, Whole, Window

Count = Annotated[Whole, Field(ge=1)]
Seed = Annotated[Whole, Field(ge=0)]
Numbers = Annotated[list[Number], Field(min_length=1)]
Boundary = Literal["dirichlet", "free", "periodic"]

GROUPS = {
    "equations": (
        # Section 2
        *("gradient", "symmetries", "opposite", "pt_form", "conservation", "expansion"),
        # errors and gaps of the paper
        *("theorem_3_constant", "theorem_2_case", "negative_depth", "energy_drift", "not_shown"),
    ),
    "stability": (
        *("dispersion", "chart", "short_chart"),
        *("windows", "measured_windows", "threshold"),
    ),
    "bounds": ("balance", "growth", "inequalities", "samples", "worst"),
}
"""Which checks share a job: starting one costs more than most checks."""

OBSERVED = ("cases", "sweeps")
"""The checks of the paper's own trajectories and sweeps, which need their datasets."""


class Constants(Model):
    """The constants of equations (4), all of them given."""

    epsilon: Number
    gamma: Number
    omega: Number


class Grid(Model):
    """Equally spaced numbers from `first` to `last`, or such numbers' logarithms."""

    first: Number
    last: Number
    points: Annotated[Whole, Field(ge=2)]
    spacing: Literal["linear", "logarithmic"] = "linear"


class Gradient(Model):
    """The right-hand side against the gradient of the energy."""

    constants: Constants
    sites: Count
    samples: Count
    seed: Seed


class Run(Model):
    """Random data of so many sites, run to an end time."""

    constants: Constants
    sites: Count
    end_time: Positive
    seed: Seed


class Conservation(Model):
    """What the flow conserves, at several detunings."""

    epsilon: Number
    gamma: Number
    omegas: Numbers
    sites: Count
    end_time: Positive
    seed: Seed


class Expansion(Model):
    """Newton's equations against the expansion in mu, from `pair` = (A_0, B_0)."""

    constants: Constants
    sites: Count
    end_time: Positive
    mus: Annotated[list[Positive], Field(min_length=2)]
    pair: tuple[Complex, Complex]


class Dispersion(Model):
    """Eigenvalues at points (Omega, gamma)."""

    points: Annotated[list[tuple[Number, Number]], Field(min_length=1)]
    epsilon: Number
    sites: Count


class Chart(Model):
    """Growth rates over a grid of (Omega, gamma); `foldings` ends runs before rounding shows."""

    omegas: Grid
    gammas: Grid
    epsilon: Number
    sites: Count
    boundary: Boundary
    end_time: Positive
    foldings: Positive | None = None
    seed: Seed


class Windows(Model):
    """The windows of stability of finite chains."""

    epsilon: Number
    boundary: Boundary
    half_widths: Annotated[list[Count], Field(min_length=1)]
    gammas: Grid


class MeasuredWindows(Model):
    """Growth inside these windows and between them."""

    gamma: Number
    epsilon: Number
    sites: Count
    boundary: Boundary
    end_time: Positive
    seed: Seed


class Threshold(Model):
    """Growth at the threshold: of a mode by `times`, on a long ring by `long_times`."""

    epsilon: Number
    sites: Count
    omegas: Numbers
    times: Annotated[list[Positive], Field(min_length=1)]
    long_times: Annotated[list[Positive], Field(min_length=2)]
    ring_sites: Count


class Balance(Run):
    """The balance of Lemma 2, integrated over so many panels."""

    panels: Count


class Growth(Run):
    """The bound (19), on so many random data."""

    samples: Count


class Inequalities(Model):
    """The inequalities of Section 4, on so many random states."""

    count: Count
    seed: Seed


class Samples(Model):
    """Random data inside the proven regions: so many for each number of sites and each region."""

    count: Count
    sizes: Annotated[list[Count], Field(min_length=1)]
    end_time: Positive
    seed: Seed


class Worst(Model):
    """The search for the data that come nearest to the bounds."""

    epsilon: Number
    gamma: Number
    sites: Count
    end_time: Positive
    generations: Count
    population: Annotated[Whole, Field(ge=4)]
    seed: Seed


class Theorem3Constant(Model):
    """The smallest chain that breaks the printed lower bound."""

    constants: Constants
    amplitude: Positive
    longest: Count


class Theorem2Case(Model):
    """The paper's small case beside the region of Theorem 2."""

    constants: Constants
    pair: tuple[Complex, Complex]
    sites: Count


class NegativeDepth(Model):
    """Where -H > 0 fails: pairs (x, 0) up to `longest`."""

    constants: Constants
    longest: Positive


class EnergyDrift(Model):
    """The drift of the energy by a solver, at several detunings."""

    solver: Solver
    end_time: Positive
    omegas: Numbers


class NotShown(Model):
    """The sweep that the paper mentions and does not show."""

    half_widths: Annotated[list[Count], Field(min_length=1)]
    window: Window
    omega: Number
    solver: Solver


class Settings(Model):
    """Section `theory` of the configuration."""

    gradient: Gradient
    symmetries: Run
    opposite: Run
    pt_form: Run
    conservation: Conservation
    expansion: Expansion
    theorem_3_constant: Theorem3Constant
    theorem_2_case: Theorem2Case
    negative_depth: NegativeDepth
    energy_drift: EnergyDrift
    not_shown: NotShown
    dispersion: Dispersion
    chart: Chart
    short_chart: Chart
    windows: Windows
    measured_windows: MeasuredWindows
    threshold: Threshold
    balance: Balance
    growth: Growth
    inequalities: Inequalities
    samples: Samples
    worst: Worst

    def arguments(self, group: str) -> dict[str, dict]:
        """Return the arguments of each check of a group as plain values."""
        return {name: getattr(self, name).model_dump() for name in GROUPS[group]}
