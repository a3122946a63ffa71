"""The keys of config/unbounded.yaml, and the problems on infinite chains that follow from them.

A full run makes the study `short`, and `snakemake unbounded` makes the study `long`.
"""

from collections.abc import Mapping
from typing import Annotated, Any

from latticode.configuration.cases import is_multiple
from latticode.configuration.solvers import Dop853, Taylor
from latticode.configuration.values import (
    Count,
    Counts,
    Integer,
    Name,
    Names,
    Natural,
    Number,
    Numbers,
    Positive,
    Positives,
    Section,
    Tolerance,
    section_of,
)
from pydantic import Field

from pendula.configuration.cost import estimate
from pendula.configuration.runs import Runs
from pendula.configuration.schema import Faults, PaperConfiguration

from .bulk import SLICE_LENGTH

SPEED = 5.0
"""Upper bound on the speeds of fronts in the paper's cases, in sites per unit of epsilon tau."""

GROWTH_CASES = ("fig4_small", "fig3_large", "fig2_large", "fig3_small")
"""The cases that the figure growth_law and the claims need."""

OMEGAS = "omegas"
"""Name of the ensemble over Omega. Ensembles of one case have its name."""
STARTS = "starts"
"""Name of the ensemble over initial conditions of the central pair."""


class Size(Section):
    """Solver, threshold of rest, end times and numbers of members of a study."""

    solver: Annotated[Dop853 | Taylor, Field(discriminator="name")]
    rest_threshold: Positive  # relative to the largest amplitude
    runs: dict[Name, section_of(end_time=Positive, members=Count)]


class Transverse(Section):
    """Runs that measure the growth of a small A + B; the first of each list is printed."""

    end_time: Positive
    slow_from: Number  # Omega from which runs last until slow_end_time
    slow_end_time: Positive
    members: Count
    tolerances: list[Tolerance]
    perturbations: Positives

    def end_times(self, omegas: list[float]) -> list[float]:
        """Return the end time for each Omega."""
        return [
            self.slow_end_time if omega >= self.slow_from else self.end_time for omega in omegas
        ]


class Noise(Section):
    """Runs with noise added to A + B; numbers at the first tolerance are printed."""

    omegas: Numbers
    end_times: list[Positive]  # one for each Omega
    sizes: Positives
    members: Count
    tolerances: list[Tolerance]


class LongSize(Size):
    """The long study, with choices for variations of its numbers; the first of each is printed."""

    levels: Positives  # of |S|^2 behind the second front
    edges: Counts  # sites behind the first front that do not count as between the fronts
    coarse: Tolerance  # tolerance of the repeated runs
    transverse: Transverse
    noise: Noise

    @property
    def made_coarsely(self) -> "LongSize":
        """The study with the coarser tolerance."""
        changes = dict.fromkeys(("rtol", "atol"), self.coarse)
        return self.model_copy(update={"solver": self.solver.model_copy(update=changes)})


class Settings(Section):
    """Section `unbounded` of the configuration."""

    output_step: Positive
    perturbation: Positive
    seed: Natural
    cases: Names
    omegas: section_of(case=Name, values=Numbers)
    starts: section_of(
        case=Name, values=Annotated[list[tuple[Number, Number]], Field(min_length=1)]
    )
    nodes: Annotated[Integer, Field(ge=8, le=100)]
    short: Size
    long: LongSize

    def faults(self, settings: PaperConfiguration) -> Faults:
        """Yield errors in cases and ensembles, and for runs that take too long."""
        used = [("omegas.case", self.omegas.case), ("starts.case", self.starts.case)]
        used += [("cases", case) for case in self.cases]
        absent = [fault for key, case in used for fault in settings.absent("cases", key, [case])]
        sizes = {"short": self.short, "long": self.long}
        for label, size in sizes.items():
            unknown = size.runs.keys() - {*self.names, *settings.cases}
            missing = [name for name in self.names if name not in size.runs]
            message = f"is not an ensemble: {OMEGAS}, {STARTS} or the name of a case"
            absent += [(f"{label}.runs.{name}", message) for name in sorted(unknown)]
            absent += [(f"{label}.runs.{name}", "is missing") for name in missing]
        for case in GROWTH_CASES:
            if case not in self.cases:
                absent.append(("cases", f"lacks {case}, which the figure growth_law shows"))
        yield from absent
        if absent:
            return
        yield from self._faults_of_band(settings)
        if self.output_step > SLICE_LENGTH:
            text = f"is {self.output_step:g}; it must be at most {SLICE_LENGTH:g}"
            yield "output_step", f"{text}, because sites are added only at outputs"
            return
        for label, size in sizes.items():
            yield from self._faults_of_size(settings, label, size)
        yield from self._faults_of_noise()

    def _faults_of_band(self, settings: PaperConfiguration) -> Faults:
        """Yield an error if no Omega is in the unstable band, where fronts spread."""
        case = settings.cases[self.omegas.case]
        low, high = -2.0 * abs(case.gamma), 2.0 * abs(case.gamma) + 4.0 * max(case.epsilon, 0.0)
        if not any(low < omega < high for omega in self.omegas.values):
            text = f"has no value between {low:g} and {high:g}, where zero is unstable"
            yield "omegas.values", f"{text} (for epsilon and gamma of cases.{self.omegas.case})"

    def _faults_of_noise(self) -> Faults:
        """Yield an error unless there is one end time for each Omega."""
        noise = self.long.noise
        if len(noise.end_times) != len(noise.omegas):
            text = f"has {len(noise.end_times)} values; it must have {len(noise.omegas)}"
            yield "long.noise.end_times", f"{text}, one for each of the omegas"

    def _faults_of_size(self, settings: PaperConfiguration, label: str, size: Size) -> Faults:
        for name, run in size.runs.items():
            if not is_multiple(run.end_time, self.output_step):
                text = f"{run.end_time:g} is not a multiple of output_step"
                yield f"{label}.runs.{name}.end_time", f"{text} = {self.output_step:g}"
            if run.end_time <= SLICE_LENGTH:
                text = f"is {run.end_time:g}; it must be above {SLICE_LENGTH:g}"
                yield f"{label}.runs.{name}.end_time", f"{text} to measure the speed of a front"
        for name in self.names:
            run = size.runs[name]
            problems = self.problems(settings.problem(self.case_of(name)), name, size)
            drawn = Runs(
                "", f"{label}.solver.atol", problems, 1.0, "perturbation", self.perturbation
            )
            if unfit := list(drawn.faults()):
                yield from unfit
                return
            # the front moves at SPEED, so the mean half-width is half of its final distance
            reach = 0.5 * SPEED * abs(problems[0]["epsilon"]) * run.end_time
            cost = estimate(problems[0] | {"half_width": max(1.0, reach), "snapshot_every": 0})
            count = len(problems) * run.members
            key = "end_time" if cost.seconds * len(problems) > run.members else "members"
            yield from settings.excess(f"{label}.runs.{name}.{key}", [cost], count)

    @property
    def names(self) -> list[str]:
        """The names of all ensembles: of cases, over Omega, and over initial conditions."""
        return [*self.cases, OMEGAS, STARTS]

    def case_of(self, name: str) -> str:
        """Return the case of the paper that an ensemble is based on."""
        return {OMEGAS: self.omegas.case, STARTS: self.starts.case}.get(name, name)

    def problems(self, case: Mapping[str, Any], name: str, size: Size) -> list[dict]:
        """Return the problems of an ensemble, one for each Omega or for each initial condition."""
        base = {
            **{key: case[key] for key in ("epsilon", "gamma", "omega", "initial")},
            "half_width": None,
            "boundary": "dirichlet",
            "end_time": size.runs[name].end_time,
            "output_step": self.output_step,
            "solver": size.solver.model_dump(),
        }
        if name == STARTS:
            return [base | {"initial": {0: pair}} for pair in self.starts.values]
        omegas = self.omegas.values if name == OMEGAS else [base["omega"]]
        return [base | {"omega": omega} for omega in omegas]

    def timed(
        self, case: Mapping[str, Any], omegas: list[float], end_times: list[float]
    ) -> list[dict]:
        """Return the problems of the long study at `omegas`, each with its own end time."""
        base = self.problems(case, self.omegas.case, self.long)[0]
        pairs = zip(omegas, end_times, strict=True)
        return [base | {"omega": omega, "end_time": end} for omega, end in pairs]
