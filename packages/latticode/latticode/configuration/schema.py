"""The configuration: cases, sweeps, surveys, the controls of solvers, and the limits of a run.

Problems are returned as plain values for `Problem.of`, because a workflow compares the parameters
of its jobs from run to run.
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
from .messages import configuration_error
from .solvers import DEFAULT, Solver, Solvers, with_controls
from .surveys import SurveySection
from .values import Distinct, Name, Natural, Positive, Section, Window, excerpt_of, faults

Faults = Iterator[tuple[str, str]]
"""Pairs (key, error); the key is a dotted path within the mapping that is checked."""


class ShownWindows(Section):
    """The time windows of a figure of a sweep: one for the maximum of norms, one for the mean."""

    max: Window
    mean: Window


class Sweep(Section):
    """A case run for many half-widths, and the time windows for maxima and means of norms."""

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
            ("windows", f"[{start:g}, {end:g}] must satisfy 0 <= start < end")
            for start, end in self.windows
            if not 0 <= start < end
        ]
        names = [name_window(window) for window in self.windows]
        twice = [name for i, name in enumerate(names) if name in names[:i]]
        if twice:
            text = f"two windows are so similar that both would be named {twice[0]}"
            all_faults.append(("windows", text))
        if self.draw and not {self.draw.max, self.draw.mean} <= set(self.windows):
            all_faults.append(("draw", "has a window that is not listed under windows"))
        if all_faults:
            raise faults(all_faults)
        return self

    @property
    def drawn(self) -> ShownWindows:
        """The windows that a figure shows; by default the first window for both."""
        return self.draw or ShownWindows(max=self.windows[0], mean=self.windows[0])


class RunLimits(Section):
    """The time and memory that a run may need; a larger run is rejected before it starts."""

    hours: Positive = 1.0
    gigabytes: Positive = 8.0


class Configuration(Section):
    """Cases, sweeps, surveys and the controls of solvers; a subclass adds sections."""

    cases: Annotated[dict[Name, SerializeAsAny[CaseSection]], Field(min_length=1)]
    sweeps: dict[Name, Sweep] = {}
    surveys: dict[Name, SurveySection] = {}
    solvers: Solvers = Solvers()
    limits: RunLimits = RunLimits()
    SECTIONS_WITH_FILES: ClassVar[tuple[str, ...]] = ("cases", "sweeps", "surveys")
    FORMER_KEYS: ClassVar[Mapping[str, str]] = {}
    """The new names of renamed keys, by the old dotted path, for messages about old files."""

    @model_validator(mode="before")
    @classmethod
    def _complete_solvers(cls, raw: Any) -> Any:
        """Complete the solver of each case and sweep with the controls in `solvers`."""
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
        """Yield (key, error) for each of the `names` that is not in `section`."""
        for name in names:
            if name not in getattr(self, section):
                near = difflib.get_close_matches(name, getattr(self, section), 1)
                hint = f"; did you mean {near[0]!r}?" if near else ""
                yield key, f"there is no {section.removesuffix('s')} {excerpt_of(name)}{hint}"

    def cost_estimate(self, name: str) -> tuple[str, Callable[[Mapping], RunCost]]:
        """Return the subject of messages on the cost of a case, and a function for the cost."""
        return "the run", self.cases[name].cost

    def _same_files(self) -> Iterator[tuple[str, str]]:
        """Yield names that differ only in case: some file systems would use the same files."""
        for section in self.SECTIONS_WITH_FILES:
            seen: dict[str, str] = {}
            for name in getattr(self, section):
                first_name = seen.setdefault(name.lower(), name)
                if first_name != name:
                    text = (
                        f"differs from {first_name!r} only in letter case: their files may collide"
                    )
                    yield f"{section}.{name}", text

    def _excess_of_case(self, name: str) -> list[tuple[str, str]]:
        case, limits = self.cases[name], self.limits.model_dump()
        subject, estimate_cost = self.cost_estimate(name)
        excess = cost.find_excess(case.problem(), limits, case.cost, case.cheap_values)
        # snapshots come second: choosing their times takes long for a run of too many steps
        excess = excess or cost.find_excess(
            case.shown_problem(), limits, estimate_cost, case.cheap_values, subject
        )
        return [excess] if excess else []

    def _faults_of_sweep(self, name: str) -> list[tuple[str, str]]:
        sweep = self.sweeps[name]
        if sweep.case not in self.cases:
            return list(self.absent("cases", "case", [sweep.case]))
        case, all_faults = self.cases[sweep.case], []
        if case.sites is not None:
            text = "has the key sites; replace it by half_width, which a sweep changes"
            return [("case", f"{sweep.case!r} {text}")]
        try:
            data = case.data_on(chain_sites(max(sweep.half_widths)))
        except ValueError as error:
            return [("half_widths", f"case {sweep.case!r}: initial {error}")]
        reach, shortest = max(map(abs, data)), min(sweep.half_widths)
        if reach > shortest:
            text = f"is outside the chain of half-width {shortest}"
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
            solver = sweep.solver
            all_faults += [*case.faults_of_solver(solver)] or case.faults_of_step(solver)
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
        """Return [(key, error)] if a sweep costs too much; the key is windows or half_widths."""
        limits, total = self.limits.model_dump(), self.cost_of_sweep(name)
        if total.excess(limits) <= 1.0:
            return []
        many = self.sweeps[name].half_widths
        narrow = self._sum_of(name, ({"half_width": 30} for _ in many))
        end = self.cases[self.sweeps[name].case].start_time + 50.0
        short = self._sum_of(name, ({"half_width": m, "end_time": end} for m in many))
        key = "windows" if short.excess(limits) < narrow.excess(limits) else "half_widths"
        return [(key, cost.name_excess(total, limits))]

    def cost_of_sweep(self, name: str) -> RunCost:
        """Return the cost of all runs of a sweep, one after another."""
        return self._sum_of(name, ({"half_width": m} for m in self.sweeps[name].half_widths))

    def _sum_of(self, name: str, changes: Iterable[Mapping]) -> RunCost:
        """Return the total cost of the problem of a sweep, run once with each of the changes."""
        problem, case = self.swept_problem(name), self.cases[self.sweeps[name].case]
        return cost.total(case.cost({**problem, **values}) for values in changes)

    def _faults_of_survey(self, name: str) -> list[tuple[str, str]]:
        survey = self.surveys[name]
        if survey.case not in self.cases:
            return list(self.absent("cases", "case", [survey.case]))
        if all_faults := survey.faults_of(self.cases[survey.case]):
            return all_faults
        limits, total = self.limits.model_dump(), self.cost_of_survey(name)
        return [("axes", cost.name_excess(total, limits))] if total.excess(limits) > 1.0 else []

    def surveyed_problem(self, name: str) -> dict:
        """Return the problem, as plain values, that a survey varies."""
        return self.cases[self.surveys[name].case].problem(snapshot_step=None, times=None)

    def values_by_half_width(self, name: str) -> dict[int, dict[str, Any]]:
        """Return, by half-width, the values of the parameters that are functions of the sites."""
        survey = self.surveys[name]
        return self.cases[survey.case].values_by_half_width(survey.half_widths)

    def plain_survey(self, name: str) -> dict:
        """Return a survey as plain values, for the parameters of a job."""
        survey = self.surveys[name]
        return {
            "axes": survey.plan.axes,
            "members": survey.members and survey.members.model_dump(),
            "keep": survey.keep,
            "window": survey.window and list(survey.window),
            "by_half_width": self.values_by_half_width(name),
        }

    def cost_of_survey(self, name: str, chunks: int = 1) -> RunCost:
        """Return the cost of a chunk of a survey; all runs cost as much as the costlier corner."""
        survey, base = self.surveys[name], self.cases[self.surveys[name].case]
        runs = -(-prod(survey.plan.shape) // chunks)
        dearest = max(
            (case.cost(case.problem()) for case in map(base.at, survey.corners())),
            key=lambda run_cost: run_cost.seconds,
        )
        twice = 2.0 if "divergence" in survey.keep else 1.0
        return dearest._replace(seconds=twice * runs * dearest.seconds)

    def cost_of(self, case: str, solver: str | None = None) -> RunCost:
        """Return the cost of a run of a case, with its snapshots."""
        return self.cases[case].cost(self.shown_problem(case, solver))

    def long_runs(self) -> list[str]:
        """Return the messages before a run: remarks on solvers, then the costs of long runs."""
        costs = {}
        for name, case in self.cases.items():
            subject, estimate_cost = self.cost_estimate(name)
            verb = "take" if " and " in subject else "takes"
            costs[f"cases.{name}: {subject} {verb}"] = estimate_cost(case.shown_problem())
        costs |= {f"sweeps.{name}: the run takes": self.cost_of_sweep(name) for name in self.sweeps}
        costs |= {f"surveys.{n}: its runs take": self.cost_of_survey(n) for n in self.surveys}
        long = [f"{k} {total}" for k, total in costs.items() if total.seconds > cost.LONG_RUN]
        solvers = {name: case.problem()["solver"] for name, case in self.cases.items()}
        remarks = {name: remark_on(solver) for name, solver in solvers.items()}
        return [*(f"cases.{name}: {text}" for name, text in remarks.items() if text), *long]

    def problem(self, case: str, solver: str | None = None, **changes: Any) -> dict:
        """Return a case as plain values of a Problem, with another solver and other `changes`."""
        return self.cases[case].problem(**self._by(solver), **changes)

    def shown_problem(self, case: str, solver: str | None = None) -> dict:
        """Return the problem, with enough snapshots for a picture if the case specifies none."""
        return self.cases[case].shown_problem(**self._by(solver))

    def swept_problem(self, sweep: str, solver: str | None = None) -> dict:
        """Return the problem of a sweep as plain values, up to the end of its last time window."""
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
    """Return the validated configuration; raises ConfigurationError, which lists all errors."""
    try:
        return Configuration.model_validate(raw)
    except ValidationError as error:
        raise configuration_error(error, "the configuration", Configuration) from None
