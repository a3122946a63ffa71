"""The configuration of cases and sweeps, with checks for the paper's studies."""

from collections.abc import Callable, Iterable, Mapping
from typing import Annotated, Any, ClassVar

from latticode.configuration import cost, schema
from latticode.configuration.cost import RunCost
from latticode.configuration.schema import Faults
from latticode.configuration.values import Name, faults
from latticode.equations.initial_values import name_window
from pydantic import Field, model_validator

from pendula.problem import AMPLITUDES

from .cases import AnyCase
from .motions import CrossingsSection, LargestExponentsSection
from .runs import Runs

PAPER_CASES = [f"fig{n}_{size}" for n in (2, 3, 4) for size in ("small", "large")]
PAPER_SWEEPS = [f"fig{n}_{side}" for n in (5, 6) for side in ("left", "right")]
AS_A_STUDY = 10.0
"""Limit on the total cost of a study's runs, in units of the limit on one run."""


class PaperConfiguration(schema.Configuration):
    """Cases, sweeps and the solvers' controls; `messages` adds a section for each study."""

    cases: Annotated[dict[Name, AnyCase], Field(min_length=1)]
    spectra: dict[Name, LargestExponentsSection] = {}
    sections: dict[Name, CrossingsSection] = {}
    SECTIONS_WITH_FILES: ClassVar[tuple[str, ...]] = (
        *schema.Configuration.SECTIONS_WITH_FILES,
        "spectra",
        "sections",
    )
    FORMER_KEYS: ClassVar[Mapping[str, str]] = {
        "pendula": "newton",
        "chaos.lyapunov.spectrum.lengths": "duration_factor",
        "chaos.lyapunov.spectrum.undriven_lengths": "undriven_duration_factor",
        "certified.own": "default_frames",
        "certified.breathers.wrong": "control_omegas",
        "unbounded.short.rest": "rest_threshold",
        "unbounded.long.rest": "rest_threshold",
    }

    @model_validator(mode="after")
    def _motions_are_possible(self) -> "PaperConfiguration":
        all_faults = [
            (f"{section}.{name}.{key}", text)
            for section in ("spectra", "sections")
            for name, entry in getattr(self, section).items()
            for key, text in self._faults_of_motion(entry)
        ]
        if all_faults:
            raise faults(all_faults)
        return self

    def _faults_of_motion(self, entry: LargestExponentsSection | CrossingsSection) -> Faults:
        """Yield the invalid keys of a spectrum or section, with their errors."""
        if entry.case not in self.cases:
            yield from super().absent("cases", "case", [entry.case])
            return
        case = self.cases[entry.case]
        if of_case := entry.faults_of(case):
            yield from of_case
        elif (total := entry.cost(case)).excess(limits := self.limits.model_dump()) > 1.0:
            key = "count" if hasattr(entry, "count") else "case"
            yield key, cost.name_excess(total, limits)

    def cost_of_motion(self, section: str, name: str) -> RunCost:
        """Return the cost of an entry of `spectra` or `sections`."""
        entry = getattr(self, section)[name]
        return entry.cost(self.cases[entry.case])

    def plain_when(self, section: str) -> dict[str, Any]:
        """Return `CrossingsSection.plain_when` of an entry of `sections`."""
        entry = self.sections[section]
        return entry.plain_when(self.cases[entry.case])

    def absent(self, section: str, key: str, names: list[str]) -> Faults:
        """Yield an error for each of `names` under `key` that is no case or sweep of (4)."""
        yield from super().absent(section, key, names)
        for name in names:
            if name in getattr(self, section):
                case = self.sweeps[name].case if section == "sweeps" else name
                if section == "sweeps" or name not in PAPER_CASES:  # `require` checks those
                    yield from self._not_amplitudes(key, case)

    def _not_amplitudes(self, key: str, name: str) -> Faults:
        """Yield an error for a case that is not of (4) under a key that requires (4)."""
        if self.cases[name].model != AMPLITUDES:
            text = f"case {name!r} is of {self.cases[name].equations}"
            yield key, f"{text}; give a case of the amplitude equations"

    def cost_estimate(self, name: str) -> tuple[str, Callable[[Mapping], RunCost]]:
        """Return what is computed for a case, as text, and a function that estimates its cost."""
        if name in PAPER_CASES:
            return super().cost_estimate(name)
        return "the run and its checks", self.cases[name].cost_with_checks

    def run_of(self, case: str, tolerance: float, solver: str = "taylor", **changes: Any) -> dict:
        """Return a case as a study runs it, as plain values of a `PaperProblem`."""
        controls = {"name": solver, "rtol": tolerance, "atol": tolerance}
        return {**self.problem(case), "solver": controls, "snapshot_every": 0, **changes}

    def runs_of_cases(
        self, cases: Iterable[str], tolerance: float, solver: str = "taylor", **changes: Any
    ) -> dict[str, dict]:
        """Return cases as a study runs them, by name, as plain values of Problems."""
        return {case: self.run_of(case, tolerance, solver, **changes) for case in cases}

    def latest_end(self, cases: Iterable[str]) -> float:
        """Return the latest end time of cases."""
        return max(self.cases[case].end_time for case in cases)

    def drawn_windows(self, sweep: str) -> dict[str, str]:
        """Return the names of the windows whose maximum and mean the figure of a sweep shows."""
        drawn = self.sweeps[sweep].drawn
        return {"text_window": name_window(drawn.max), "caption_window": name_window(drawn.mean)}

    def points_of_cases(self) -> list[tuple[float, float]]:
        """Return (Omega, gamma) of the cases of Figs 2 to 4 in units of epsilon, each once."""
        problems = [self.problem(case) for case in PAPER_CASES]
        coupled = [problem for problem in problems if problem["epsilon"]]
        return sorted({(p["omega"] / p["epsilon"], p["gamma"] / p["epsilon"]) for p in coupled})

    def faults_of_runs(self, runs: Runs) -> Faults:
        """Yield an error for runs of a study that no solver can integrate or that cost too much."""
        if faults := list(runs.faults()):
            yield from faults
            return
        faults = list(self.excess(runs.many, runs.costs(), runs.times))
        if faults and runs.size:
            unperturbed = runs._replace(size=0.0)
            if not list(self.excess(runs.many, unperturbed.costs(), runs.times)):
                faults = [(runs.perturbed, f"is {runs.size:g}: {faults[0][1]}")]
        yield from faults

    def long_runs(self) -> list[str]:
        """Return a line on each case and each study whose runs will take minutes."""
        sections = {name: getattr(self, name) for name in type(self).model_fields}
        totals = {
            f"{name}.{runs.many}: its runs together take": runs.total()
            for name, section in sections.items()
            if hasattr(section, "runs_of")
            for runs in section.runs_of(self)
        }
        long = {label: total for label, total in totals.items() if total.seconds > cost.LONG_RUN}
        return [*super().long_runs(), *(f"{label} {total}" for label, total in long.items())]

    def excess(self, key: str, costs: list[RunCost], times: float = 1.0) -> Faults:
        """Yield `key` and the reason if a study's runs, each made `times` times, cost too much."""
        total = cost.total(costs)._replace(memory=max((each.memory for each in costs), default=0.0))
        total = total._replace(seconds=times * total.seconds)
        limits = self.limits.model_dump()
        limits["hours"] *= AS_A_STUDY
        if total.excess(limits) > 1.0:
            text = cost.name_excess(total, limits, "its runs together")
            yield key, text.replace("allows", "allows a study")
