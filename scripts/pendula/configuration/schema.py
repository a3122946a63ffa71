"""The configuration: cases, sweeps over half-widths, solvers' controls, and the limits of a run.

Problems are returned as plain values, which `pendula.problem.Problem.of` reads, since Snakemake
compares the parameters of its jobs from run to run.
"""

import difflib
from collections.abc import Callable, Iterator
from typing import Annotated, Any

from latticode.simulation.problem import name_window
from pydantic import Field, model_validator

from pendula.problem import AMPLITUDES, PENDULA

from . import cost
from .cases import is_multiple
from .own_models import AnyCase, OwnCase
from .solvers import Solver, Solvers, with_controls
from .values import Distinct, Model, Name, Natural, Positive, Window, faults, shown

Faults = Iterator[tuple[str, str]]
"""Pairs: the dotted path of a key, from the mapping that is checked, and what is wrong with it."""


PAPER_CASES = [f"fig{n}_{size}" for n in (2, 3, 4) for size in ("small", "large")]
PAPER_SWEEPS = [f"fig{n}_{side}" for n in (5, 6) for side in ("left", "right")]
AS_A_STUDY = 10.0
"""All runs of a study together may take this many times as long as one run may."""


class Drawn(Model):
    """The windows whose maximum and whose mean a figure shows."""

    max: Window
    mean: Window


class Sweep(Model):
    """A case repeated over half-widths, with its norms reduced over windows of time."""

    case: str
    half_widths: Annotated[list[Natural], Field(min_length=1, max_length=1000), Distinct]
    windows: Annotated[list[Window], Field(min_length=1, max_length=1000), Distinct] = [
        (10, 40),
        (10, 50),
        (10, 70),
    ]
    draw: Drawn | None = None
    solver: Solver | None = None

    @model_validator(mode="after")
    def _consistent(self) -> "Sweep":
        found = [
            ("windows", f"[{start:g}, {end:g}] does not run forward from a time >= 0")
            for start, end in self.windows
            if not 0 <= start < end
        ]
        names = [name_window(window) for window in self.windows]
        twice = [name for i, name in enumerate(names) if name in names[:i]]
        if twice:
            found.append(("windows", f"two are so near that both are named {twice[0]}"))
        if self.draw and not {self.draw.max, self.draw.mean} <= set(self.windows):
            found.append(("draw", "takes windows that stand under windows only"))
        if found:
            raise faults(found)
        return self

    @property
    def drawn(self) -> Drawn:
        """The windows that a figure shows: the first one, if the configuration names none."""
        return self.draw or Drawn(max=self.windows[0], mean=self.windows[0])


class Limits(Model):
    """What a run may take; a longer or larger one is refused before it starts."""

    hours: Positive = 1.0
    gigabytes: Positive = 8.0


class Configuration(Model):
    """Cases, sweeps and the solvers' controls; `messages` adds a section for each study."""

    cases: Annotated[dict[Name, AnyCase], Field(min_length=1)]
    sweeps: dict[Name, Sweep] = {}
    solvers: Solvers = Solvers()
    limits: Limits = Limits()

    @model_validator(mode="before")
    @classmethod
    def _complete_solvers(cls, raw: Any) -> Any:
        """Give every solver that is only named its controls from `solvers`."""
        if not isinstance(raw, dict):
            return raw
        sections = {}
        for section, default in (("cases", {"solver": "taylor"}), ("sweeps", {})):
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
        found = [
            (f"sweeps.{name}.{key}", text)
            for name in self.sweeps
            for key, text in self._faults_of_sweep(name)
        ]
        found += self._same_files()
        found += [
            (f"cases.{name}.{key}", text)
            for name in self.cases
            for key, text in self._excess_of_case(name)
        ]
        if found:
            raise faults(found)
        return self

    def absent(self, section: str, key: str, names: list[str]) -> Iterator[tuple[str, str]]:
        """Yield each of `names`, which stand at `key`, that `section` does not have."""
        for name in names:
            if name not in getattr(self, section):
                near = difflib.get_close_matches(name, getattr(self, section), 1)
                hint = f"; did you mean {near[0]!r}?" if near else ""
                yield key, f"there is no {section.removesuffix('s')} {shown(name)}{hint}"
            elif section == "sweeps":
                yield from self._not_amplitudes(key, self.sweeps[name].case)
            elif name not in PAPER_CASES:  # `require` tells of those
                yield from self._not_amplitudes(key, name)

    def _not_amplitudes(self, key: str, name: str) -> Faults:
        """Yield the fault of a case of the pendula where only the amplitudes have a meaning."""
        if self.cases[name].model != AMPLITUDES:
            whose = "the pendula" if self.cases[name].model == PENDULA else "a model of your own"
            yield key, f"case {name!r} is of {whose}, and this is about the amplitude equations"

    def excess(self, key: str, costs: list[cost.Cost], times: float = 1.0) -> Faults:
        """Yield `key` and why, if the runs of a study, each made `times` times, cost too much."""
        total = cost.Cost(
            times * sum(one.seconds for one in costs),
            max((one.memory for one in costs), default=0.0),
        )
        limits = self.limits.model_dump()
        limits["hours"] *= AS_A_STUDY
        if total.excess(limits) > 1.0:
            text = cost.refusal(total, limits).replace("allows", "allows a study")
            yield key, text.replace("the run would take", "its runs together would take")

    def _same_files(self) -> Iterator[tuple[str, str]]:
        """Yield names whose files would be the same where a file system takes a for A."""
        for section in ("cases", "sweeps"):
            seen: dict[str, str] = {}
            for name in getattr(self, section):
                other = seen.setdefault(name.lower(), name)
                if other != name:
                    text = f"and {other!r} differ in capitals alone, and so would their files"
                    yield f"{section}.{name}", text

    def _excess_of_case(self, name: str) -> list[tuple[str, str]]:
        limits = self.limits.model_dump()
        found = cost.find_excess(self.problem(name), limits)
        # the times of its snapshots are chosen for a run that is not too long
        found = found or cost.find_excess(self.shown_problem(name), limits, self._cost_of(name))
        return [found] if found else []

    def _cost_of(self, case: str) -> Callable:
        """Return what estimates the cost of a case; those of a user are checked after their run."""
        return cost.estimate if case in PAPER_CASES else cost.with_checks

    def _faults_of_sweep(self, name: str) -> list[tuple[str, str]]:
        sweep = self.sweeps[name]
        if sweep.case not in self.cases:
            return list(self.absent("cases", "case", [sweep.case]))
        case, found = self.cases[sweep.case], []
        reach, shortest = max(map(abs, case.initial)), min(sweep.half_widths)
        if reach > shortest:
            text = f"lies outside the chain of half-width {shortest}"
            found.append(("half_widths", f"site {reach} of case {sweep.case!r} {text}"))
        if isinstance(case, OwnCase):
            faults_of_own = case.faults_of_half_widths(sweep.half_widths)
            found += [("half_widths", f"case {sweep.case!r}: {k}: {x}") for k, x in faults_of_own]
            if found:
                return found
        times = [time for window in sweep.windows for time in window if time > 0]
        off_grid = [time for time in times if not is_multiple(time, case.output_step)]
        if off_grid:
            text = f"is not a whole number of output steps of {case.output_step:g}"
            found.append(("windows", f"{off_grid[0]:g} {text}"))
        if sweep.solver is not None:
            found += [*case.faults_of_solver(sweep.solver)] or case.faults_of_step(sweep.solver)
            if found:
                return found
        for key, text in case.obstacles(sweep.solver, max(times)):
            own = key.startswith("solver") and sweep.solver is not None
            here = key if own else "windows" if key == "end_time" else "case"
            found.append((here, text if own else f"in case {sweep.case!r}, {key}: {text}"))
        return found or self._excess_of_sweep(name)

    def _excess_of_sweep(self, name: str) -> list[tuple[str, str]]:
        """Return which key makes a sweep too long, `windows` or `half_widths`, and its cost."""
        limits, total = self.limits.model_dump(), self.cost_of_sweep(name)
        if total.excess(limits) <= 1.0:
            return []
        problem, many = self.swept_problem(name), self.sweeps[name].half_widths
        ordinary = cost.sum_of({**problem, "half_width": 30} for _ in many)
        short = cost.sum_of({**problem, "half_width": m, "end_time": 50.0} for m in many)
        key = "windows" if short.excess(limits) < ordinary.excess(limits) else "half_widths"
        return [(key, cost.refusal(total, limits))]

    def cost_of_sweep(self, name: str) -> cost.Cost:
        """Return what all runs of a sweep take, one after another."""
        problem = self.swept_problem(name)
        return cost.sum_of({**problem, "half_width": m} for m in self.sweeps[name].half_widths)

    def long_runs(self) -> list[str]:
        """Return a sentence on each run that will last for minutes, to be said before it starts."""
        found = {
            f"cases.{name}: the run {'takes' if name in PAPER_CASES else 'and its checks take'}":
            self._cost_of(name)(self.shown_problem(name))
            for name in self.cases
        }  # fmt: skip
        found |= {f"sweeps.{name}: the run takes": self.cost_of_sweep(name) for name in self.sweeps}
        return [f"{what} {one}" for what, one in found.items() if one.seconds > cost.WORTH_SAYING]

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
        end_time = max(end for _, end in self.sweeps[sweep].windows)
        own = self.sweeps[sweep].solver
        changes = {"end_time": end_time, "snapshot_step": None}
        if own is not None:
            changes["solver"] = own.model_dump()
        changes |= self._by(solver)
        case = self.cases[self.sweeps[sweep].case]
        if isinstance(case, OwnCase):
            changes["half_width"] = max(self.sweeps[sweep].half_widths)
        return case.problem(**changes)

    def _by(self, solver: str | None) -> dict:
        return {} if solver is None else {"solver": getattr(self.solvers, solver).model_dump()}
