"""The configuration: cases, sweeps over half-widths, solvers' controls, and the limits of a run.

Problems are returned as plain values, which `Problem.of` reads, since a workflow compares the
parameters of its jobs from run to run.
"""

import difflib
from collections.abc import Callable, Iterable, Iterator, Mapping
from math import prod
from typing import Annotated, Any, ClassVar

from pydantic import Field, SerializeAsAny, ValidationError, model_validator

from latticode.equations.initial_values import name_window
from latticode.equations.model_file import chain_sites
from latticode.integrators.families import remark_on

from . import cost
from .cases import CaseSection, is_multiple
from .cost import RunCost
from .messages import in_words
from .solvers import DEFAULT, Solver, Solvers, with_controls
from .surveys import SurveySection
from .values import Distinct, Name, Natural, Positive, Section, Window, excerpt_of, faults

Faults = Iterator[tuple[str, str]]
"""Pairs: the dotted path of a key, from the mapping that is checked, and what is wrong with it."""


class ShownWindows(Section):
    """The windows whose maximum and whose mean a figure shows."""

    max: Window
    mean: Window


class Sweep(Section):
    """A case repeated over half-widths, with its norms reduced over windows of time."""

    case: str
    half_widths: Annotated[list[Natural], Field(min_length=1, max_length=1000), Distinct]
    windows: Annotated[list[Window], Field(min_length=1, max_length=1000), Distinct] = [
        (10, 40),
        (10, 50),
        (10, 70),
    ]
    draw: ShownWindows | None = None
    solver: Solver | None = None

    @model_validator(mode="after")
    def _consistent(self) -> "Sweep":
        all_faults = [
            ("windows", f"[{start:g}, {end:g}] does not run forward from a time >= 0")
            for start, end in self.windows
            if not 0 <= start < end
        ]
        names = [name_window(window) for window in self.windows]
        twice = [name for i, name in enumerate(names) if name in names[:i]]
        if twice:
            all_faults.append(("windows", f"two are so near that both are named {twice[0]}"))
        if self.draw and not {self.draw.max, self.draw.mean} <= set(self.windows):
            all_faults.append(("draw", "may list only windows that are listed under windows"))
        if all_faults:
            raise faults(all_faults)
        return self

    @property
    def drawn(self) -> ShownWindows:
        """The windows that a figure shows: the first one, if the configuration names none."""
        return self.draw or ShownWindows(max=self.windows[0], mean=self.windows[0])


class RunLimits(Section):
    """What a run may take; a longer or larger one is refused before it starts."""

    hours: Positive = 1.0
    gigabytes: Positive = 8.0


class Configuration(Section):
    """Cases, sweeps and the solvers' controls. A program adds sections, and cases of its own."""

    cases: Annotated[dict[Name, SerializeAsAny[CaseSection]], Field(min_length=1)]
    sweeps: dict[Name, Sweep] = {}
    surveys: dict[Name, SurveySection] = {}
    solvers: Solvers = Solvers()
    limits: RunLimits = RunLimits()
    SECTIONS_WITH_FILES: ClassVar[tuple[str, ...]] = ("cases", "sweeps", "surveys")
    FORMER_KEYS: ClassVar[Mapping[str, str]] = {}
    """Present names of renamed keys by their dotted paths, for messages to users of old files."""

    @model_validator(mode="before")
    @classmethod
    def _complete_solvers(cls, raw: Any) -> Any:
        """Give every solver that is only named its controls from `solvers`."""
        if not isinstance(raw, dict):
            return raw
        sections = {}
        for section, default in (("cases", {"solver": DEFAULT}), ("sweeps", {})):
            if isinstance(raw.get(section), dict):
                sections[section] = {
                    name: with_controls({**default, **item}, raw.get("solvers") or {})
                    if isinstance(item, dict)
                    else item
                    for name, item in raw[section].items()
                }
        return {**raw, **sections}

    @model_validator(mode="after")
    def _runs_are_possible(self) -> "Configuration":
        all_faults = [
            (f"sweeps.{name}.{key}", text)
            for name in self.sweeps
            for key, text in self._faults_of_sweep(name)
        ]
        all_faults += [
            (f"surveys.{name}.{key}", text)
            for name in self.surveys
            for key, text in self._faults_of_survey(name)
        ]
        all_faults += self._same_files()
        all_faults += [
            (f"cases.{name}.{key}", text)
            for name in self.cases
            for key, text in self._excess_of_case(name)
        ]
        if all_faults:
            raise faults(all_faults)
        return self

    def absent(self, section: str, key: str, names: list[str]) -> Faults:
        """Yield each of `names`, which stand at `key`, that `section` does not have."""
        for name in names:
            if name not in getattr(self, section):
                near = difflib.get_close_matches(name, getattr(self, section), 1)
                hint = f"; did you mean {near[0]!r}?" if near else ""
                yield key, f"there is no {section.removesuffix('s')} {excerpt_of(name)}{hint}"

    def cost_estimate(self, name: str) -> tuple[str, Callable[[Mapping], RunCost]]:
        """Return in words what is made of a case, and what estimates its cost."""
        return "the run", self.cases[name].cost

    def _same_files(self) -> Iterator[tuple[str, str]]:
        """Yield names whose files would be the same where a file system takes a for A."""
        for section in self.SECTIONS_WITH_FILES:
            seen: dict[str, str] = {}
            for name in getattr(self, section):
                first_name = seen.setdefault(name.lower(), name)
                if first_name != name:
                    text = f"differs from {first_name!r} only in letter case, so their files may"
                    text += " collide"
                    yield f"{section}.{name}", text

    def _excess_of_case(self, name: str) -> list[tuple[str, str]]:
        case, limits, (subject, estimate_cost) = (
            self.cases[name],
            self.limits.model_dump(),
            self.cost_estimate(name),
        )
        excess = cost.find_excess(case.problem(), limits, case.cost, case.ordinary)
        # the times of its snapshots are chosen for a run that is not too long
        excess = excess or cost.find_excess(
            case.shown_problem(), limits, estimate_cost, case.ordinary, subject
        )
        return [excess] if excess else []

    def _faults_of_sweep(self, name: str) -> list[tuple[str, str]]:
        sweep = self.sweeps[name]
        if sweep.case not in self.cases:
            return list(self.absent("cases", "case", [sweep.case]))
        case, all_faults = self.cases[sweep.case], []
        if case.sites is not None:
            text = "has a number of sites; give it half_width, which a sweep changes"
            return [("case", f"{sweep.case!r} {text}")]
        try:
            data = case.data_on(chain_sites(max(sweep.half_widths)))
        except ValueError as error:
            return [("half_widths", f"case {sweep.case!r}: initial {error}")]
        reach, shortest = max(map(abs, data)), min(sweep.half_widths)
        if reach > shortest:
            text = f"lies outside the chain of half-width {shortest}"
            all_faults.append(("half_widths", f"site {reach} of case {sweep.case!r} {text}"))
        unknown = case.faults_of_half_widths(sweep.half_widths)
        all_faults += [("half_widths", f"case {sweep.case!r}: {k}: {text}") for k, text in unknown]
        if all_faults:
            return all_faults
        start = case.start_time
        if early := [window for window in sweep.windows if window[0] < start]:
            text = f"{name_window(early[0])} begins before the run, which starts at {start:g}"
            return [("windows", text)]
        times = [time for window in sweep.windows for time in window if time > start]
        off_grid = [time for time in times if not is_multiple(time - start, case.output_step)]
        if off_grid:
            text = f"is not a whole number of output steps of {case.output_step:g}"
            all_faults.append(("windows", f"{off_grid[0]:g} {text}"))
        if sweep.solver is not None:
            all_faults += [*case.faults_of_solver(sweep.solver)] or case.faults_of_step(
                sweep.solver
            )
            if all_faults:
                return all_faults
        for key, text in case.obstacles(sweep.solver, max(times) - start):
            of_sweep_solver = key.startswith("solver") and sweep.solver is not None
            sweep_key = key if of_sweep_solver else "windows" if key == "end_time" else "case"
            all_faults.append(
                (sweep_key, text if of_sweep_solver else f"in case {sweep.case!r}, {key}: {text}")
            )
        return all_faults or self._excess_of_sweep(name)

    def _excess_of_sweep(self, name: str) -> list[tuple[str, str]]:
        """Return which key makes a sweep too long, `windows` or `half_widths`, and its cost."""
        limits, total = self.limits.model_dump(), self.cost_of_sweep(name)
        if total.excess(limits) <= 1.0:
            return []
        many = self.sweeps[name].half_widths
        ordinary = self._sum_of(name, ({"half_width": 30} for _ in many))
        end = self.cases[self.sweeps[name].case].start_time + 50.0
        short = self._sum_of(name, ({"half_width": m, "end_time": end} for m in many))
        key = "windows" if short.excess(limits) < ordinary.excess(limits) else "half_widths"
        return [(key, cost.refusal(total, limits))]

    def cost_of_sweep(self, name: str) -> RunCost:
        """Return what all runs of a sweep take, one after another."""
        return self._sum_of(name, ({"half_width": m} for m in self.sweeps[name].half_widths))

    def _sum_of(self, name: str, changes: Iterable[Mapping]) -> RunCost:
        """Return what the problem of a sweep takes, run once with each of the changes."""
        problem, case = self.swept_problem(name), self.cases[self.sweeps[name].case]
        return cost.total(case.cost({**problem, **values}) for values in changes)

    def _faults_of_survey(self, name: str) -> list[tuple[str, str]]:
        survey = self.surveys[name]
        if survey.case not in self.cases:
            return list(self.absent("cases", "case", [survey.case]))
        if all_faults := survey.faults_of(self.cases[survey.case]):
            return all_faults
        limits, total = self.limits.model_dump(), self.cost_of_survey(name)
        return [("axes", cost.refusal(total, limits))] if total.excess(limits) > 1.0 else []

    def surveyed_problem(self, name: str) -> dict:
        """Return the problem whose values a survey changes."""
        return self.cases[self.surveys[name].case].problem(snapshot_step=None, times=None)

    def values_by_half_width(self, name: str) -> dict[int, dict[str, Any]]:
        """Return, for each half-width of a survey, the parameters that are functions of the sites.

        So a function is evaluated on the sites of each run.
        """
        survey = self.surveys[name]
        return self.cases[survey.case].values_by_half_width(survey.half_widths)

    def plain_survey(self, name: str) -> dict:
        """Return a survey as plain values, as the parameters of a job have them."""
        survey = self.surveys[name]
        members = survey.members and survey.members.model_dump()
        names, window = survey.keep, survey.window and list(survey.window)
        return {
            "axes": survey.plan.axes,
            "members": members,
            "keep": names,
            "window": window,
            "by_half_width": self.values_by_half_width(name),
        }

    def cost_of_survey(self, name: str, chunks: int = 1) -> RunCost:
        """Return what one of so many parts takes, if each run is as dear as the dearest corner."""
        survey, base = self.surveys[name], self.cases[self.surveys[name].case]
        runs = -(-prod(survey.plan.shape) // chunks)
        dearest = max(
            (case.cost(case.problem()) for case in map(base.at, survey.corners())),
            key=lambda run_cost: run_cost.seconds,
        )
        twice = 2.0 if "divergence" in survey.keep else 1.0
        return dearest._replace(seconds=twice * runs * dearest.seconds)

    def cost_of(self, case: str, solver: str | None = None) -> RunCost:
        """Return what a run of a case takes, with its snapshots."""
        return self.cases[case].cost(self.shown_problem(case, solver))

    def long_runs(self) -> list[str]:
        """Return a sentence on each run that will last for minutes, to be said before it starts.

        Runs by another solver than the default come first.
        """
        costs = {}
        for name, case in self.cases.items():
            subject, estimate_cost = self.cost_estimate(name)
            verb = "take" if " and " in subject else "takes"
            costs[f"cases.{name}: {subject} {verb}"] = estimate_cost(case.shown_problem())
        costs |= {f"sweeps.{name}: the run takes": self.cost_of_sweep(name) for name in self.sweeps}
        costs |= {f"surveys.{n}: its runs take": self.cost_of_survey(n) for n in self.surveys}
        long = [
            f"{subject} {run_cost}"
            for subject, run_cost in costs.items()
            if run_cost.seconds > cost.WORTH_SAYING
        ]
        solvers = {name: case.problem()["solver"] for name, case in self.cases.items()}
        remarks = {name: remark_on(solver) for name, solver in solvers.items()}
        return [*(f"cases.{name}: {text}" for name, text in remarks.items() if text), *long]

    def problem(self, case: str, solver: str | None = None, **changes) -> dict:
        """Return a case as plain values of a Problem.

        `solver` takes the place of the case's own, `changes` that of other keys.
        """
        return self.cases[case].problem(**self._by(solver), **changes)

    def shown_problem(self, case: str, solver: str | None = None) -> dict:
        """Return the problem, with snapshots enough for a picture if the case names no number."""
        return self.cases[case].shown_problem(**self._by(solver))

    def swept_problem(self, sweep: str, solver: str | None = None) -> dict:
        """Return the case of a sweep as plain values, to be run to the end of the last window."""
        section = self.sweeps[sweep]
        changes = {
            "end_time": max(end for _, end in section.windows),
            "half_width": max(section.half_widths),
            "snapshot_step": None,
            "times": None,
        }
        if section.solver is not None:
            changes["solver"] = section.solver.model_dump()
        return self.cases[section.case].problem(**changes | self._by(solver))

    def _by(self, solver: str | None) -> dict:
        return {} if solver is None else {"solver": getattr(self.solvers, solver).model_dump()}


def load(raw: dict) -> Configuration:
    """Return the validated configuration, or raise ConfigurationError with every fault."""
    try:
        return Configuration.model_validate(raw)
    except ValidationError as error:
        raise in_words(error, "the configuration", Configuration) from None
